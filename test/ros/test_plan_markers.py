"""The best shots as markers: paths, where the balls end, and chances."""

import numpy as np
import pytest
from visualization_msgs.msg import Marker

from pool_sim_ros.oracle import Goal, Noise, Plan, find_shots
from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.ros.plan_markers import no_markers, plan_markers
from pool_sim_ros.ros.simulator_view import Lying

TABLE = report_table()
LYING = Lying(TABLE, np.array(TABLE.positions))


@pytest.fixture(scope='module')
def plan():
    goal = Goal(ball='9', to=(0.3, 0.2), within=0.3)
    return find_shots(TABLE, goal, Noise(speed=0.05, azimuth=0.2), 3000, count=4, threads=1)


def of(markers, namespace):
    return {marker.id: marker for marker in markers if marker.ns == namespace}


def test_the_best_three_are_drawn_and_what_was_there_goes(plan):
    markers = plan_markers(plan, LYING, 'hall').markers
    assert len(plan) == 4 and markers[0].action == Marker.DELETEALL
    assert all(marker.action == Marker.ADD for marker in markers[1:])
    assert {marker.header.frame_id for marker in markers} == {'hall'}
    assert len({(marker.ns, marker.id) for marker in markers[1:]}) == len(markers) - 1
    texts = of(markers, 'plan_chances')
    for rank, shot in enumerate(plan[:3]):
        assert texts[rank].text.startswith(f'{rank + 1}: {100 * shot.chance:.0f} % (')
    assert len(texts) == 3


def test_a_path_is_that_of_the_shot_without_noise(plan):
    paths = of(plan_markers(plan, LYING, 'table').markers, 'plan_paths')
    for rank, shot in enumerate(plan[:3]):
        played = simulate(TABLE, shot.velocity)
        for ball in range(len(TABLE.balls)):
            line = paths.get(rank * len(TABLE.balls) + ball)
            points = played.path(ball)
            assert (line is not None) == (len(points) > 1)
            if line is not None:
                assert [[p.x, p.y] for p in line.points] == points.tolist()
                assert line.color.a == np.float32([1.0, 0.5, 0.3][rank])


def test_where_a_ball_ends_lies_an_ellipse_of_one_standard_deviation(plan):
    spots = of(plan_markers(plan, LYING, 'table').markers, 'plan_ends')
    best = plan[0]
    spot = spots[9]
    assert [spot.pose.position.x, spot.pose.position.y] == best.mean[9].tolist()
    assert [spot.scale.x, spot.scale.y] == (2.0 * best.spread[9]).tolist()
    still = [k for k in range(11) if best.spread[k].max() == 0.0]
    assert not any(k in spots for k in still)


def test_no_plan_has_no_markers():
    for array in (no_markers('table'), plan_markers(Plan((), 1000, False), LYING, 'table')):
        assert [marker.action for marker in array.markers] == [Marker.DELETEALL]
