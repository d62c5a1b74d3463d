"""Which ball is next, against the least of all times."""

import numpy as np
import pytest
from numba import njit

from pool_sim_ros.physics.event_driven.event_queue import first, new_queue, reschedule


@njit
def compiled_first(queue):
    return first(queue)


@njit
def compiled_reschedule(queue, i, t):
    reschedule(queue, i, t)


@pytest.mark.parametrize('n', [1, 2, 3, 7, 8, 11, 64, 100])
def test_the_earliest_is_first(n):
    rng = np.random.default_rng(n)
    queue, times = new_queue(n), np.full(n, np.inf)
    assert compiled_first(queue)[0] == np.inf
    for _ in range(20 * n):
        i = int(rng.integers(n))
        times[i] = rng.choice([np.inf, 0.0, 1.0, rng.random()])
        compiled_reschedule(queue, i, times[i])
        t, ball = compiled_first(queue)
        assert t == times.min()
        if t < np.inf:
            assert times[ball] == t


@pytest.mark.parametrize('n', [2, 5, 8])
def test_all_leave_in_order(n):
    times = np.random.default_rng(n).permutation(n).astype(float)
    queue = new_queue(n)
    for i, t in enumerate(times):
        compiled_reschedule(queue, i, t)
    for expected in np.argsort(times):
        assert compiled_first(queue) == (times[expected], expected)
        compiled_reschedule(queue, expected, np.inf)
    assert compiled_first(queue)[0] == np.inf


def test_who_is_first_of_several_at_once_depends_on_no_history():
    """Else a shot would not repeat to the last bit in a work area that is kept."""
    rng = np.random.default_rng(3)
    used = new_queue(11)
    for _ in range(50):
        for _ in range(40):
            compiled_reschedule(used, int(rng.integers(11)), rng.choice([0.0, 1.0, np.inf]))
        for i in range(11):
            compiled_reschedule(used, i, np.inf)
        fresh = new_queue(11)
        for _ in range(20):
            i, t = int(rng.integers(11)), rng.choice([0.0, 1.0, np.inf])
            compiled_reschedule(used, i, t)
            compiled_reschedule(fresh, i, t)
            if compiled_first(fresh)[0] < np.inf:
                assert compiled_first(used) == compiled_first(fresh)
