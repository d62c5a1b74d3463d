import pytest
from parameter_files import CONFIG, from_file

from pool_sim_ros.physics import report_table
from pool_sim_ros.simulator.settings import (
    PARAMETERS,
    ParameterError,
    build_settings,
    coerce,
    default_values,
    values_from,
    values_of,
)

TWO_BALLS = {
    'balls.labels': ['C', 'red'],
    'balls.masses': [0.2, 0.1],
    'balls.radii': [0.05, 0.03],
    'balls.positions': [0.2, 0.3, 1.0, 0.4],
    'balls.colors': [1.0, 1.0, 1.0, 0.5, 0.0, 0.25],
}


def settings_from(overrides):
    return build_settings(values_from(overrides))


def test_without_parameters_it_is_the_table_of_the_report():
    settings = settings_from({})
    assert settings.table == report_table()
    assert (settings.integrator, settings.report_integrator) == ('event', 'time_slice')
    assert (settings.publish_rate, settings.max_cue_speed) == (60, 15.0)


def test_the_report_file_says_every_parameter_and_is_the_table_of_the_report():
    values = from_file(CONFIG / 'report.yaml')
    assert set(values) == set(PARAMETERS)
    assert settings_from(values) == settings_from({})


def test_any_number_of_balls():
    table = settings_from(TWO_BALLS).table
    assert table.labels == ('C', 'red')
    red = table.balls[1]
    assert (red.mass, red.radius, red.position) == (0.1, 0.03, (1.0, 0.4))
    assert red.color == (0.5, 0.0, 0.25)
    assert [ball.is_cue for ball in table.balls] == [True, False]


def test_the_values_of_settings_make_the_settings_again():
    for overrides in ({}, TWO_BALLS, {'table.e_cue_ball': 0.3, 'record': 'x.log'}):
        values = values_from(overrides)
        assert values_of(build_settings(values)) == values


def test_whole_numbers_do_for_floats():
    assert settings_from({'table.length': 3}).table.length == 3.0
    assert isinstance(coerce('max_cue_speed', 5), float)
    assert coerce('publish_rate', 30.0) == 30
    values = {**TWO_BALLS, 'balls.masses': [1, 2]}
    assert settings_from(values).table.balls[1].mass == 2.0


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
        ('balls.positions', ['0.1', '0.2']),
    ],
)
def test_a_value_that_cannot_be_is_refused_by_name(name, value):
    with pytest.raises(ParameterError, match=rf'^{name}(\[0\])? must be') as error:
        coerce(name, value)
    assert '\n' not in str(error.value)


@pytest.mark.parametrize(
    ('changes', 'words'),
    [
        ({'balls.masses': [0.2]}, ['balls.masses', '1', '2']),
        ({'balls.positions': [0.2, 0.3, 1.0]}, ['balls.positions', '3', '4']),
        ({'balls.colors': [1.0] * 7}, ['balls.colors', '7', '6']),
        ({'balls.labels': ['C', '1', '2']}, ['balls.masses', '3']),
        ({'balls.masses': [0.2, float('nan')]}, ['balls.masses[1]', 'nan']),
        ({'balls.masses': [0.2, 0.0]}, ['red', 'mass']),
        ({'balls.radii': [-0.05, 0.03]}, ['C', 'radius']),
        ({'balls.colors': [1.0] * 5 + [255.0]}, ['red', 'color']),
        ({'balls.labels': ['C', 'C']}, ['C', 'label']),
        ({'balls.positions': [0.2, 0.3, 0.25, 0.3]}, ['C', 'red', 'overlap']),
        ({'balls.positions': [0.2, 0.3, 9.0, 0.3]}, ['red', 'outside']),
        ({'table.width': 0.1}, ['C', 'outside']),
    ],
)
def test_values_that_make_no_table_are_refused_naming_ball_or_field(changes, words):
    with pytest.raises(ParameterError) as error:
        settings_from({**TWO_BALLS, **changes})
    assert '\n' not in str(error.value)
    for word in words:
        assert word in str(error.value)


def test_one_list_of_balls_needs_all():
    with pytest.raises(ParameterError, match=r'balls\.masses is missing'):
        settings_from({'balls.labels': ['C']})
    values = {name: value for name, value in TWO_BALLS.items() if name != 'balls.radii'}
    with pytest.raises(ParameterError, match=r'balls\.radii is missing'):
        settings_from(values)


def test_a_misspelt_name_is_refused_with_the_right_one():
    with pytest.raises(ParameterError, match=r'table\.lenght .* table\.length'):
        values_from({'table.lenght': 2.0})
    with pytest.raises(ParameterError, match=r'balls\.quux'):
        values_from({'balls.quux': 2.0})
    assert values_from({'use_sim_time': True, 'other_node.x': 1}) == default_values()
