import math

import pytest

from pool_sim_ros.simulator.naps import (
    BUSY_NAP,
    HEAD_START,
    LONGEST_NAP,
    SHORTEST_NAP,
    is_just_before,
    nap,
)


@pytest.mark.parametrize('busy', [False, True])
def test_a_nap_ends_a_head_start_before_the_frame_and_is_never_long(busy):
    assert nap(math.inf, busy) == nap(10.0, busy) == LONGEST_NAP
    assert nap(0.016, busy) == pytest.approx(0.016 - HEAD_START)
    assert nap(HEAD_START / 2, busy) == HEAD_START / 2


def test_where_a_frame_is_due_the_lock_is_free_for_longer_while_requests_keep_coming():
    for wait in (0.0, -1.0):
        assert nap(wait, busy=False) == SHORTEST_NAP < nap(wait, busy=True) == BUSY_NAP


def test_only_a_nap_of_its_whole_length_is_followed_by_a_short_one():
    assert is_just_before(0.016)
    assert not any(is_just_before(wait) for wait in (math.inf, 0.06, HEAD_START, 0.0, -1.0))
