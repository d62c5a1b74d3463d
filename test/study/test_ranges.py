"""What an input may be, in Python and as somebody types it."""

import numpy as np
import pytest

from pool_sim_ros.study.ranges import (
    Normal,
    Uniform,
    checked_range,
    is_random,
    normal,
    range_of_text,
    row_of,
    uniform,
)


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('2.5', 2.5),
        ('-1e-1', -0.1),
        ('1,2,4', [1.0, 2.0, 4.0]),
        ('0:360:5', [0.0, 90.0, 180.0, 270.0, 360.0]),
        ('uniform(0,360)', Uniform(0.0, 360.0)),
        (' normal( 2 , 0.1 ) ', Normal(2.0, 0.1)),
    ],
)
def test_what_somebody_types(text, expected):
    found = range_of_text('speed', text)
    if isinstance(expected, list):
        np.testing.assert_array_equal(found, expected)
    else:
        assert found == expected


def test_a_row_of_means_is_a_row_that_is_random():
    found = range_of_text('angle', 'normal(0:10:3,0.5)')
    assert is_random(found) and row_of(found).tolist() == [0.0, 5.0, 10.0]
    assert not is_random(2.0) and row_of(2.0) is None and row_of(uniform(0, 1)) is None


@pytest.mark.parametrize(
    'text',
    ['', 'x', '0:360', '0:360:0', '0:360:-3', '0:360:1e3', '1,,2', 'nan', '1,inf', 'uniform(2,1)']
    + ['uniform(1)', 'normal(1,-1)', 'normal(uniform(0,1),1)', '0:0:3', '1,1', '0:1:999999999999'],
)
def test_what_cannot_be_is_told_in_one_line(text):
    with pytest.raises(ValueError, match='^speed') as told:
        range_of_text('speed', text)
    assert '\n' not in str(told.value)


@pytest.mark.parametrize(
    'given', [None, 'abc', [[1, 2]], [], np.nan, {'a': 1}, object(), [1, 'x'], np.zeros(3)]
)
def test_a_value_that_is_none_names_its_input(given):
    with pytest.raises(ValueError, match='^side: '):
        checked_range('side', given)


def test_laws_refuse_what_is_no_number():
    for wrong in (
        lambda: uniform('a', 1),
        lambda: normal(0, np.inf),
        lambda: normal(uniform(0, 1), 1),
    ):
        with pytest.raises(ValueError):
            wrong()
