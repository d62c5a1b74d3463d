"""Shots one after another in one call, until there is no room for their events."""

import numpy as np
import pytest
from batches import NO_LIMITS, ends_of, in_rows

from pool_sim_ros.physics import report_table
from pool_sim_ros.physics.event_driven.batch import mark, play_some
from pool_sim_ros.physics.event_driven.state import new_state, start_of
from pool_sim_ros.physics.log import EVENT, N_EVENTS, new_log
from pool_sim_ros.physics.outcomes import new_outcomes


@pytest.mark.parametrize('room', [10, 30, 50, 10_000])
def test_some_shots_are_played_until_there_is_no_room_for_their_events(room):
    table = report_table()
    velocities = in_rows([(-4.0, 0.0), (0.0, 0.0), (-4.0, 0.0), (-0.1, 0.0)])
    counts = np.array([24, 0, 24, 1])
    state = new_state(table.for_kernels, table.balls_at_rest, new_log(100, 0))
    outcomes, events = new_outcomes(4, 11, None), np.empty(room, EVENT)
    outcomes.durations[:] = -7.0
    done, filled, _ = play_some(
        state,
        start_of(state),
        (velocities, np.empty((4, 0, 3)), np.empty((4, 0, 2))),
        (0, 0),
        NO_LIMITS,
        (ends_of(outcomes), np.empty((11, 2)), events),
    )
    fit = int(np.searchsorted(np.cumsum(counts), room, side='right'))
    assert (done, filled) == (fit, counts[:fit].sum())
    assert outcomes.event_counts[:fit].tolist() == counts[:fit].tolist()
    assert np.all(outcomes.durations[:fit] >= 0.0) and np.all(outcomes.durations[fit:] == -7.0)
    if done < 4:
        assert state.log.counts[N_EVENTS] == counts[done], 'how much room it needs'


def test_without_room_for_events_all_shots_are_played():
    table = report_table()
    state = new_state(table.for_kernels, table.balls_at_rest, new_log(5, 0))
    outcomes = new_outcomes(2, 11, None)
    assert play_some(
        state,
        start_of(state),
        (in_rows([(-0.1, 0.0), (-4.0, 0.0)]), np.empty((2, 0, 3)), np.empty((2, 0, 2))),
        (0, 0),
        NO_LIMITS,
        (ends_of(outcomes), np.empty((11, 2)), np.empty(0, EVENT)),
    ) == (2, 0, True)
    assert outcomes.event_counts.tolist() == [1, 24]


def test_a_shot_that_outgrows_the_log_is_not_taken():
    table = report_table()
    state = new_state(table.for_kernels, table.balls_at_rest, new_log(5, 0))
    outcomes = new_outcomes(2, 11, None)
    done, filled, _ = play_some(
        state,
        start_of(state),
        (in_rows([(-0.1, 0.0), (-4.0, 0.0)]), np.empty((2, 0, 3)), np.empty((2, 0, 2))),
        (0, 0),
        NO_LIMITS,
        (ends_of(outcomes), np.empty((11, 2)), np.empty(1000, EVENT)),
    )
    assert (done, filled) == (1, 1) and state.log.counts[N_EVENTS] == 24


def test_a_failed_shot_is_marked_and_no_other():
    outcomes = new_outcomes(3, 4, None)
    for array in ends_of(outcomes):
        array[...] = 5
    mark(ends_of(outcomes), 1)
    assert np.isnan(outcomes.finals[1]).all() and np.isnan(outcomes.durations[1])
    assert outcomes.event_counts.tolist() == outcomes.first_hit.tolist() == [5, -1, 5]
    assert outcomes.failed.tolist() == [5, 5, 5]
    assert np.all(outcomes.finals[[0, 2]] == 5.0)
