"""The space of aims: its bounds, its tips, and aims that are the same."""

import math
import re

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle.space import Space, checked_space
from pool_sim_ros.physics import pool_table

DISCS, POOL = table_of([(1.0, 0.5)]), pool_table('7ft')


def test_aims_are_put_within():
    space = Space((0.5, 4.0), 0.4)
    aims = np.array([[0.1, -30.0, 3.0, 0.3, 0.4], [9.0, 725.0, 0.0, 0.1, -0.1]])
    expected = [[0.5, 330.0, 0.0, 0.24, 0.32], [4.0, 5.0, 0.0, 0.1, -0.1]]
    np.testing.assert_allclose(space.within(aims), expected)
    assert aims[0, 0] == 0.1  # what was given stays


def test_tips_are_the_middle_alone_or_eight_more_that_hold():
    np.testing.assert_array_equal(Space((0.5, 4.0), 0.0).tips, [[0.0, 0.0]])
    assert Space((0.5, 4.0), 0.0).searched.tolist() == [0, 1]
    tips = Space((0.5, 4.0), 0.4).tips
    assert len(tips) == 9 and (np.hypot(*tips.T) <= 0.4).all()
    assert Space((0.5, 4.0), 0.4).searched.tolist() == [0, 1, 3, 4]


def test_aims_are_the_same_also_across_north():
    space = Space((0.5, 4.0), 0.0)
    aims = np.zeros((5, 5))
    aims[:, 0] = 2.0, 2.0, 2.15, 2.0, 2.05
    aims[:, 1] = 359.95, 0.05, 0.0, 180.0, 0.0
    apart = np.array([0.1, 0.2, 1.0, 1.0, 1.0])
    assert space.distinct(aims, np.arange(5), 5, apart).tolist() == [0, 2, 3]
    assert space.distinct(aims, np.arange(5)[::-1], 2, apart).tolist() == [4, 3]


@pytest.mark.parametrize(
    ('table', 'speeds', 'offset', 'message'),
    [
        (DISCS, (2.0, 1.0), 0.0, 'speeds: (2, 1) must rise'),
        (DISCS, (1.0, 1.0), 0.0, 'speeds: (1, 1) must rise'),
        (DISCS, (-1.0, 1.0), 0.0, 'speeds: (-1, 1) must rise, from 0'),
        (DISCS, (0.0, math.inf), 0.0, 'at most 1000'),
        (DISCS, (math.nan, 1.0), 0.0, 'speeds: (nan, 1)'),
        (DISCS, 5.0, 0.0, 'speeds: 5.0 must be the least and the greatest'),
        (DISCS, 'ab', 0.0, "speeds: 'ab' must be"),
        (POOL, (1.0, 2.0), 0.6, 'offset: 0.6 must be at least 0 and at most 0.5 radii'),
        (POOL, (1.0, 2.0), math.nan, 'offset: nan'),
        (POOL, (1.0, 2.0), None, 'offset: None is not a number'),
        (DISCS, (1.0, 2.0), 0.1, 'offset: discs do not spin'),
    ],
)
def test_what_is_no_space(table, speeds, offset, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        checked_space(table, speeds, offset)
