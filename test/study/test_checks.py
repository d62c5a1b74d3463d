"""What comes out of a policy."""

import re

import numpy as np
import pytest

from pool_sim_ros.study.checks import checked_actions, counted, positive


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


def test_numbers_above_0_are_taken():
    assert positive('within', '0.5', 'm') == 0.5 and positive('speed', 3, 'm/s', 3.0) == 3.0


@pytest.mark.parametrize('value', [0, -1.0, np.nan, np.inf, None, 'x', [1.0, 2.0], 9.0])
def test_what_is_no_number_above_0_is_refused(value):
    message = f'speed: {value!r} must be above 0 and at most 8 m/s'
    with pytest.raises(ValueError, match=f'^{re.escape(message)}$'):
        positive('speed', value, 'm/s', 8.0)


@pytest.mark.parametrize('value', [0, -1, 2.0, '3', None, True, [4]])
def test_what_is_no_whole_number_is_refused(value):
    message = f'num_envs: {value!r} must be a whole number, at least 1'
    with pytest.raises(ValueError, match=f'^{re.escape(message)}$'):
        counted('num_envs', value)


def test_whole_numbers_of_numpy_are_taken():
    assert counted('num_envs', np.int64(7)) == 7
