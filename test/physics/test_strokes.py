"""Many strokes are those of `cue_strike`, one by one."""

import numpy as np
import pytest

from pool_sim_ros.physics import cue_strike, cue_strikes, pool_table
from pool_sim_ros.physics.strokes import unit_vectors


def test_each_stroke_is_that_of_cue_strike():
    table, rng = pool_table('7ft'), np.random.default_rng(1)
    given = [rng.uniform(*ends, 200) for ends in ((0, 5), (-400, 400), (0, 90), (-0.3, 0.3))]
    speed, azimuth, elevation, side = given
    velocities, spins = cue_strikes(table, speed, azimuth, elevation, side, 0.2)
    for k in range(200):
        velocity, spin = cue_strike(table, speed[k], azimuth[k], elevation[k], side[k], 0.2)
        np.testing.assert_allclose(velocities[k], velocity, rtol=0, atol=1e-14)
        np.testing.assert_allclose(spins[k], spin, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    'wrong', [{'side': 0.6}, {'side': 0.4, 'above': 0.4}, {'speed': -1}, {'elevation': 91}]
)
def test_a_stroke_that_cannot_be_is_nan(wrong):
    given = {'speed': [1.0, 2.0], 'azimuth': 10.0} | {k: [0.0, v] for k, v in wrong.items()}
    velocities, spins = cue_strikes(pool_table('7ft'), **given)
    assert np.isfinite(velocities[0]).all() and np.isfinite(spins[0]).all()
    assert np.isnan(velocities[1]).all() and np.isnan(spins[1]).all()


def test_directions_are_exact_at_right_angles_and_the_same_wherever_they_stand():
    x, y = unit_vectors(np.arange(-8, 9) * 90.0)
    turns = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    np.testing.assert_array_equal(np.stack([x, y], 1), [turns[k % 4] for k in range(-8, 9)])
    degrees = np.random.default_rng(2).uniform(-720, 720, 1001)
    both = np.array(unit_vectors(degrees))
    np.testing.assert_allclose(
        both, [np.cos(np.radians(degrees)), np.sin(np.radians(degrees))], atol=3e-15
    )
    pieces = [np.array(unit_vectors(degrees[k : k + 7])) for k in range(0, 1001, 7)]
    assert np.concatenate(pieces, axis=1).tobytes() == both.tobytes()
