"""What `simulate_many` says of each shot beside its end: its events and what the cue ball hits."""

import dataclasses

import naive_shots
import numpy as np
import pytest
from benchmark.workloads import dense_table, random_velocities
from tables import LAWS, random_velocity, table_of

from pool_sim_ros.physics import INTEGRATORS, cores, report_table, simulate, simulate_many
from pool_sim_ros.physics.event_driven import batch, parts

COARSE = {'time_slice': 1e-3}


def events_one_by_one(table, velocities, **options):
    return [simulate(table, velocity, **options).events for velocity in velocities]


def assert_same_events(outcomes, expected):
    counts = [len(events) for events in expected]
    assert outcomes.offsets.tolist() == np.concatenate([[0], np.cumsum(counts)]).tolist()
    assert outcomes.event_counts.tolist() == counts
    assert outcomes.events.tobytes() == b''.join(events.tobytes() for events in expected)


@pytest.mark.parametrize('threads', [1, 2])
@pytest.mark.parametrize('law', LAWS)
def test_all_events_are_those_of_the_shots_one_by_one(law, threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 37)
    table = dataclasses.replace(report_table(), ball_friction=law)
    velocities = random_velocities(500, seed=2)
    velocities[::50] = 0.0
    outcomes = simulate_many(table, velocities, events=True, threads=threads)
    assert_same_events(outcomes, events_one_by_one(table, velocities))


@pytest.mark.parametrize('threads', [1, 2])
def test_all_events_of_the_report_s_integrator(threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 3)
    table, velocities = report_table(), random_velocities(10, seed=3)
    options = {'integrator': 'time_slice', **COARSE}
    outcomes = simulate_many(table, velocities, events=True, threads=threads, **options)
    assert_same_events(outcomes, events_one_by_one(table, velocities, **options))


@pytest.mark.parametrize('threads', [1, 2])
def test_more_events_than_any_first_room(threads, monkeypatch):
    """One shot that outgrows its own log, and all together what was expected of so many."""
    monkeypatch.setattr(cores, 'CHUNK', 4)
    table = dense_table(60, decelerating=True)
    rng = np.random.default_rng(5)
    velocities = rng.normal(size=(12, 60, 2))
    velocities[::3] = 0.0
    expected = events_one_by_one(table, velocities)
    assert max(map(len, expected)) > batch.FIRST_ROOM + 60
    assert sum(map(len, expected)) > parts.EVENTS_A_SHOT * 12
    assert_same_events(simulate_many(table, velocities, events=True, threads=threads), expected)


def test_without_shots_there_are_no_events():
    outcomes = simulate_many(report_table(), np.empty((0, 2)), events=True)
    assert len(outcomes.events) == 0 and outcomes.offsets.tolist() == [0]
    assert outcomes.events.dtype == simulate(report_table(), (0.0, 0.0)).events.dtype


def test_events_are_kept_only_where_asked_for():
    outcomes = simulate_many(report_table(), [(-1.0, 0.0)])
    assert outcomes.events is None and outcomes.offsets is None


def test_failed_shots_have_no_events():
    outcomes = simulate_many(
        report_table(), [(-4.0, 0.0), (-0.1, 0.0)], events=True, errors='mark', max_events=5
    )
    assert outcomes.failed.tolist() == [2, 0]
    assert outcomes.offsets.tolist() == [0, 0, 1]
    assert outcomes.events['kind'].tolist() == [2]


@pytest.mark.parametrize('integrator', INTEGRATORS)
@pytest.mark.parametrize('law', LAWS)
def test_the_first_ball_that_the_cue_ball_hits(law, integrator):
    table = dataclasses.replace(report_table(), ball_friction=law)
    rng = np.random.default_rng(6)
    count = 300 if integrator == 'event' else 60
    velocities = np.array([random_velocity(rng, 0.05, 3.0) for _ in range(count)])
    options = {'integrator': integrator, **COARSE}
    found = simulate_many(table, velocities, **options).first_hit
    events = events_one_by_one(table, velocities, **options)
    assert found.tolist() == [naive_shots.first_hit(shot, 0) for shot in events]
    assert len(set(found.tolist())) > 5 and -1 in found


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_the_cue_ball_may_have_any_number_or_none(integrator):
    spots, options = [(0.3, 0.5), (0.6, 0.5), (0.9, 0.5)], {'integrator': integrator, **COARSE}
    table = table_of(spots)
    velocities = np.zeros((1, 3, 2))
    velocities[0, 2] = (-2.0, 0.0)
    for cue in (None, 0, 1, 2):
        balls = [dataclasses.replace(b, is_cue=k == cue) for k, b in enumerate(table.balls)]
        found = simulate_many(dataclasses.replace(table, balls=balls), velocities, **options)
        assert found.first_hit.tolist() == [{None: -1, 0: 1, 1: 2, 2: 1}[cue]]


def test_of_two_balls_hit_at_one_instant_the_first_event_counts():
    table = table_of([(0.5, 0.5), (0.8, 0.55), (0.8, 0.45)], ball_friction='coulomb')
    events = simulate(table, (2.0, 0.0)).events
    assert events['t'][0] == events['t'][1] and set(events['kind'][:2]) == {0}
    outcomes = simulate_many(table, [(2.0, 0.0)])
    assert outcomes.first_hit[0] == naive_shots.first_hit(events, 0)
