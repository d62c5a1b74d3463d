import math
from array import array

import pytest

from pool_sim_ros.simulator.parameter_table import PARAMETERS, default_values
from pool_sim_ros.simulator.parameter_values import (
    ParameterError,
    coerce,
    coerce_all,
    values_from,
)

TWO_BALLS = {
    'balls.labels': ['C', 'red'],
    'balls.masses': [0.2, 0.1],
    'balls.radii': [0.05, 0.03],
    'balls.positions': [0.2, 0.3, 1.0, 0.4],
    'balls.colors': [1.0, 1.0, 1.0, 0.5, 0.0, 0.25],
}


def test_whole_numbers_do_for_floats():
    assert (coerce('max_cue_speed', 5), type(coerce('max_cue_speed', 5))) == (5.0, float)
    assert (coerce('publish_rate', 30.0), type(coerce('publish_rate', 30.0))) == (30, int)
    masses = coerce('balls.masses', [1, 2])
    assert masses == [1.0, 2.0] and all(type(mass) is float for mass in masses)


@pytest.mark.parametrize(
    ('name', 'text', 'value'),
    [
        ('time_slice', '1e-6', 1e-6),
        ('time_slice', ' 1E-6 ', 1e-6),
        ('max_cue_speed', '5', 5.0),
        ('max_cue_speed', '+.5e1', 5.0),
        ('publish_rate', '30', 30),
        ('step_ticks', '1e2', 100),
        ('start_paused', 'true', True),
        ('publish_clock', 'False', False),
        ('balls.masses', ['1e-1', 0.2, '1'], [0.1, 0.2, 1.0]),
        ('record', '1e-6', '1e-6'),
        ('frame_id', 'true', 'true'),
        ('balls.labels', ['1', '1e-6'], ['1', '1e-6']),
    ],
)
def test_a_string_may_spell_a_number_or_a_truth_unless_strings_are_wanted(name, text, value):
    coerced = coerce(name, text)
    assert coerced == value and type(coerced) is type(value)


def test_a_list_may_be_any_row_of_numbers():
    assert coerce('balls.masses', array('d', [0.5, 0.25])) == [0.5, 0.25]
    assert coerce('balls.labels', ('C', 'red')) == ['C', 'red']


def test_some_values_are_each_coerced_and_an_unknown_name_is_refused():
    assert coerce_all({'time_slice': 1e-3, 'step_ticks': 2.0}) == {
        'time_slice': 1e-3,
        'step_ticks': 2,
    }
    with pytest.raises(ParameterError, match='speed is not a parameter'):
        coerce_all({'speed': 1.0})


def test_both_ends_of_a_range_are_inside():
    for name, least, most in (('table.e_cue_ball', 0.0, 1.0), ('publish_rate', 1, 1000)):
        assert (coerce(name, least), coerce(name, most)) == (least, most)
        for outside in (math.nextafter(least, -math.inf), math.nextafter(most, math.inf)):
            with pytest.raises(
                ParameterError, match=f'{name} must be .* from {least:g} to {most:g}'
            ):
                coerce(name, outside)


@pytest.mark.parametrize('name', [name for name, spec in PARAMETERS.items() if spec.smallest])
def test_a_range_that_begins_at_0_has_no_numbers_that_are_almost_0(name):
    spec = PARAMETERS[name]
    assert spec.least == 0.0 < spec.smallest
    assert coerce(name, 0) == coerce(name, 0.0) == coerce(name, -0.0) == 0.0
    assert coerce(name, spec.smallest) == spec.smallest
    for tiny in (5e-324, 1e-311, 2.3e-308, 1e-200, math.nextafter(spec.smallest, 0.0)):
        with pytest.raises(ParameterError, match=rf'{name} must be .*at least {spec.smallest:g}'):
            coerce(name, tiny)


def test_no_range_has_denormals():
    for name, spec in PARAMETERS.items():
        if isinstance(spec.default, float):
            assert spec.least > 1e-9 or (spec.least == 0.0 and spec.smallest > 1e-9), name


def test_a_long_value_is_cut_in_the_message():
    with pytest.raises(ParameterError) as error:
        coerce('integrator', 'x' * 10_000)
    assert len(str(error.value)) < 200


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('table.length', 'long'),
        ('table.length', -1.0),
        ('table.length', float('nan')),
        ('table.gravity', float('inf')),
        ('table.gravity', 0.0),
        ('table.mu_ball_surface', 0.0),
        ('table.mu_ball_ball', -0.1),
        ('table.e_cue_ball', 1.5),
        ('table.ball_friction', 'none'),
        ('integrator', 'euler'),
        ('report_integrator', ''),
        ('time_slice', 0.0),
        ('time_slice', 1.0),
        ('max_cue_speed', 0.0),
        ('max_cue_speed', 10**400),
        ('max_shot_duration', True),
        ('real_time_factor', -1.0),
        ('step_ticks', 0),
        ('step_ticks', 1.5),
        ('publish_rate', 0),
        ('publish_rate', 59.94),
        ('frame_id', ''),
        ('frame_id', 7),
        ('publish_clock', 1),
        ('start_paused', 'yes'),
        ('balls.labels', []),
        ('balls.labels', [1, 2]),
        ('balls.labels', 'C1'),
        ('balls.masses', None),
        ('balls.masses', 0.2),
        ('balls.masses', [10**400]),
        ('balls.positions', ['x', '0.2']),
        ('time_slice', 'small'),
        ('time_slice', ''),
        ('time_slice', 'nan'),
        ('real_time_factor', 'inf'),
        ('real_time_factor', '1_0'),
        ('real_time_factor', '0x10'),
        ('real_time_factor', '\u0661'),
        ('real_time_factor', '1 0'),
        ('step_ticks', '1.5'),
        ('step_ticks', 'true'),
        ('publish_clock', '1'),
        ('publish_clock', ''),
        ('max_cue_speed', {'a': [[[[[[1]]]]]]}),
        ('frame_id', '/table'),
        ('frame_id', 1e-6),
    ],
)
def test_a_value_that_cannot_be_is_refused_by_name(name, value):
    with pytest.raises(ParameterError, match=rf'^{name}(\[0\])? must be') as error:
        coerce(name, value)
    assert '\n' not in str(error.value)


@pytest.mark.parametrize('name', ['max_cue_speed', 'step_ticks', 'balls.radii', 'frame_id'])
def test_huge_values_are_refused_by_name_in_short_time(name):
    deep = {'a': []}
    deep['a'].append(deep)
    text = '9' * 5_000_000
    for value in (10**5000, -(10**5000), [10**5000], {10**5000: 1}, deep, [[[[[[1]]]]]]):
        with pytest.raises(ParameterError, match=name) as error:
            coerce(name, value)
        assert len(str(error.value)) < 200
    if name != 'frame_id':
        for value in (text, text + 'x', '9' * 400, [text]):
            with pytest.raises(ParameterError, match=name):
                coerce(name, value)


def test_one_list_of_balls_needs_all():
    with pytest.raises(ParameterError, match=r'balls\.masses is missing'):
        values_from({'balls.labels': ['C']})
    values = {name: value for name, value in TWO_BALLS.items() if name != 'balls.radii'}
    with pytest.raises(ParameterError, match=r'balls\.radii is missing'):
        values_from(values)


def test_a_misspelt_name_is_refused_with_the_right_one():
    with pytest.raises(ParameterError, match=r'table\.lenght .* table\.length'):
        values_from({'table.lenght': 2.0})
    with pytest.raises(ParameterError, match=r'balls\.mass .* balls\.masses'):
        values_from({'balls.mass': 2.0})


def test_what_belongs_to_other_nodes_is_left_alone():
    others = {'use_sim_time': True, 'other_node.x': 1, 'table.frame': 'map', 'balls.quux': 2.0}
    assert values_from(others) == default_values()
    assert values_from({'real_time_facter': 2.0}) == default_values()  # a node warns of it
