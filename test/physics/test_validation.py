"""Checks of what is given. `test_bad_input` has the messages of the public functions."""

import itertools
import math

import naive_shots
import numpy as np
import pytest
from tables import random_layout, random_table, table_of

from pool_sim_ros.physics import check_layout
from pool_sim_ros.physics.validation import array, is_bad, number, numbers

LIMIT = 1e-9


@pytest.mark.parametrize('value', [1, 1.0, '1', np.float32(1), np.int64(1), True, np.array(1.0)])
def test_numbers(value):
    found = number('x', value, least=1.0, most=1.0, above=0.5)
    assert found == 1.0 and type(found) is float


@pytest.mark.parametrize(
    ('value', 'limits', 'words'),
    [
        ('one', {}, "x: 'one' is not a number"),
        (None, {}, 'x: None is not a number'),
        ([], {}, 'x: [] is not a number'),
        (1j, {}, 'x: 1j is not a number'),
        (math.nan, {}, 'x: nan is not finite'),
        (-math.inf, {}, 'x: -inf is not finite'),
        (0.0, {'above': 0.0}, 'x: 0.0 must be above 0'),
        (0.5, {'least': 1.0}, 'x: 0.5 must be at least 1'),
        (2.5, {'most': 2.0}, 'x: 2.5 must be at most 2'),
    ],
)
def test_what_is_no_number_in_range(value, limits, words):
    with pytest.raises(ValueError) as caught:
        number('x', value, **limits)
    assert str(caught.value) == words


@pytest.mark.parametrize('values', [(1, 2), [1.0, 2.0], np.array([1, 2]), iter((1, 2))])
def test_several_numbers(values):
    assert numbers('x', values, 2, 1.0, 2.0) == (1.0, 2.0)


@pytest.mark.parametrize('values', ['12', (1,), (1, 2, 3), 3.0, None, (1, 'b'), (1, math.nan)])
def test_what_is_not_so_many_numbers(values):
    with pytest.raises(ValueError, match='^x: '):
        numbers('x', values, 2)


def test_arrays():
    assert array('x', [[1, 2], [3, 4]]).dtype == float
    for values in ('here', [[1], [1, 2]], [None, 'a']):
        with pytest.raises(ValueError, match='^x: '):
            array('x', values)


def test_complex_arrays_are_no_numbers():
    with pytest.raises(ValueError, match='^x: '):
        array('x', 1j * np.ones(2))


@pytest.mark.parametrize('count', [1, 2, 5, 12])
def test_layouts_against_every_pair(count):
    """Near the limit too: within rounding of 1e-9 m nothing is asked."""
    rng = np.random.default_rng(count)
    bad = 0
    table = random_table(rng, count)
    for trial in range(400):
        layout = random_layout(rng, table.radii, table.length, table.width)
        if count > 1 and trial % 2:
            bring_near(
                rng, table, layout, rng.choice([-1e-9, -2e-9, -1.01e-9, -0.99e-9, 0.0, 1e-3])
            )
        if trial % 5 == 0:
            layout[rng.integers(count)] = rng.uniform(-0.1, 2.0, 2)
        overlap = naive_shots.overlap(table, layout)
        if abs(overlap - LIMIT) < 1e-15:
            continue
        assert is_bad(table, layout) == (overlap > LIMIT)
        if overlap > LIMIT:
            with pytest.raises(ValueError, match='^positions: ball '):
                check_layout(table, layout)
            bad += 1
        else:
            check_layout(table, layout)
    assert 0 < bad < 400


def bring_near(rng, table, layout, gap):
    """Move one ball next to another, at a gap in m."""
    a, b = rng.permutation(len(layout))[:2]
    angle = rng.choice([rng.uniform(-math.pi, math.pi), 0.0, math.pi / 2])
    apart = table.radii[a] + table.radii[b] + gap
    layout[a] = layout[b] + apart * np.array([math.cos(angle), math.sin(angle)])


def test_the_message_names_the_two_and_how_deep():
    table = table_of([(0.5, 0.5), (1.0, 0.5), (1.5, 0.5)])
    for a, b in itertools.permutations(range(3), 2):
        layout = table.positions.copy()
        layout[a] = layout[b] + (0.08, 0.0)
        low, high = sorted((a, b))
        words = f"^spots: ball '{low}' and ball '{high}' overlap by 0.02 m$"
        with pytest.raises(ValueError, match=words):
            check_layout(table, layout, 'spots')


@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize('axis', [0, 1])
def test_a_place_that_is_nowhere(axis, value):
    table = table_of([(0.5, 0.5), (1.0, 0.5)])
    layout = table.positions.copy()
    layout[1, axis] = value
    assert is_bad(table, layout)
    with pytest.raises(ValueError, match="ball '1' is at .*not finite"):
        check_layout(table, layout)


def test_small_balls_hidden_behind_a_wide_one_are_found():
    """The sweep goes on as far as the widest ball reaches."""
    rng = np.random.default_rng(9)
    for _ in range(200):
        table = random_table(rng, 6)
        layout = random_layout(rng, table.radii, table.length, table.width)
        widest = int(table.radii.argmax())
        other = (widest + 1) % 6
        near = table.radii[[widest, other]].sum() * rng.uniform(0.95, 0.9999)
        angle = rng.uniform(-math.pi, math.pi)
        layout[other] = layout[widest] + near * np.array([math.cos(angle), math.sin(angle)])
        assert is_bad(table, layout)
