"""The fields of a request: what is taken, and what is told of all else."""

import json

import pytest

from pool_sim_ros.simulator.request_fields import (
    FieldError,
    NotFiniteError,
    cue_from,
    numbers_from,
    places_from,
    quote,
)


def test_numbers_are_read_as_floats():
    assert numbers_from('spin', [1, 2.5, -3], 'xyz', 'rad/s') == (1.0, 2.5, -3.0)
    assert numbers_from('velocity', [10**400, 0], 'xy', 'm/s') == (float('inf'), 0.0)


@pytest.mark.parametrize('value', [None, 1, [1], [1, 2, 3, 4], [1, 2, '3'], [1, 2, True], {}])
def test_other_values_are_told_what_would_be_right(value):
    with pytest.raises(FieldError, match=r'^spin must be three numbers, \[x, y, z\] in rad/s$'):
        numbers_from('spin', value, 'xyz', 'rad/s')


def test_a_cue_has_speed_and_azimuth_and_what_else_is_given():
    assert cue_from({'azimuth': 180, 'speed': 2}) == {'speed': 2.0, 'azimuth': 180.0}
    full = {'speed': 2.0, 'azimuth': 180.0, 'elevation': 5.0, 'side': 0.2, 'above': -0.3}
    assert cue_from(full) == full


@pytest.mark.parametrize(
    ('cue', 'words'),
    [
        (None, 'object'),
        ([2, 180], 'object'),
        ({}, 'no speed'),
        ({'speed': 1}, 'no azimuth'),
        ({'speed': 1, 'azimuth': '0'}, 'azimuth must be a number'),
        ({'speed': True, 'azimuth': 0}, 'speed must be a number'),
        ({'speed': 1, 'azimuth': 0, 'sid': 0.1}, '"sid"'),
    ],
)
def test_a_cue_of_another_form_is_told_what_would_be_right(cue, words):
    with pytest.raises(FieldError, match=f'^cue.*{words}') as error:
        cue_from(cue)
    assert '\n' not in str(error.value)


def test_places_are_read_by_label():
    assert places_from({'9': [0.5, 1], 'C': [1.0, 0.25]}) == {'9': (0.5, 1.0), 'C': (1.0, 0.25)}


@pytest.mark.parametrize('value', [None, {}, [], {'9': 0.5}, {'9': [0.5]}, {'9': ['a', 'b']}])
def test_places_of_another_form_are_told_what_would_be_right(value):
    with pytest.raises(FieldError, match=r'^place.*\[x, y\]'):
        places_from(value)


@pytest.mark.parametrize('text', ['NaN', 'Infinity', '-Infinity', '1e999'])
def test_what_is_not_finite_is_named(text):
    with pytest.raises(NotFiniteError, match='azimuth'):
        cue_from(json.loads(f'{{"speed": 1, "azimuth": {text}}}'))
    with pytest.raises(NotFiniteError, match='"9"'):
        places_from(json.loads(f'{{"9": [0.5, {text}]}}'))


def test_a_long_text_is_cut():
    assert quote('a"b') == '"a\\"b"' and len(quote('x' * 10_000)) < 60
