import threading
from dataclasses import replace

import numpy as np
import pytest
from waiting import PATIENCE

from pool_sim_ros.physics import ShotCancelled, simulate
from pool_sim_ros.simulator.job import MOST_SLICES, make_job
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.settings import build_settings

SETTINGS = build_settings({**default_values(), 'time_slice': 1e-4})
VELOCITY = (-3.0, 0.4)
ELSEWHERE = SETTINGS.table.positions * [1.0, 0.98]


def test_a_report_shot_starts_from_the_start_layout_and_any_other_where_the_balls_are():
    start = SETTINGS.table.positions
    assert np.array_equal(make_job(SETTINGS, 2, VELOCITY, ELSEWHERE).positions, start)
    assert np.array_equal(make_job(SETTINGS, None, VELOCITY, ELSEWHERE).positions, ELSEWHERE)


def test_a_report_shot_has_an_integrator_of_its_own():
    settings = replace(SETTINGS, integrator='event', report_integrator='time_slice')
    assert make_job(settings, 1, VELOCITY, ELSEWHERE).integrator == 'time_slice'
    assert make_job(settings, None, VELOCITY, ELSEWHERE).integrator == 'event'


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
def test_it_computes_what_simulate_does_with_the_settings(integrator):
    table = replace(SETTINGS.table, e_ball_ball=0.9)
    settings = replace(SETTINGS, table=table, integrator=integrator)
    trajectory = make_job(settings, None, VELOCITY, ELSEWHERE).run()
    expected = simulate(
        table, VELOCITY, positions=ELSEWHERE, integrator=integrator, time_slice=1e-4
    )
    assert trajectory.complete
    assert np.array_equal(trajectory.final_positions, expected.final_positions)
    assert np.array_equal(trajectory.events, expected.events)


def test_a_shot_has_only_so_many_slices():
    settings = replace(SETTINGS, max_shot_duration=1e5, time_slice=1e-7, integrator='time_slice')
    assert make_job(settings, None, VELOCITY, ELSEWHERE).until == MOST_SLICES * 1e-7
    by_default = replace(settings, max_shot_duration=120.0)
    assert make_job(by_default, None, VELOCITY, ELSEWHERE).until == 120.0
    event = replace(settings, integrator='event')
    assert make_job(event, None, VELOCITY, ELSEWHERE).until == 1e5


def test_a_shot_that_is_being_computed_can_be_cancelled():
    table = replace(SETTINGS.table, mu_ball_surface=1e-4)
    settings = replace(
        SETTINGS, table=table, integrator='time_slice', time_slice=1e-7, max_shot_duration=1e5
    )
    job, ended = make_job(settings, None, VELOCITY, ELSEWHERE), []

    def run():
        with pytest.raises(ShotCancelled):
            job.run()
        ended.append(1)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    job.cancel()
    thread.join(PATIENCE)
    assert ended


def test_a_shot_is_cut_at_the_longest_duration():
    short = replace(SETTINGS, max_shot_duration=0.25)
    trajectory = make_job(short, None, VELOCITY, ELSEWHERE).run()
    assert not trajectory.complete and trajectory.duration == 0.25
