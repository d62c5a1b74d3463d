import math
from dataclasses import replace

import pytest

from pool_sim_ros.physics import report_table
from pool_sim_ros.simulator.parameter_table import PARAMETERS, Change, default_values, parameters_of
from pool_sim_ros.simulator.parameter_values import ParameterError, values_from
from pool_sim_ros.simulator.settings import build_settings, values_of
from pool_sim_ros.simulator.shot_request import Phase
from pool_sim_ros.simulator.simulation import Simulation

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


def test_the_settings_are_those_of_the_print_with_the_report_table_integrator_and_slice():
    report = settings_from({})
    assert report.deviations == []
    for name, value in (
        ('report_integrator', 'event'),
        ('time_slice', 1e-5),
        ('table', replace(report.table, e_cue_ball=0.95)),
    ):
        assert len(replace(report, **{name: value}).deviations) == 1
    assert replace(report, integrator='time_slice').deviations == []


def test_a_message_is_short_however_long_the_labels_are():
    values = default_values()
    values['balls.labels'] = [f'{k}' + 'x' * 100_000 for k in range(11)]
    values['balls.positions'] = [0.5] * 22
    with pytest.raises(ParameterError, match=r"ball '0x+") as error:
        build_settings(values)
    assert len(str(error.value)) < 500


def edges_at_start():
    """Yield (name, value) for both ends of each range of what is fixed at start-up."""
    for name, spec in parameters_of('disc').items():
        if spec.change is Change.NEVER and type(spec.default) in (int, float):
            for edge in (spec.least, spec.most):
                yield name, type(spec.default)(edge)


@pytest.mark.parametrize(('name', 'edge'), list(edges_at_start()))
def test_a_table_at_the_edge_of_a_range_is_refused_in_a_line_or_answers_every_shot(name, edge):
    for beyond in (math.nextafter(edge, -math.inf), math.nextafter(edge, math.inf)):
        if not PARAMETERS[name].least <= beyond <= PARAMETERS[name].most:
            with pytest.raises(ParameterError, match=name):
                settings_from({name: beyond})
    try:
        settings = settings_from({name: edge, 'time_slice': 1e-4})
    except ParameterError as error:
        assert '\n' not in str(error) and edge == PARAMETERS[name].least
        return
    simulation = Simulation(settings)
    for request in ('1', '{"velocity": [-1.0, 0.1]}'):
        accepted, job = simulation.request(request)
        assert accepted.phase is Phase.ACCEPTED
        preempted = simulation.computed(job, job.run())
        assert all(response.reason for response in preempted)
        while not (preempted or simulation.at_rest):
            simulation.next_frame()
