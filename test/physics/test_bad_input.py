"""Bad input raises ValueError that names the field and the value, and changes nothing."""

import dataclasses
import math

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.physics import Ball, Table, report_table, simulate, simulate_many

GOOD_BALL = dict(label='1', mass=0.16, radius=0.05, position=(0.5, 0.5))
GOOD_TABLE = dict(length=2.0, width=1.0, balls=(Ball(**GOOD_BALL),))


def one_line(caught):
    message = str(caught.value)
    assert message and '\n' not in message
    return message


@pytest.mark.parametrize(
    ('field', 'value', 'shown'),
    [
        ('mass', 0.0, '0'),
        ('mass', -0.1, '-0.1'),
        ('mass', math.nan, 'nan'),
        ('mass', math.inf, 'inf'),
        ('mass', 1e-320, 'at least 1e-09'),
        ('mass', 1e308, 'at most 1e+09'),
        ('mass', 'heavy', 'heavy'),
        ('mass', None, 'None'),
        ('radius', 0.0, '0'),
        ('radius', -1.0, '-1'),
        ('radius', 5e-10, 'at least 1e-06'),
        ('radius', 1e4, 'at most 1000'),
        ('radius', math.nan, 'nan'),
        ('position', (math.nan, 0.5), 'nan'),
        ('position', (0.5, -math.inf), 'inf'),
        ('position', (0.5,), '0.5'),
        ('position', (0.5, 0.5, 0.5), '0.5'),
        ('position', 'ab', 'ab'),
        ('position', 0.5, '0.5'),
        ('color', (0.0, 0.0, 1.5), '1.5'),
        ('color', (0.0, 0.0), '0.0'),
        ('color', (0.0, -0.1, 0.0), '-0.1'),
        ('label', '', "''"),
        ('label', 7, '7'),
    ],
)
def test_ball(field, value, shown):
    with pytest.raises(ValueError) as caught:
        Ball(**{**GOOD_BALL, field: value})
    message = one_line(caught)
    assert field in message
    assert shown in message


@pytest.mark.parametrize('field', ['length', 'width', 'gravity'])
@pytest.mark.parametrize('value', [0.0, -1.0, 1e300, math.nan, math.inf, 'wide', None])
def test_table_size(field, value):
    with pytest.raises(ValueError, match=f'{field}: .*{str(value)[:2]}') as caught:
        Table(**{**GOOD_TABLE, field: value})
    one_line(caught)


@pytest.mark.parametrize('field', ['mu_ball_ball', 'mu_ball_surface', 'mu_ball_cushion'])
@pytest.mark.parametrize('value', [-1e-9, 1e4, math.nan, math.inf, 'rough'])
def test_coefficients_of_friction(field, value):
    with pytest.raises(ValueError, match=f'{field}.*{value}') as caught:
        Table(**{**GOOD_TABLE, field: value})
    one_line(caught)


@pytest.mark.parametrize('values', [{'mu_ball_surface': 1e-300}, {'gravity': 1e-300}])
def test_a_cloth_that_would_take_for_ever(values):
    with pytest.raises(ValueError, match='at least') as caught:
        Table(**GOOD_TABLE, **values)
    assert next(iter(values)) in one_line(caught)


@pytest.mark.parametrize('field', ['e_cue_ball', 'e_ball_ball', 'e_ball_cushion'])
@pytest.mark.parametrize('value', [-0.01, 1.01, math.nan, math.inf])
def test_coefficients_of_restitution(field, value):
    with pytest.raises(ValueError, match=f'{field}.*{value}') as caught:
        Table(**{**GOOD_TABLE, field: value})
    one_line(caught)


@pytest.mark.parametrize('value', ['Coulomb', '', None, 3])
def test_law_of_friction(value):
    with pytest.raises(ValueError, match='ball_friction') as caught:
        Table(**GOOD_TABLE, ball_friction=value)
    message = one_line(caught)
    assert 'report' in message and 'coulomb' in message


@pytest.mark.parametrize('balls', [(), None, 3, ['ball'], [None]])
def test_balls_that_are_none(balls):
    with pytest.raises(ValueError, match='balls'):
        Table(2.0, 1.0, balls)


def test_the_same_label_twice():
    balls = [Ball(**GOOD_BALL), Ball(**{**GOOD_BALL, 'position': (1.0, 0.5)})]
    with pytest.raises(ValueError, match="label '1'"):
        Table(2.0, 1.0, balls)


@pytest.mark.parametrize(
    'spot', [(0.04, 0.5), (1.96, 0.5), (0.5, 0.04), (0.5, 0.96), (-1.0, 0.5), (9.0, 9.0)]
)
def test_a_ball_outside_is_named(spot):
    with pytest.raises(ValueError, match="'1'") as caught:
        table_of([(0.5, 0.5), spot])
    assert 'outside' in one_line(caught)


def test_balls_that_overlap_are_named():
    with pytest.raises(ValueError, match="'1'.*'2'") as caught:
        table_of([(0.3, 0.3), (0.5, 0.5), (0.5, 0.59)])
    assert 'overlap' in one_line(caught)


def test_touching_within_the_tolerance_is_allowed():
    touching = table_of([(0.05 - 9e-10, 0.5), (0.15 - 18e-10, 0.5)])
    assert len(touching.balls) == 2
    with pytest.raises(ValueError, match='overlap'):
        table_of([(0.5, 0.5), (0.6 - 1.1e-9, 0.5)])
    with pytest.raises(ValueError, match='outside'):
        table_of([(0.05 - 1.1e-9, 0.5)])


@pytest.mark.parametrize('solve', [simulate, simulate_many])
@pytest.mark.parametrize(
    ('argument', 'value'),
    [
        ('velocities', (math.nan, 0.0)),
        ('velocities', (0.0, math.inf)),
        ('velocities', (1.1e6, 0.0)),
        ('velocities', (0.0, -1e154)),
        ('velocities', (1e308, 1e308)),
        ('velocities', 3.0),
        ('velocities', (1.0, 2.0, 3.0)),
        ('velocities', [(1.0, 0.0, 0.0)] * 3),
        ('velocities', 'left'),
        ('velocities', None),
        ('velocities', [(1.0, 0.0), (1.0,)]),
        ('velocities', np.zeros((2, 2, 2, 2))),
        ('velocities', (1j, 0.0)),
        ('positions', [(0.5, 0.5)]),
        ('positions', [(0.5, 0.5), (0.55, 0.5)]),
        ('positions', [(0.5, 0.5), (9.0, 0.5)]),
        ('positions', [(0.5, 0.5), (math.nan, 0.5)]),
        ('positions', 'here'),
        ('integrator', 'euler'),
        ('integrator', None),
        ('time_slice', 0.0),
        ('time_slice', -1e-6),
        ('time_slice', 1e-300),
        ('time_slice', math.nan),
        ('time_slice', math.inf),
        ('time_slice', 'short'),
        ('until', -1.0),
        ('until', math.nan),
        ('until', 'noon'),
    ],
)
def test_simulate(solve, argument, value):
    table = table_of([(0.5, 0.5), (1.0, 0.5)])
    velocities = (1.0, 0.0) if solve is simulate else [(1.0, 0.0)]
    arguments = dict(velocities=velocities, integrator='time_slice', time_slice=1e-3)
    arguments[argument] = value
    with pytest.raises(ValueError) as caught:
        solve(table, arguments.pop('velocities'), **arguments)
    assert argument in one_line(caught)


def test_velocities_of_the_wrong_number_of_balls():
    table = table_of([(0.5, 0.5), (1.0, 0.5)])
    with pytest.raises(ValueError, match=r'velocities.*\(3, 2\)'):
        simulate(table, [(1.0, 0.0)] * 3)
    with pytest.raises(ValueError, match=r'velocities.*\(2, 3, 2\)'):
        simulate_many(table, [[(1.0, 0.0)] * 3] * 2)


@pytest.mark.parametrize('solve', [simulate, simulate_many])
@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
def test_without_surface_friction_until_is_required(solve, integrator):
    table = table_of([(0.5, 0.5)], mu_ball_surface=0.0)
    velocities = (1.0, 0.0) if solve is simulate else [(1.0, 0.0)]
    for until in (None, math.inf):
        with pytest.raises(ValueError, match='until'):
            solve(table, velocities, integrator=integrator, until=until)


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
def test_the_fastest_shot_that_is_taken(integrator):
    table = table_of([(0.5, 0.5), (1.0, 0.5)], mu_ball_surface=100.0)
    shot = simulate(table, (1e6, 3e5), integrator=integrator, time_slice=1e-3, until=1.0)
    assert np.isfinite(shot.final_positions).all() and np.isfinite(shot.final_velocities).all()


def test_a_clock_beyond_all_slices_is_no_limit():
    table = table_of([(0.5, 0.5)])
    shots = [
        simulate(table, (1.0, 0.0), integrator='time_slice', time_slice=1e-5, until=until)
        for until in (None, 1e30, 1e308)
    ]
    assert {shot.duration for shot in shots} == {shots[0].duration}


def test_the_table_is_not_to_be_changed():
    table = report_table()
    with pytest.raises(dataclasses.FrozenInstanceError):
        table.length = 3.0
    with pytest.raises(ValueError):
        table.positions[0] = 0.0
    with pytest.raises(ValueError, match='e_ball_ball'):
        dataclasses.replace(table, e_ball_ball=2.0)


def test_bad_input_leaves_the_arguments_alone():
    table = table_of([(0.5, 0.5), (1.0, 0.5)])
    positions = np.array([(0.5, 0.5), (0.55, 0.5)])
    before = positions.copy()
    with pytest.raises(ValueError):
        simulate(table, (1.0, 0.0), positions=positions)
    np.testing.assert_array_equal(positions, before)
