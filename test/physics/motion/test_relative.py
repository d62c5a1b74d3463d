"""The same motion a little later."""

import numpy as np
from numba import njit

from pool_sim_ros.physics.motion import RelativeMotion, after


@njit
def later(motion, t):
    return after(motion, t)


def test_later_it_is_where_its_parabola_leads():
    rng = np.random.default_rng(1)
    for _ in range(200):
        place, velocity, acceleration = rng.normal(size=(3, 2))
        t = rng.uniform(0.0, 3.0)
        found = later(RelativeMotion(*place, *velocity, *acceleration), t)
        np.testing.assert_allclose(found[:2], place + velocity * t + acceleration * t**2 / 2)
        np.testing.assert_allclose(found[2:4], velocity + acceleration * t, atol=1e-14)
        assert found[4:] == tuple(acceleration)


def test_two_steps_are_one():
    rng = np.random.default_rng(2)
    for _ in range(200):
        motion = RelativeMotion(*rng.normal(size=6))
        s, t = rng.uniform(0.0, 2.0, 2)
        np.testing.assert_allclose(later(later(motion, s), t), later(motion, s + t), atol=1e-12)


def test_no_time_changes_nothing():
    motion = RelativeMotion(1.0, -2.0, 3.0, -4.0, 5.0, -6.0)
    assert later(motion, 0.0) == motion
