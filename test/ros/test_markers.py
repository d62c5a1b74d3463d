"""The markers, and when they are sent."""

import numpy as np
import pytest
from visualization_msgs.msg import Marker

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.ros.markers import Markers
from pool_sim_ros.simulator.frame import COLLISION_COLUMNS
from pool_sim_ros.simulator.playback import Playback

TABLE = report_table()
NOTHING = np.empty((0, len(COLLISION_COLUMNS)))


def by_name(array):
    """Return the markers by namespace and id; none may be there twice."""
    found = {(marker.ns, marker.id): marker for marker in array.markers}
    assert len(found) == len(array.markers)
    return found


def place(marker):
    position = marker.pose.position
    return position.x, position.y, position.z


def lines(marker):
    """Return the trails, as a list of [[x, y], [x, y]] for each colour."""
    assert len(marker.points) == len(marker.colors) and len(marker.points) % 2 == 0
    found = {}
    for start, end, color in zip(
        marker.points[::2], marker.points[1::2], marker.colors[::2], strict=True
    ):
        key = round(color.r, 4), round(color.g, 4), round(color.b, 4)
        found.setdefault(key, []).append([[start.x, start.y], [end.x, end.y]])
    return found


def test_the_table_is_a_cloth_of_its_size_between_four_cushions():
    found = by_name(Markers(TABLE, 'felt').table())
    cloth = found.pop(('table', 0))
    assert (cloth.scale.x, cloth.scale.y) == (TABLE.length, TABLE.width)
    assert place(cloth)[2] + cloth.scale.z / 2 == pytest.approx(0.0)
    faces = set()
    assert len(found) == 4
    for cushion in found.values():
        x, y, _ = place(cushion)
        if cushion.scale.x < cushion.scale.y:
            faces.add(('x', round(x + np.sign(TABLE.length / 2 - x) * cushion.scale.x / 2, 9)))
        else:
            faces.add(('y', round(y + np.sign(TABLE.width / 2 - y) * cushion.scale.y / 2, 9)))
    assert faces == {('x', 0.0), ('x', TABLE.length), ('y', 0.0), ('y', TABLE.width)}
    assert all(m.header.frame_id == 'felt' for m in (cloth, *found.values()))


def test_every_ball_has_its_colour_size_place_and_a_label_that_faces_the_viewer():
    found = by_name(Markers(TABLE, 'table').everything(TABLE.positions + 0.01))
    for i, ball in enumerate(TABLE.balls):
        marker, label = found['balls', i], found['labels', i]
        x, y = TABLE.positions[i] + 0.01
        assert place(marker) == (x, y, ball.radius)
        assert marker.type == Marker.SPHERE and marker.scale.x == 2 * ball.radius
        assert (marker.color.r, marker.color.g, marker.color.b) == pytest.approx(ball.color)
        assert label.type == Marker.TEXT_VIEW_FACING and label.text == ball.label
        assert place(label)[:2] == (x, y) and place(label)[2] > 2 * ball.radius


def test_a_table_at_rest_changes_nothing():
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    assert markers.changes(TABLE.positions, NOTHING, started=False, rolling=False) is None


def test_balls_that_are_put_elsewhere_leave_no_trail():
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    positions = TABLE.positions.copy()
    positions[3] += 0.02
    found = by_name(markers.changes(positions, NOTHING, started=False, rolling=False))
    assert set(found) == {('balls', 3), ('labels', 3), ('trails', 0)}
    assert found['trails', 0].points == []


def test_a_shot_moves_only_what_rolls_flashes_at_contacts_and_leaves_exact_trails():
    shot = simulate(TABLE, (-4.0, 0.3))
    playback = Playback(TABLE.positions, 60)
    playback.strike()
    playback.computed(shot)
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    flashes, before = [], TABLE.positions
    while True:
        frame = playback.next_frame()
        changes = markers.changes(
            frame.positions, frame.collisions, started=frame.started, rolling=True
        )
        moved = np.flatnonzero(np.any(frame.positions != before, axis=1))
        found = by_name(changes)
        assert {i for ns, i in found if ns == 'balls'} == set(moved.tolist())
        for i in moved:
            assert place(found['balls', i])[:2] == tuple(frame.positions[i])
        flashes += [place(m)[:2] for (ns, _), m in found.items() if ns == 'flashes']
        assert all(m.lifetime.nanosec > 0 for (ns, _), m in found.items() if ns == 'flashes')
        before = frame.positions
        if frame.finished:
            break
    contacts = shot.events[shot.events['kind'] < 2]
    assert flashes == [(event['x'], event['y']) for event in contacts]
    trails = lines(found['trails', 0])
    for i, ball in enumerate(TABLE.balls):
        way = shot.path(i)
        trail = trails.get(tuple(round(float(np.float32(part)), 4) for part in ball.color), [])
        corners = [end for start, end in trail if start != end]
        assert len(corners) == len(way) - 1
        np.testing.assert_allclose(np.reshape(corners, (-1, 2)), way[1:], atol=1e-9)


def test_the_next_shot_begins_without_the_trails_of_the_last():
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    markers.changes(TABLE.positions, NOTHING, started=True, rolling=True)
    rolled = TABLE.positions + [0.1, 0.0]
    assert markers.changes(rolled, NOTHING, started=False, rolling=True).markers[-1].points
    again = markers.changes(TABLE.positions, NOTHING, started=True, rolling=True)
    assert again.markers[-1].points == []
