"""Orientations looked up in rows are those looked up at once, up to the sign."""

import numpy as np
import pytest

from pool_sim_ros.physics import cue_strike, pool_table, simulate
from pool_sim_ros.simulator.turning import Turning

SAME = 1e-6  # rad: what an orientation is off at most


@pytest.fixture(scope='module')
def shot():
    table = pool_table('7ft')
    velocity, spin = cue_strike(table, speed=9.0, azimuth=180.3, side=0.2, above=0.3)
    return simulate(table, velocity, spins=spin)


def start_of(shot, seed=3):
    turned = np.random.default_rng(seed).normal(size=(len(shot.table.balls), 4))
    return turned / np.linalg.norm(turned, axis=1, keepdims=True)


@pytest.mark.parametrize('length', [1, 7, 64, 1000])
def test_rows_of_any_length_are_the_orientations_of_the_shot(shot, length):
    start, times = start_of(shot), np.append(np.arange(0.0, shot.duration, 1 / 60), shot.duration)
    turning = Turning(shot, start)
    rows = [turning.at(times[k : k + length]) for k in range(0, len(times), length)]
    turned, right = np.concatenate(rows), shot.orientations(times, start)
    np.testing.assert_allclose(np.linalg.norm(turned, axis=2), 1.0, rtol=0, atol=1e-12)
    nearest = np.minimum(
        np.linalg.norm(turned - right, axis=2), np.linalg.norm(turned + right, axis=2)
    )
    assert 2.0 * nearest.max() < SAME  # a small angle is twice the distance
    assert np.all(np.sum(turned[1:] * turned[:-1], axis=2) >= 0.0)


def test_a_row_of_no_times_changes_nothing(shot):
    start = start_of(shot)
    turning, other = Turning(shot, start), Turning(shot, start)
    assert turning.at(np.empty(0)).shape == (0, *start.shape)
    times = np.array([0.1, 0.2])
    assert np.array_equal(turning.at(times), other.at(times))
