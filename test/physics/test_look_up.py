"""Spins at any time, against a plain twin. `test_trajectory` has positions and velocities."""

import numpy as np
from spin_tables import spin_table

from pool_sim_ros.physics.log import SPIN_SEGMENT
from pool_sim_ros.physics.look_up import look_up_spins, segment_at

FADES = spin_table([(0.5, 0.5)]).for_kernels.spin


def random_segments(rng, balls=3):
    """Return segments in order of time, and for each ball its own as (first, order)."""
    segments = np.zeros(balls * 12, SPIN_SEGMENT)
    segments['ball'] = np.tile(np.arange(balls), 12)
    segments['t'] = np.sort(np.r_[np.zeros(balls), rng.uniform(0.0, 2.0, balls * 11)])
    for name in ('wx', 'wy', 'wz', 'turn_x', 'turn_y'):
        segments[name] = rng.normal(scale=30.0, size=len(segments))
    segments['wz'][rng.random(len(segments)) < 0.3] = 0.0
    order = np.argsort(segments['ball'], kind='stable')
    return segments, np.arange(balls + 1) * 12, order


def twin(segments, ball, t):
    own = [s for s in segments if s['ball'] == ball and s['t'] <= t]
    last = own[-1]
    elapsed = t - last['t']
    fallen = np.sign(last['wz']) * min(abs(last['wz']), FADES * elapsed)
    return (
        last['wx'] + last['turn_x'] * elapsed,
        last['wy'] + last['turn_y'] * elapsed,
        last['wz'] - fallen,
    )


def test_spins_are_those_of_the_twin():
    rng = np.random.default_rng(72)
    for _ in range(20):
        segments, first, order = random_segments(rng)
        times = np.r_[rng.uniform(0.0, 3.0, 40), segments['t']]
        found = np.empty((len(times), 3, 3))
        look_up_spins(segments, first, order, times, FADES, found)
        for k, t in enumerate(times):
            for ball in range(3):
                np.testing.assert_allclose(found[k, ball], twin(segments, ball, t), atol=1e-12)


def test_the_segment_at_a_time_is_the_last_that_has_begun():
    segments, first, order = random_segments(np.random.default_rng(73))
    for ball in range(3):
        for t in np.r_[segments['t'], segments['t'] + 1e-9, 1e300]:
            own = np.flatnonzero((segments['ball'] == ball) & (segments['t'] <= t))
            found = segment_at(segments, first, order, ball, t)
            if len(own):
                assert found == own[-1]
