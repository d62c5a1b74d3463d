"""Trails follow paths that curve, in few lines."""

import math

import numpy as np
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

from pool_sim_ros.ros.trails import BEND, Trails

WHITE = ColorRGBA(r=1.0, g=1.0, b=1.0, a=1.0)


def drawn(points, curved):
    trails = Trails(Marker(), curved)
    for before, now in zip(points[:-1], points[1:], strict=True):
        trails.extend(0, WHITE, before, *now)
    ends = [(point.x, point.y) for point in trails.marker.points]
    assert len(trails.marker.colors) == len(ends)
    return list(zip(ends[::2], ends[1::2], strict=True))


def distance(point, start, end):
    """Distance of a point from a line between two points."""
    (px, py), (ax, ay), (bx, by) = point, start, end
    length = math.hypot(bx - ax, by - ay)
    if length == 0.0:
        return math.hypot(px - ax, py - ay)
    share = min(max(((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length**2, 0.0), 1.0)
    return math.hypot(px - ax - share * (bx - ax), py - ay - share * (by - ay))


def test_a_straight_way_is_one_line():
    points = [(0.1 * k, 0.05 * k) for k in range(50)]
    [line] = drawn(points, curved=True)
    np.testing.assert_allclose(line, (points[0], points[-1]))


def test_a_curve_is_lines_that_join_near_it():
    angles = np.linspace(0.0, math.pi, 200)
    points = [(math.cos(angle), math.sin(angle)) for angle in angles.tolist()]
    lines = drawn(points, curved=True)
    assert 10 < len(lines) < 60
    assert all(one[1] == other[0] for one, other in zip(lines[:-1], lines[1:], strict=True))
    assert (lines[0][0], lines[-1][1]) == (points[0], points[-1])
    for point in points:
        assert min(distance(point, *line) for line in lines) < BEND / 2


def test_a_ball_that_comes_back_on_its_way_leaves_the_whole_of_it():
    points = [(x, 0.5) for x in (0.0, 0.4, 0.6, 0.7, 0.6, 0.3)]
    lines = drawn(points, curved=True)
    assert lines == [((0.0, 0.5), (0.7, 0.5)), ((0.7, 0.5), (0.3, 0.5))]


def test_the_ways_of_discs_bend_only_at_contacts():
    trails = Trails(Marker(), curved=False)
    assert trails.marker.action == Marker.DELETE
    trails.extend(0, WHITE, (0.0, 0.0), 0.1, 0.0)
    trails.extend(0, WHITE, (0.1, 0.0), 0.1, 0.3)
    assert len(trails.marker.points) == 2
    trails.turn(0, WHITE, 0.2, 0.3)
    assert [point.x for point in trails.marker.points] == [0.0, 0.2, 0.2, 0.2]
    trails.clear()
    assert trails.marker.points == [] and trails.marker.action == Marker.DELETE
