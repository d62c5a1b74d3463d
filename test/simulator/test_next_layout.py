"""After a shot that leaves balls in each other, another one can be played."""

from dataclasses import replace

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.physics import check_layout
from pool_sim_ros.simulator import build_settings
from pool_sim_ros.simulator.next_layout import next_layout
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.shot_request import Phase
from pool_sim_ros.simulator.simulation import Simulation


def test_what_can_be_played_on_is_kept():
    table = table_of([(0.5, 0.5), (0.9, 0.5)])
    played = np.array([(0.3, 0.5), (0.9, 0.2)])
    found, reason = next_layout(table, played, table.positions)
    assert found is played and reason is None


def test_balls_in_each_other_are_moved_apart():
    table = table_of([(0.5, 0.5), (0.9, 0.5)])
    found, reason = next_layout(table, np.array([(0.5, 0.5), (0.52, 0.5)]), table.positions)
    check_layout(table, found)
    assert 'overlap by 0.08 m' in reason and 'moved apart' in reason and '\n' not in reason


def test_where_that_cannot_be_they_go_back(monkeypatch):
    monkeypatch.setattr('pool_sim_ros.physics.separation.MAX_SEPARATIONS', 0)
    table = table_of([(0.5, 0.5), (0.9, 0.5)])
    found, reason = next_layout(table, np.array([(0.5, 0.5), (0.52, 0.5)]), table.positions)
    assert found is table.positions and 'back' in reason


@pytest.fixture
def rack():
    """A cue ball, and ten balls that touch and hardly rebound."""
    rows = [
        (0.6 - 0.05 * np.sqrt(3) * i, 0.5 + 0.1 * (j - i / 2))
        for i in range(4)
        for j in range(i + 1)
    ]
    table = table_of([(1.5, 0.5), *rows], e_ball_ball=0.3)
    settings = build_settings(default_values())
    return Simulation(replace(settings, table=table, integrator='time_slice', time_slice=1e-4))


def play(simulation, text):
    response, job = simulation.request(text)
    assert response.phase is Phase.ACCEPTED
    answers = simulation.computed(job, job.run())
    while not answers:
        answers = simulation.next_frame()[1]
    return answers[-1]


def test_slices_that_let_balls_into_each_other_are_told_and_played_on(rack):
    first = play(rack, '{"id": "a", "velocity": [-3.0, 0.01]}')
    assert first.phase is Phase.DONE and 'moved apart' in first.reason
    shown = rack.next_frame()[0].positions
    check_layout(rack.settings.table, shown)
    second = play(rack, '{"id": "b", "velocity": [-1.0, 0.2]}')
    assert second.phase is Phase.DONE
