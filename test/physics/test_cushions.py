"""`Cushions`: what is accepted, and what is equal."""

import math

import numpy as np
import pytest

from pool_sim_ros.physics import Cushions

SEGMENTS = [(0.0, 0.0, 1.0, 0.0, 0.0, 1.0), (1.0, 0.5, 1.0, 0.0, -1.0, 0.0)]
NOSES = [(1.0, 1.0, 0.02), (0.0, 0.0, 0.0)]


def test_arrays_are_copies_and_read_only():
    given = np.array(SEGMENTS)
    cushions = Cushions(given, NOSES)
    given[0, 0] = 5.0
    np.testing.assert_array_equal(cushions.segments, SEGMENTS)
    np.testing.assert_array_equal(cushions.noses, NOSES)
    for values in (cushions.segments, cushions.noses):
        with pytest.raises(ValueError, match='read-only'):
            values[0, 0] = 1.0


def test_none_of_a_kind_is_right_too():
    assert Cushions([], []).segments.shape == (0, 6)
    assert Cushions(SEGMENTS, []).noses.shape == (0, 3)


def test_equal_numbers_are_equal():
    one = Cushions(SEGMENTS, NOSES)
    assert one == Cushions(np.array(SEGMENTS), np.array(NOSES))
    assert hash(one) == hash(Cushions(SEGMENTS, NOSES))
    minus = [(0.0, -0.0, 1.0, 0.0, -0.0, 1.0), SEGMENTS[1]]
    assert one == Cushions(minus, NOSES) and hash(one) == hash(Cushions(minus, NOSES))
    assert one != Cushions(SEGMENTS[::-1], NOSES)
    assert one != Cushions(SEGMENTS, NOSES[:1])
    assert one != 'cushions'


@pytest.mark.parametrize(
    ('segments', 'noses', 'start'),
    [
        ([(0.0, 0.0, 1.0, 0.0)], [], 'cushions.segments: an array of shape (1, 4)'),
        ([0.0] * 6, [], 'cushions.segments: an array of shape (6,)'),
        ('none', [], "cushions.segments: 'none'"),
        ([(0.0, math.nan, 1.0, 0.0, 0.0, 1.0)], [], 'cushions.segments[0]: '),
        ([*SEGMENTS, (1.0, 1.0, 1.0, 1.0, 0.0, 1.0)], [], 'cushions.segments[2]: both ends'),
        ([(0.0, 0.0, 1.0, 0.0, 0.0, 2.0)], [], 'cushions.segments[0]: (0.0, 2.0)'),
        ([(0.0, 0.0, 1.0, 0.0, 1.0, 0.0)], [], 'cushions.segments[0]: (1.0, 0.0)'),
        (SEGMENTS, [(0.0, 0.0)], 'cushions.noses: an array of shape (1, 2)'),
        (SEGMENTS, [(0.0, 0.0, math.inf)], 'cushions.noses[0]: '),
        (SEGMENTS, [(0.0, 0.0, 0.1), (0.0, 0.0, -0.1)], 'cushions.noses[1]: radius -0.1'),
    ],
)
def test_what_is_refused(segments, noses, start):
    with pytest.raises(ValueError) as caught:
        Cushions(segments, noses)
    assert str(caught.value).startswith(start) and '\n' not in str(caught.value)
