"""`table.preset`: a name makes a whole table, racked, and what else is given counts before it."""

import numpy as np
import pytest
from parameter_files import CONFIG, from_file

from pool_sim_ros.physics import POOL_TABLES, pool_table, report_table
from pool_sim_ros.simulator.parameter_table import parameters_of
from pool_sim_ros.simulator.parameter_values import ParameterError, values_from
from pool_sim_ros.simulator.settings import build_settings, values_of

BALLS = {
    'balls.labels': ['C', 'red'],
    'balls.masses': [0.17, 0.17],
    'balls.radii': [0.028575, 0.028575],
    'balls.positions': [0.3, 0.3, 1.0, 0.4],
    'balls.colors': [1.0, 1.0, 1.0, 0.5, 0.0, 0.25],
}
SPIN = {
    'table.motion': 'ball',
    'table.ball_friction': 'coulomb',
    'table.mu_slide': 0.2,
    'table.mu_roll': 0.01,
    'table.mu_spin': 0.01,
    'table.nose_height': 0.07,
}


def settings_from(overrides):
    return build_settings(values_from(overrides))


@pytest.mark.parametrize('name', POOL_TABLES)
def test_a_name_alone_is_the_table_of_that_name_racked(name):
    values = values_from({'table.preset': name})
    settings = build_settings(values)
    assert settings.table == pool_table(name) and settings.preset == name
    assert values_of(settings) == values and set(values) == set(parameters_of('ball'))
    assert (settings.integrator, settings.report_integrator) == ('event', 'event')


@pytest.mark.parametrize('name', POOL_TABLES)
def test_the_file_of_a_table_says_what_its_name_says(name):
    given = from_file(CONFIG / f'{name}.yaml')
    assert values_from(given) == values_from({'table.preset': name})
    numbers = {key for key, spec in parameters_of('ball').items() if type(spec.default) is float}
    assert numbers - {'time_slice'} <= set(given)  # so that a copy can change each


def test_each_parameter_that_is_given_counts_before_the_preset():
    settings = settings_from({'table.preset': '7ft', 'table.mu_roll': 0.02, **BALLS})
    assert settings.table.mu_roll == 0.02 and settings.table.mu_slide == 0.2
    assert settings.table.labels == ('C', 'red')
    np.testing.assert_array_equal(settings.table.pockets, pool_table('7ft').pockets)


def test_a_table_without_pockets_may_have_another_size_and_is_racked_for_it():
    table = settings_from({'table.preset': 'carom', 'table.length': 3.0}).table
    assert table.positions[0, 0] == 0.75 * 3.0


def test_balls_may_spin_on_the_table_of_the_report():
    table = settings_from(SPIN).table
    assert table.motion == 'ball' and table.balls == report_table().balls
    assert table.cushions is None and len(table.pockets) == 0


@pytest.mark.parametrize(
    ('given', 'words'),
    [
        ({'table.preset': '7 ft'}, ['table.preset', '8ft', 'snooker', "mean '7ft'"]),
        ({'table.preset': 'Snoker'}, ['table.preset', "mean 'snooker'"]),
        ({'table.preset': 7}, ['table.preset', '7ft']),
        ({'table.preset': ''}, ['table.preset', 'report']),
        ({'table.presett': '7ft'}, ['table.presett', 'mean table.preset?']),
        ({'table.motion': 'balls'}, ['table.motion', "mean 'ball'"]),
        ({'table.motion': 'ball'}, ['table.ball_friction', 'coulomb']),
        ({**SPIN, 'table.mu_slide': -1.0}, ['table.mu_slide']),
        ({k: v for k, v in SPIN.items() if k != 'table.mu_spin'}, ['table.mu_spin', 'missing']),
        ({'table.preset': '7ft', 'table.motion': 'disc'}, ['table.motion', '7ft']),
        ({'table.preset': '7ft', 'table.length': 3.0}, ['table.length', '1.9812', 'segments']),
        ({'table.mu_slide': 0.2}, ['table.mu_slide', 'ball', 'disc']),
        ({'table.preset': '9ft', 'table.mu_ball_surface': 0.1}, ['table.mu_ball_surface']),
        ({'table.preset': '9ft', 'report_integrator': 'time_slice'}, ['report_integrator']),
        ({'table.preset': '9ft', 'table.ball_friction': 'report'}, ['ball_friction', 'alciatore']),
        ({'table.ball_friction': 'alciatore'}, ['ball_friction', 'coulomb']),
        ({'table.preset': '7ft', 'table.pockets': [1.0, 2.0]}, ['table.pockets', '3']),
        ({'table.preset': '7ft', 'table.cushion_segments': [0.0] * 6}, ['segments[0]']),
        ({'table.preset': '7ft', 'table.nose_height': 1.0}, ['nose_height']),
        ({'table.preset': '7ft', 'balls.labels': ['C']}, ['balls.masses', 'missing']),
        ({'table.preset': 'carom', 'table.length': 0.03}, ['outside']),
    ],
)
def test_what_contradicts_or_is_missing_is_refused_in_one_line(given, words):
    with pytest.raises(ParameterError) as error:
        settings_from(given)
    assert '\n' not in str(error.value)
    for word in words:
        assert word in str(error.value), str(error.value)
