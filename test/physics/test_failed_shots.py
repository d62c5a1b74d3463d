"""Shots that cannot be played to their end: raised and named, or marked."""

import numpy as np
import pytest
from tables import table_of, under

from pool_sim_ros.physics import INTEGRATORS, cores, report_table, simulate, simulate_many
from pool_sim_ros.physics.outcomes import (
    BAD_LAYOUT,
    PLAYED,
    RUNS_AWAY,
    TOO_MANY_EVENTS,
    ShotTooLong,
)

COARSE = {'time_slice': 1e-3}


def assert_marked(outcomes, shot, failed):
    assert outcomes.failed[shot] == failed
    assert np.isnan(outcomes.finals[shot]).all() and np.isnan(outcomes.durations[shot])
    assert outcomes.event_counts[shot] == outcomes.first_hit[shot] == -1


def assert_played(outcomes, shot, table, velocity, **options):
    one = simulate(table, velocity, **options)
    assert outcomes.failed[shot] == PLAYED
    assert outcomes.finals[shot].tobytes() == one.final_positions.tobytes()
    assert outcomes.durations[shot] == one.duration
    assert outcomes.event_counts[shot] == len(one.events)


@pytest.mark.parametrize('integrator', INTEGRATORS)
@pytest.mark.parametrize('threads', [1, 2])
def test_a_layout_that_cannot_be(integrator, threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 2)
    table = table_of([(0.5, 0.5), (1.0, 0.5), (1.5, 0.5)])
    velocities = np.full((6, 2), (1.0, 0.1))
    layouts = np.tile(table.positions, (6, 1, 1))
    layouts[1, 1] = layouts[1, 0] + (0.07, 0.0)
    layouts[3, 2] = (0.01, 0.5)
    layouts[5, 0, 1] = np.nan
    options = {'integrator': integrator, **COARSE}
    many = {'positions': layouts, 'threads': threads, **options}
    outcomes = simulate_many(table, velocities, errors='mark', **many)
    for shot in (1, 3, 5):
        assert_marked(outcomes, shot, BAD_LAYOUT)
    for shot in (0, 2, 4):
        assert_played(outcomes, shot, table, velocities[shot], **options)
    with pytest.raises(ValueError, match="positions of shot 1: .*'0'.*'1' overlap by 0.03 m"):
        simulate_many(table, velocities, **many)
    with pytest.raises(ValueError, match="positions of shot 1: ball '2' .*outside"):
        simulate_many(table, velocities[2:], **{**many, 'positions': layouts[2:]})
    with pytest.raises(ValueError, match='positions of shot 0: .*not finite'):
        simulate_many(table, velocities[5:], **{**many, 'positions': layouts[5:]})


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_one_layout_for_all_shots_is_no_matter_of_a_single_shot(integrator):
    table = table_of([(0.5, 0.5), (1.0, 0.5)])
    with pytest.raises(ValueError, match='positions: .*overlap'):
        simulate_many(
            table,
            [(1.0, 0.0)],
            positions=[(0.5, 0.5), (0.55, 0.5)],
            errors='mark',
            integrator=integrator,
        )


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_too_many_events(integrator):
    table = report_table()
    velocities = [(-0.1, 0.0), (-4.0, 0.0), (0.0, 0.0), (-4.0, 0.1)]
    options = {'integrator': integrator, 'max_events': 4, **COARSE}
    outcomes = simulate_many(table, velocities, errors='mark', **options)
    for shot in (0, 2):
        assert_played(outcomes, shot, table, velocities[shot], **options)
    for shot in (1, 3):
        assert_marked(outcomes, shot, TOO_MANY_EVENTS)
    with pytest.raises(ShotTooLong, match='max_events: shot 1 .*more than 4'):
        simulate_many(table, velocities, **options)
    with pytest.raises(ShotTooLong, match='max_events: this shot .*more than 4'):
        simulate(table, velocities[1], **options)
    assert issubclass(ShotTooLong, ValueError)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_a_limit_that_a_shot_just_keeps(integrator):
    """A shot of k events may have k, and no shot is cut for one that would come after its end."""
    table, velocity, options = report_table(), (-4.0, 0.0), {'integrator': integrator, **COARSE}
    whole = simulate(table, velocity, **options)
    k = len(whole.events)
    kept = simulate(table, velocity, max_events=k, **options)
    assert kept.events.tobytes() == whole.events.tobytes()
    with pytest.raises(ShotTooLong):
        simulate(table, velocity, max_events=k - 1, **options)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_a_shot_that_runs_away(integrator):
    cloth = {'mu_ball_surface': 1e-3, 'e_cue_ball': 1.0, 'e_ball_ball': 1.0}
    table = under(report_table(), **cloth, mu_ball_ball=10.0)
    velocities = [(0.0, 0.0), (-10.0, 0.1), (0.001, 0.0), (-10.0, 0.1)]
    options = {'integrator': integrator, 'time_slice': 1e-5, 'until': 2.0}
    outcomes = simulate_many(table, velocities, errors='mark', **options)
    for shot in (1, 3):
        assert_marked(outcomes, shot, RUNS_AWAY)
    for shot in (0, 2):
        assert_played(outcomes, shot, table, velocities[shot], **options)
    with pytest.raises(ValueError, match='mu_ball_ball: .*shot 1 energy without end'):
        simulate_many(table, velocities, **options)


@pytest.mark.parametrize('threads', [1, 2])
def test_the_first_that_fails_is_named_whatever_the_threads(threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    velocities = np.zeros((40, 2))
    velocities[[17, 18, 30]] = (-4.0, 0.0)
    with pytest.raises(ShotTooLong, match='shot 17 '):
        simulate_many(report_table(), velocities, max_events=2, threads=threads)


@pytest.mark.parametrize('value', ['ignore', None, True])
def test_another_wish_about_errors(value):
    with pytest.raises(ValueError, match=f'errors: {value!r}'):
        simulate_many(report_table(), [(-1.0, 0.0)], errors=value)


@pytest.mark.parametrize('solve', [simulate, simulate_many])
@pytest.mark.parametrize('value', [0, -1, 'many', float('nan'), float('inf'), 1e300])
def test_a_limit_of_events_that_is_none(solve, value):
    velocities = (-1.0, 0.0) if solve is simulate else [(-1.0, 0.0)]
    with pytest.raises(ValueError, match='max_events: '):
        solve(report_table(), velocities, max_events=value)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_velocities_are_no_matter_of_a_single_shot(integrator):
    for velocity in ((float('nan'), 0.0), (float('inf'), 0.0), (2e6, 0.0)):
        for until in (None, 0.01):
            options = {'integrator': integrator, 'until': until, **COARSE}
            with pytest.raises(ValueError, match='velocities: '):
                simulate_many(report_table(), [(0.0, 0.0), velocity], errors='mark', **options)
            with pytest.raises(ValueError, match='velocities: '):
                simulate(report_table(), velocity, **options)
