"""A ball at rest in the mouth of a pocket lies on the table; one behind a cushion does not."""

import dataclasses

import numpy as np
import pytest
from numba import njit

from pool_sim_ros.physics import check_layout, pool_table, simulate, simulate_many
from pool_sim_ros.physics.boundary.mouths import distance_from_way, is_cut_off


@njit
def cut_off(boundary, x, y, radius):
    return is_cut_off(boundary, x, y, radius)


@njit
def off_the_way(x, y, end_x, end_y, px, py):
    return distance_from_way(x, y, end_x, end_y, px, py)


@pytest.fixture
def lonely():
    """A seven-foot table with the cue ball alone."""
    table = pool_table('7ft')
    return dataclasses.replace(table, balls=table.balls[:1])


@pytest.mark.parametrize(
    ('place', 'free'),
    [
        ((1.01879, -0.0101662), True),  # where a ball was left, in a side pocket's mouth
        ((0.9906, -0.003), True),
        ((0.5, -0.05), False),  # behind a rail
        ((0.5, -0.2), False),
        ((0.9906, -0.2), False),  # beyond a pocket
        ((-0.2, -0.2), False),
        ((3.0, 0.5), False),
    ],
)
def test_the_way_to_the_rectangle(place, free, lonely):
    boundary, radius = lonely.for_kernels.boundary, lonely.balls[0].radius
    assert cut_off(boundary, *place, radius) != free
    if free:
        check_layout(lonely, np.array([place]))
    else:
        with pytest.raises(ValueError, match='outside'):
            check_layout(lonely, np.array([place]))


def test_the_distance_from_a_way_against_many_points_on_it():
    rng = np.random.default_rng(1)
    for _ in range(200):
        start, end, point = rng.normal(size=(3, 2))
        parts = np.linspace(0.0, 1.0, 4001)[:, np.newaxis]
        expected = np.hypot(*((1 - parts) * start + parts * end - point).T).min()
        assert off_the_way(*start, *end, *point) == pytest.approx(expected, abs=1e-3)
    assert off_the_way(1.0, 1.0, 1.0, 1.0, 4.0, 5.0) == 5.0


def test_a_game_goes_on_from_wherever_the_balls_have_come_to_rest():
    table = pool_table('7ft')
    rng = np.random.default_rng(2)
    angle, speed = rng.normal(0.0, 0.3, 200), rng.uniform(2.0, 10.0, 200)
    velocities = speed[:, np.newaxis] * np.column_stack([-np.cos(angle), np.sin(angle)])
    outcomes = simulate_many(table, velocities)
    assert (outcomes.pocketed >= 0).any()
    for finals, pocketed in zip(outcomes.finals, outcomes.pocketed, strict=True):
        struck = int(np.flatnonzero(pocketed < 0)[0])
        next_velocities = np.zeros((len(finals), 2))
        next_velocities[struck] = 0.5, 0.2
        shot = simulate(table, next_velocities, positions=finals)
        caught = pocketed >= 0
        assert np.array_equal(shot.pocketed[caught], pocketed[caught])
        np.testing.assert_array_equal(shot.final_positions[caught], finals[caught])
