"""The inputs of a sweep by name, and what is said of those that are none."""

import numpy as np
import pytest

from pool_sim_ros.physics import pool_table, report_table
from pool_sim_ros.study.inputs import (
    checked_inputs,
    coefficients_of,
    cue,
    known_inputs,
    named_inputs,
    polar,
    rows_of,
    strike_of,
    xy,
    xyz,
)


def given(velocity=None, spin=None, cue=None, place=None, **others):
    return named_inputs(velocity, spin, cue, place, others)


def test_each_argument_gives_names():
    assert given(polar(1, 2)) == {'angle': 1, 'speed': 2}
    assert given(xy(1, 2)) == given((1, 2)) == {'vx': 1, 'vy': 2}
    assert given(spin=xyz(z=3)) == {'wx': 0.0, 'wy': 0.0, 'wz': 3}
    assert given(place={'9': xy(1, 2)}) == {'x_9': 1, 'y_9': 2}
    assert given(cue=cue(1, 2))['cue_speed'] == 1


def test_inputs_of_the_table_come_first():
    table = report_table()
    inputs = checked_inputs(table, {'angle': [1, 2], 'speed': 1, 'e_ball_ball': [0.8, 0.9, 1.0]})
    assert rows_of(inputs) == {'e_ball_ball': 3, 'angle': 2}
    assert list(inputs) == ['e_ball_ball', 'angle', 'speed']


def test_tables_have_the_coefficients_of_their_motion():
    assert 'mu_slide' in coefficients_of(pool_table('7ft'))
    assert 'mu_slide' not in coefficients_of(report_table())
    assert 'length' not in coefficients_of(report_table())
    assert 'wx' in known_inputs(pool_table('7ft')) and 'wx' not in known_inputs(report_table())


@pytest.mark.parametrize(
    ('names', 'said'),
    [
        ({}, 'velocity: it is missing'),
        ({'angle': 1}, 'speed: it is missing'),
        ({'vx': 1}, 'vy: it is missing'),
        ({'angle': 1, 'speed': 1, 'vx': 1, 'vy': 1}, 'given twice'),
        ({'angle': 1, 'sped': 1}, 'sped: there is no such input; did you mean speed'),
        ({'sample': 1}, 'sample: there is no such input; did you mean samples'),
        ({'angle': 1, 'speed': 1, 'x_9': 1}, "place of ball '9': give both"),
        ({'angle': 1, 'speed': 1, 'x_99': 1, 'y_99': 2}, 'x_99: there is no such input'),
        ({'angle': 1, 'speed': 1, 'wz': 1}, 'wz: there is no such input'),
        ({'cue_speed': 1}, 'azimuth: it is missing'),
    ],
)
def test_what_does_not_go_together_is_told(names, said):
    with pytest.raises(ValueError, match=said) as told:
        checked_inputs(report_table(), names)
    assert '\n' not in str(told.value)


def test_a_cue_spins_the_ball_by_itself():
    with pytest.raises(ValueError, match='spin: a cue'):
        checked_inputs(pool_table('7ft'), {'cue_speed': 1, 'azimuth': 0, 'wz': 1})
    filled = checked_inputs(pool_table('7ft'), {'cue_speed': 1, 'azimuth': 0})
    assert filled['side'] == filled['above'] == filled['elevation'] == 0.0
    assert strike_of(filled) == 'cue'


@pytest.mark.parametrize(
    'velocity', [3, 'fast', (1, 2, 3), None.__class__, np.zeros((2, 2, 2)), [1]]
)
def test_a_velocity_that_is_none(velocity):
    with pytest.raises(ValueError):
        checked_inputs(report_table(), given(velocity))


@pytest.mark.parametrize('place', [3, {'9': 3}, [1, 2]])
def test_a_place_that_is_none(place):
    with pytest.raises(ValueError, match='^place'):
        given(polar(1, 2), place=place)
