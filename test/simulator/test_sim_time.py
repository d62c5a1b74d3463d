from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pool_sim_ros.simulator.sim_time import (
    NANOSECOND,
    SECOND_NS,
    seconds_to_stamp,
    stamp_to_seconds,
    tick_to_stamp,
)

CENTURY = 100 * 365 * 86400


@given(st.integers(1, 1000), st.integers(0, 10**9))
def test_the_stamp_of_a_tick_is_its_exact_time_rounded_down(rate, tick):
    exact = Fraction(tick, rate) * 10**9
    assert 0 <= exact - tick_to_stamp(tick, rate) < 1


def test_a_second_has_a_thousand_million_nanoseconds():
    assert SECOND_NS == 10**9 == pytest.approx(1.0 / NANOSECOND)
    assert tick_to_stamp(60, 60) == SECOND_NS
    assert stamp_to_seconds(SECOND_NS) == 1.0


@given(st.integers(0, 10**15))
def test_a_stamp_comes_back_through_seconds(stamp):
    assert seconds_to_stamp(stamp_to_seconds(stamp)) == stamp


@given(st.floats(0.0, CENTURY))
def test_the_stamp_of_a_time_is_the_nearest(seconds):
    exact = Fraction(seconds) * 10**9
    assert abs(exact - seconds_to_stamp(seconds)) <= Fraction(1, 2) + exact * Fraction(1, 2**53)


@given(st.lists(st.integers(0, 10**18), max_size=5))
def test_many_stamps_are_turned_into_seconds_as_each_alone(stamps):
    seconds = stamp_to_seconds(np.array(stamps, dtype=np.int64))
    assert seconds.tolist() == [stamp_to_seconds(stamp) for stamp in stamps]
