"""Tables on which balls spin: what must be given, what may not be, and what the kernels get."""

import math

import numpy as np
import pytest
from spin_tables import SPINNING, spin_table
from tables import table_of, under

from pool_sim_ros.physics import Ball, Cushions, pool_table
from pool_sim_ros.physics.boundary import PocketedBoundary, Rectangle
from pool_sim_ros.physics.law_names import CUSHION_MODELS
from pool_sim_ros.physics.motion import BALL, RESTS

SPOTS = [(0.5, 0.5), (1.0, 0.5)]
COEFFICIENTS = ('mu_slide', 'mu_roll', 'mu_spin', 'nose_height')
FRAME = Cushions([(0.0, 0.0, 2.0, 0.0, 0.0, 1.0)], [(0.0, 0.0, 0.01)])


def refusal(make, *arguments, **fields):
    """Return the one line with which something is refused."""
    with pytest.raises(ValueError) as caught:
        make(*arguments, **fields)
    message = str(caught.value)
    assert message and '\n' not in message
    return message


@pytest.mark.parametrize('name', COEFFICIENTS)
def test_a_coefficient_that_is_missing_is_named(name):
    message = refusal(spin_table, SPOTS, **{name: None})
    assert message.startswith(f'{name}: ') and "motion 'ball' needs it" in message


@pytest.mark.parametrize('name', COEFFICIENTS)
@pytest.mark.parametrize('value', [-0.1, math.nan, math.inf, 2e3, 'smooth', [0.1]])
def test_a_coefficient_out_of_its_range_is_named_with_its_value(name, value):
    message = refusal(spin_table, SPOTS, **{name: value})
    assert message.startswith(f'{name}: ') and str(value)[:4] in message


@pytest.mark.parametrize('name', ['mu_slide', 'mu_roll'])
def test_a_cloth_that_would_take_for_ever(name):
    assert refusal(spin_table, SPOTS, **{name: 1e-300}).startswith(f'{name}: 1e-300 must be 0 or')


@pytest.mark.parametrize('name', ['mu_ball_ball', 'mu_ball_cushion'])
def test_friction_at_contacts_is_checked_as_on_any_table(name):
    assert refusal(spin_table, SPOTS, **{name: -0.25}).startswith(f'{name}: -0.25')


@pytest.mark.parametrize('height', [0.025, 0.1, 0.0, 0.5])
def test_a_nose_that_would_pass_the_ball_by(height):
    """Half a radius and two are the ends, and out."""
    message = refusal(spin_table, SPOTS, nose_height=height)
    assert message.startswith(f'nose_height: {height:g} must be between 0.025 and 0.1')
    for inside in (0.0251, 0.0999):
        assert spin_table(SPOTS, nose_height=inside).nose_height == inside


def test_balls_of_unequal_radius_are_named():
    balls = (*spin_table(SPOTS).balls, Ball('small', 0.16, 0.04, (1.5, 0.5)))
    message = refusal(under, spin_table(SPOTS), balls=balls)
    assert message.startswith("ball 'small': radius 0.04 must be 0.05")


def test_balls_of_unequal_mass_are_allowed():
    balls = (*spin_table(SPOTS).balls, Ball('heavy', 0.3, 0.05, (1.5, 0.5)))
    assert under(spin_table(SPOTS), balls=balls).masses[2] == 0.3


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('motion', 'rolling'),
        ('motion', None),
        ('ball_friction', 'report'),
        ('ball_friction', 'none'),
        ('cushion_model', 'hard'),
        ('cushion_model', 3),
        ('friction_bound', 'pooltool'),
        ('friction_bound', None),
    ],
)
def test_an_unknown_name_is_named_with_what_there_is(name, value):
    message = refusal(spin_table, SPOTS, **{name: value})
    assert message.startswith(f'{name}: {value!r}') and 'must be' in message


@pytest.mark.parametrize(
    ('name', 'value'),
    [(name, 0.03) for name in COEFFICIENTS]
    + [('cushions', FRAME), ('pockets', [(0.0, 0.0, 0.06)])],
)
def test_a_table_of_discs_has_none_of_this(name, value):
    assert refusal(table_of, SPOTS, **{name: value}).startswith(f'{name}: only a table of motion')


def test_discs_know_no_law_of_balls():
    message = refusal(table_of, SPOTS, ball_friction='alciatore')
    assert message.startswith("ball_friction: 'alciatore' is not a law of motion 'disc'")


@pytest.mark.parametrize(
    ('pockets', 'words'),
    [
        ([(0.0, 0.0)], 'pockets: an array of shape'),
        ([(0.0, 0.0, -0.06)], r'pockets[0]: radius -0.06 must be at least 0'),
        ([(0.0, math.nan, 0.06)], 'pockets[0]: [0.0, nan, 0.06] is not finite'),
        ('six', 'pockets: '),
    ],
)
def test_pockets_that_are_none(pockets, words):
    assert refusal(spin_table, SPOTS, cushions=FRAME, pockets=pockets).startswith(words)


def test_pockets_need_cushions_that_leave_room():
    assert refusal(spin_table, SPOTS, pockets=[(0.0, 0.0, 0.06)]).startswith('pockets: ')


def test_cushions_must_be_cushions():
    assert refusal(spin_table, SPOTS, cushions=[(0.0, 0.0)]).startswith('cushions: ')


def test_what_the_kernels_know():
    table = spin_table(SPOTS, mu_ball_ball=0.06, e_ball_cushion=0.85, cushion_model='mathavan')
    known = table.for_kernels
    assert known.boundary == Rectangle(2.0, 1.0)
    assert known.slide == pytest.approx(0.2 * 9.80665)
    assert known.roll == pytest.approx(0.01 * 9.80665)
    # I = 2/5 m R^2 per mass, and the torque is mu_spin m g: 5 mu_spin g / (2 R^2) with mu_spin in
    # m, where the field is that over R.
    assert known.spin == pytest.approx(5 * 0.0127 * 9.80665 / (2 * 0.05))
    assert (known.radius, known.cue_ball) == (0.05, 0)
    assert (known.rubbing.mu, known.edge.height) == (0.06, 0.0625)
    assert CUSHION_MODELS[known.edge.model] == 'mathavan'
    assert isinstance(pool_table('7ft').for_kernels.boundary, PocketedBoundary)
    assert isinstance(pool_table('carom').for_kernels.boundary, Rectangle)


def test_numba_compiles_once_for_all_values():
    tables = [spin_table(SPOTS), spin_table(SPOTS, mu_roll=0, e_ball_ball=1, cushion_model='han')]
    kinds = [[type(value) for value in table.for_kernels] for table in tables]
    assert kinds[0] == kinds[1]


def test_the_records_of_the_balls():
    records = spin_table(SPOTS).balls_at_rest
    assert records.dtype == BALL and records['is_cue'].tolist() == [1, 0]
    np.testing.assert_array_equal(records['x'], [0.5, 1.0])
    assert np.all(records['phase'] == RESTS) and np.all(records['pocket'] == -1)


@pytest.mark.parametrize('name', ['mu_slide', 'mu_roll', 'mu_spin'])
def test_a_table_on_which_something_never_ends(name):
    table = spin_table(SPOTS)
    assert table.comes_to_rest and not under(table, **{name: 0.0}).comes_to_rest


def test_tables_are_equal_by_value():
    assert pool_table('7ft') == pool_table('7ft') != pool_table('8ft')
    assert hash(pool_table('7ft')) == hash(pool_table('7ft'))
    assert spin_table(SPOTS) != spin_table(SPOTS, mu_spin=0.01)
    moved = pool_table('7ft').pockets + [0.0, 0.0, 1e-6]
    assert under(pool_table('7ft'), pockets=moved) != pool_table('7ft')


def test_the_fields_are_what_is_spelt_out():
    assert set(SPINNING) <= set(spin_table(SPOTS).__dataclass_fields__)
