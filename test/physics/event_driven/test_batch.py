"""Shots one after another in one call, and the work area of a single one."""

import threading

import numpy as np
import pytest
from benchmark.workloads import dense_table, random_velocities

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.physics.event_driven import batch
from pool_sim_ros.physics.event_driven.batch import (
    WorkArea,
    mark,
    play_parts,
    play_some,
    work_area,
)
from pool_sim_ros.physics.event_driven.state import new_state, start_of
from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.log import EVENT, N_EVENTS, new_log
from pool_sim_ros.physics.outcomes import PLAYED, Ends, new_outcomes

NO_LIMITS = (np.inf, 100_000)


def ends_of(outcomes):
    return Ends(*(getattr(outcomes, name) for name in Ends._fields))


def in_rows(velocities):
    return np.array(velocities, dtype=float).reshape(-1, 1, 2)


def test_a_work_area_makes_room_for_long_shots():
    table = dense_table(60, decelerating=True)
    velocities = np.random.default_rng(1).normal(size=(60, 2))
    area = WorkArea(table)
    for _ in range(2):
        shot = area.play(velocities, None, NO_LIMITS)
        assert shot.n_events > batch.FIRST_ROOM + 60
        assert len(shot.events) == shot.n_events
        assert shot.events.tobytes() == simulate(table, velocities).events.tobytes()
    short = area.play(np.zeros((1, 2)), None, NO_LIMITS)
    assert short.n_events == 0 and short.events.base.nbytes == 0


def test_what_a_work_area_returned_stays():
    table = report_table()
    area = WorkArea(table)
    first = area.play(np.array([(-4.0, 0.0)]), None, NO_LIMITS)
    kept = [array.copy() for array in (first.events, first.segments, first.final_positions)]
    area.play(np.array([(3.0, 1.0)]), None, NO_LIMITS)
    for array, copy in zip(
        (first.events, first.segments, first.final_positions), kept, strict=True
    ):
        assert array.tobytes() == copy.tobytes()


def test_a_thread_keeps_one_work_area():
    tables = report_table(), report_table()
    area = work_area(tables[0])
    assert work_area(tables[0]) is area
    others = []
    worker = threading.Thread(target=lambda: others.append(work_area(tables[0])))
    worker.start()
    worker.join()
    assert others[0] is not area
    assert work_area(tables[1]) is not area
    assert work_area(tables[0]) is not area, 'it has played on another table since'


def test_the_work_area_of_a_large_table_is_not_kept(monkeypatch):
    monkeypatch.setattr(batch, 'KEPT_BALLS', 10)
    table = report_table()
    assert work_area(table) is not work_area(table)


@pytest.mark.parametrize('room', [0, 10, 30, 50, 10_000])
def test_some_shots_are_played_until_there_is_no_room_for_their_events(room):
    table = report_table()
    velocities = in_rows([(-4.0, 0.0), (0.0, 0.0), (-4.0, 0.0), (-0.1, 0.0)])
    counts = np.array([24, 0, 24, 1])
    state = new_state(table.for_kernels, table.balls_at_rest, new_log(100, 0))
    outcomes, events = new_outcomes(4, 11, None), np.empty(room, EVENT)
    outcomes.durations[:] = -7.0
    done, filled = play_some(
        state,
        start_of(state),
        (velocities, np.empty((4, 0, 2))),
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


def test_a_shot_that_outgrows_the_log_is_not_taken():
    table = report_table()
    state = new_state(table.for_kernels, table.balls_at_rest, new_log(5, 0))
    outcomes = new_outcomes(2, 11, None)
    done, filled = play_some(
        state,
        start_of(state),
        (in_rows([(-0.1, 0.0), (-4.0, 0.0)]), np.empty((2, 0, 2))),
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


@pytest.mark.parametrize('shared', [False, True])
@pytest.mark.parametrize('wanted', [False, True])
def test_only_the_parts_that_are_given_are_played(wanted, shared):
    table, velocities = report_table(), random_velocities(10, seed=4)
    outcomes = new_outcomes(10, 11, None)
    ends = ends_of(outcomes)
    ends.failed[:] = 9
    store, told = EventStore(10) if wanted else None, []
    parts = [slice(0, 4), slice(4, 5)]
    play_parts(
        table,
        table.balls_at_rest,
        (in_rows(velocities), np.empty((10, 0, 2))),
        NO_LIMITS,
        ends,
        iter(parts),
        shared,
        store,
        told.append,
    )
    assert told == [4, 1]
    assert ends.failed.tolist() == [PLAYED] * 5 + [9] * 5
    shots = [simulate(table, velocity) for velocity in velocities[:5]]
    for k, shot in enumerate(shots):
        assert ends.finals[k].tobytes() == shot.final_positions.tobytes()
    if wanted:
        assert store.joined().tobytes() == b''.join(shot.events.tobytes() for shot in shots)
