"""The path of a ball as a line to be drawn: its corners, and enough points where it is curved."""

import numpy as np
import pytest
from paths import distance_to_way
from segments import by_hand
from tables import random_shots, table_of

from pool_sim_ros.physics import INTEGRATORS, report_table, simulate


def farthest_from(path, points):
    """Return how far the farthest of some points is from a path, m."""
    return max(distance_to_way(path, point) for point in points)


def samples(shot, ball, count=2001):
    return shot.positions(np.linspace(0.0, shot.duration, count))[:, ball]


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_the_path_of_a_straight_shot_is_its_corners(integrator):
    table = table_of([(0.5, 0.5)], e_ball_cushion=1.0, mu_ball_cushion=0.0)
    shot = simulate(table, (3.0, 1.5), integrator=integrator, time_slice=1e-5)
    path = shot.path(0)
    cushions = shot.events[shot.events['kind'] == 1]
    assert len(cushions) > 2
    np.testing.assert_allclose(path[0], (0.5, 0.5))
    np.testing.assert_allclose(path[-1], shot.final_positions[0], atol=1e-9)
    corners = shot.positions(cushions['t'])[:, 0]
    np.testing.assert_allclose(path[1 : len(corners) + 1], corners, rtol=0, atol=1e-12)
    if integrator == 'event':
        assert len(path) == len(cushions) + 2
    # In slices a ball rests within a slice, and is written down again at the end of it.
    assert np.abs(path[len(corners) + 1 :] - path[-1]).max() < 1e-9


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_paths_pass_through_all_positions(integrator):
    # In slices a ball may jump by some of its motion within one: 3 m/s times 1e-5 s.
    slack = 1e-9 if integrator == 'event' else 3e-5
    for table, velocities in random_shots(67, 2, 'report', mu_ball_surface=0.2):
        shot = simulate(table, velocities, integrator=integrator, time_slice=1e-5)
        for ball in range(6):
            path = shot.path(ball)
            assert np.any(np.diff(path, axis=0) != 0.0, axis=1).all()
            assert farthest_from(path, samples(shot, ball, 301)) < slack


def test_the_path_of_a_ball_that_never_moves_is_a_point():
    shot = simulate(report_table(), (-0.1, 0.0))
    assert shot.path(5).tolist() == [report_table().positions[5].tolist()]


def test_the_path_of_a_shot_that_is_cut_ends_there():
    shot = simulate(report_table(), (-4.0, 0.0), until=0.2)
    path = shot.path(0)
    np.testing.assert_array_equal(path[-1], shot.final_positions[0])
    assert farthest_from(path, samples(shot, 0, 101)) < 1e-12


CURVES = {
    'thrown': (1.0, 0.5, 0.0, -2.0),
    'from rest': (0.0, 0.0, 1.0, 0.5),
    'slides and turns': (1.0, 0.0, -1.0, 0.1),
    'turns at the end': (1.0, 0.0, -1.0, 0.01),
    'a weak curve': (1.0, 0.0, -0.1, 1e-3),
    'straight': (2.0, 1.0, -0.5, -0.25),
    'comes back on its line': (1.0, 0.5, -2.0, -1.0),
    'ends where it turns': (1.0, 0.0, -1.0, 0.0),
}


@pytest.mark.parametrize('curve', CURVES)
def test_a_curved_path_is_within_the_sag(curve):
    shot = by_hand([(0, 0.0, 0.5, 0.5, *CURVES[curve])], 1.0)
    path = shot.path(0)
    assert farthest_from(path, samples(shot, 0)) < 1e-5 * (1 + 1e-6)


@pytest.mark.parametrize(
    ('curve', 'most'),
    # A step h sags a h^2 / 8, with the a across it: so many equal steps, and the end.
    [
        ('thrown', 160),
        ('slides and turns', 114),
        ('turns at the end', 114),
        ('a weak curve', 6),
        ('straight', 2),
        ('comes back on its line', 3),
        ('ends where it turns', 2),
    ],
)
def test_a_curved_path_has_no_more_points_than_that_needs(curve, most):
    assert len(by_hand([(0, 0.0, 0.5, 0.5, *CURVES[curve])], 1.0).path(0)) <= most


def test_a_curve_between_two_straight_parts():
    segments = [
        (0, 0.0, 0.2, 0.5, 1.0, 0.0, 0.0, 0.0),
        (0, 0.5, 0.7, 0.5, 1.0, 0.0, 0.0, 1.0),
        (0, 1.0, 1.2, 0.625, 1.0, 0.5, 0.0, 0.0),
    ]
    shot = by_hand(segments, 1.5)
    path = shot.path(0)
    assert farthest_from(path, samples(shot, 0)) < 1e-5 * (1 + 1e-6)
    assert [0.7, 0.5] in path.tolist() and [1.2, 0.625] in path.tolist()
    inside = (path[:, 0] > 0.7) & (path[:, 0] < 1.2)
    assert inside.sum() == len(path) - 4
