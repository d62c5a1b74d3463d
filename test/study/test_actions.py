"""What comes out of a policy."""

import re

import numpy as np
import pytest

from pool_sim_ros.study.actions import checked_actions


def test_numbers_of_any_type_are_taken():
    for given in ([1, 0], np.array([1.0, 0.0], np.float32), (True, 0)):
        found = checked_actions(given, (2,))
        assert found.dtype == np.float64 and found.tolist() == [1.0, 0.0]


@pytest.mark.parametrize(
    ('given', 'message'),
    [
        ([1.0], 'action: shape (1,) must be (2,), numbers from -1 to 1'),
        (0.5, 'action: shape () must be (2,)'),
        (None, 'action: shape () must be (2,)'),
        ('left', "action: 'left' is not an array of numbers"),
        ([[1.0], [0.0, 1.0]], 'action: [[1.0], [0.0, 1.0]] is not an array of numbers'),
        ([1.0, np.nan], 'action: nan is not a number from -1 to 1'),
        ([np.inf, 0.0], 'action: inf is not a number from -1 to 1'),
    ],
)
def test_what_is_no_action_is_refused(given, message):
    with pytest.raises(ValueError, match='^' + re.escape(message)):
        checked_actions(given, (2,))
