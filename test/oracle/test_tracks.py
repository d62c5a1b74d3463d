"""Tracks: their shapes."""

import math

import numpy as np
import pytest

from pool_sim_ros.oracle import Track


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        (([0.0, 1.0], np.zeros((3, 2, 2))), r'shapes \(2,\) and \(3, 2, 2\)'),
        (([0.0], np.zeros((1, 2, 3))), r'must be \(k,\) and \(k, n, 2\)'),
        (([1.0, 0.0], np.zeros((2, 2, 2))), 'times must be finite and rise'),
        (([0.0, 0.0], np.zeros((2, 2, 2))), 'times must be finite and rise'),
        (([0.0, math.inf], np.zeros((2, 2, 2))), 'times must be finite and rise'),
        ((['soon'], np.zeros((1, 2, 2))), 'times are not an array of numbers'),
        (([0.0], np.zeros((1, 2, 2)), [1.0, 2.0]), 'must be three finite numbers'),
        (([0.0], np.zeros((1, 2, 2)), [1.0, 2.0, math.nan]), 'must be three finite numbers'),
    ],
)
def test_what_is_no_track(arguments, message):
    with pytest.raises(ValueError, match=f'^track: .*{message}'):
        Track(*arguments)
