"""Checks of what a caller gives."""

import math

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle.checks import checked_positions, time_allowed, whole

TABLE = table_of([(0.5, 0.5), (1.0, 0.5)])


def test_whole_numbers():
    assert whole('n', np.int64(5), 5) == 5 and type(whole('n', np.int64(5))) is int
    for wrong in (4, -1, 2**63):
        with pytest.raises(ValueError, match='^n: .* must be at least 5 and below'):
            whole('n', wrong, 5)
    for wrong in (5.0, '5', None, True):
        with pytest.raises(ValueError, match='^n: .* is not a whole number'):
            whole('n', wrong, 5)


def test_times():
    assert time_allowed(None) == math.inf and time_allowed('0.5') == time_allowed(0.5) == 0.5
    for wrong in (0, -1.0, math.nan, [], 'soon'):
        with pytest.raises(ValueError, match='^seconds: '):
            time_allowed(wrong)


def test_positions_are_a_copy_of_the_right_shape():
    places = checked_positions(TABLE, None)
    np.testing.assert_array_equal(places, TABLE.positions)
    places[0] = 9.0  # the table's own stay
    np.testing.assert_array_equal(checked_positions(TABLE, [[1, 2], [3, 4]]), [[1, 2], [3, 4]])
    for wrong in ([[1, 2]], [1, 2], np.zeros((2, 3)), [['a', 'b'], ['c', 'd']], [[1, 2], [3]]):
        with pytest.raises(ValueError, match='^positions: '):
            checked_positions(TABLE, wrong)
