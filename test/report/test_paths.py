import math
from dataclasses import replace

import numpy as np
import pytest
from picture_reader import color_at, pixels

from pool_sim_ros.physics import EventKind, simulate
from pool_sim_ros.report.drawing import CLOTH, TablePicture
from pool_sim_ros.report.paths import arrows, distance_to, draw_paths


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
@pytest.mark.parametrize('number', [1, 2, 3, 4])
def test_paths_go_where_the_balls_went(shots, number, integrator):
    velocity = shots[number].velocity
    trajectory = simulate(shots[number].table, velocity, integrator=integrator)
    places = trajectory.positions(np.linspace(0.0, trajectory.duration, 997))
    for index, ball in enumerate(trajectory.table.balls):
        points = trajectory.path(index)
        assert tuple(points[0]) == ball.position
        assert tuple(points[-1]) == tuple(trajectory.final_positions[index])
        if len(points) == 1:
            assert np.all(places[:, index] == ball.position)
            continue
        # A time-sliced ball gets as far into a cushion as it goes in a slice, and is put back.
        slack = 1e-9 if integrator == 'event' else 4.0 * 1e-6
        assert distances(places[:, index], points).max() < slack
        assert distances(points, places[:, index]).max() < 0.01


def test_a_path_ends_where_a_shot_was_cut(shots):
    cut = simulate(shots[1].table, shots[1].velocity, until=0.5)
    points = cut.path(0)
    assert len(points) > 1
    assert tuple(points[-1]) == tuple(cut.final_positions[0])


def distances(places, path):
    """How far each place is from the line through a path, plainly: over each piece of it."""
    best = np.full(len(places), np.inf)
    for start, end in zip(path[:-1], path[1:], strict=True):
        step = end - start
        if not step.any():
            continue
        along = np.clip((places - start) @ step / (step @ step), 0.0, 1.0)
        best = np.minimum(best, np.hypot(*(places - start - along[:, None] * step).T))
    return best


def test_end_pictures_show_the_path_of_each_ball_that_moved_and_only_those(shots, tmp_path):
    shot = shots[2]
    table = shot.table
    picture = TablePicture(table)
    picture.place(shot.trajectory.final_positions)
    before = pixels(picture, tmp_path)
    draw_paths(picture.axes, shot.trajectory)
    after = pixels(picture, tmp_path)
    # Points on the paths of the cue ball and of ball 2, and one where nothing was.
    halfway = shot.trajectory.positions(0.3)[0]
    assert color_at(before, table, *halfway) == pytest.approx(CLOTH, abs=0.02)
    assert color_at(after, table, *halfway) == pytest.approx((1.0, 1.0, 1.0), abs=0.02)
    start_of_2 = table.balls[2].position
    assert color_at(after, table, *start_of_2) != pytest.approx(CLOTH, abs=0.02)
    changed = np.abs(after - before).max(axis=2) > 0.02
    height, width = changed.shape
    assert not changed[:, : width // 50].any()
    assert not changed[height // 2 :, width // 10 : width // 2].any()


@pytest.mark.parametrize('number', [1, 2, 3, 4])
def test_a_straight_stretch_has_its_arrow_in_its_middle(shots, number):
    trajectory = simulate(shots[number].table, shots[number].velocity)
    for index, ball in enumerate(trajectory.table.balls):
        path = trajectory.path(index)
        steps = np.diff(path, axis=0)
        long = np.hypot(*steps.T) >= 2.5 * ball.radius
        found = list(arrows(trajectory, index))
        assert len(found) == long.sum()
        for (place, angle), start, step in zip(found, path[:-1][long], steps[long], strict=True):
            assert place == pytest.approx(start + step / 2, abs=1e-9)
            assert angle == pytest.approx(math.atan2(step[1], step[0]), abs=1e-6)


CENTRE, RADIUS = np.array([1.0, 0.5]), 0.4


class CircularShot:
    """A ball goes half round a circle in 2 s and meets a cushion after 1 s, as no disc does."""

    def __init__(self, table):
        self.table = replace(table, balls=table.balls[:1])
        self.duration = 2.0
        self.final_positions = self.positions([self.duration])[0]
        kinds = [('t', float), ('kind', int), ('a', int), ('b', int)]
        self.events = np.array(
            # The second is no contact, and divides nothing.
            [(1.0, EventKind.CUSHION, 0, 2), (1.5, EventKind.STOP, 0, -1)],
            kinds,
        )

    def positions(self, times):
        angles = np.pi / 2 * np.asarray(times)
        circle = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        return (CENTRE + RADIUS * circle)[:, np.newaxis]

    def path(self, index):
        return self.positions(np.linspace(0.0, self.duration, 201))[:, index]


def test_a_curve_has_one_arrow_for_each_stretch_between_contacts(settings):
    found = list(arrows(CircularShot(settings.table), 0))
    # Each quarter of the circle: its middle, and the tangent there.
    for (place, angle), middle in zip(found, (np.pi / 4, 3 * np.pi / 4), strict=True):
        on_circle = CENTRE + RADIUS * np.array([math.cos(middle), math.sin(middle)])
        assert place == pytest.approx(on_circle, abs=0.01 * RADIUS)
        tangent = (-math.sin(middle), math.cos(middle))
        assert (math.cos(angle), math.sin(angle)) == pytest.approx(tangent, abs=0.05)


def test_a_curve_is_drawn_through_all_its_points(settings):
    shot = CircularShot(settings.table)
    picture = TablePicture(shot.table)
    draw_paths(picture.axes, shot)
    lines = [line for line in picture.axes.lines if len(line.get_xdata()) > 1]
    assert len(lines) == 2  # the edge and the line
    for line in lines:
        assert np.array_equal(line.get_xydata(), shot.path(0))
    markers = [line for line in picture.axes.lines if len(line.get_xdata()) == 1]
    assert len(markers) == 2


def test_the_distance_of_a_point_from_a_path():
    path = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]])
    assert distance_to(np.array([1.0, 2.0]), path) == 2.0
    assert distance_to(np.array([-3.0, 4.0]), path) == 5.0
    assert distance_to(np.array([3.0, 1.0]), path) == 0.0


def test_no_ball_that_rests_has_an_arrow(shots):
    trajectory = shots[3].trajectory
    counts = {index: len(list(arrows(trajectory, index))) for index in range(11)}
    assert [index for index, count in counts.items() if count] == [0]
