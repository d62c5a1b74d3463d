"""One motion however it is asked for: cut, taken up again, repeated, or one of many."""

import dataclasses
import threading
import time

import numpy as np
import pytest
from benchmark.workloads import dense_table
from tables import LAWS, random_shots, random_table, random_velocity, worst_overlap

from pool_sim_ros.physics import cores, report_table, shots, simulate, simulate_many


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
def test_a_shot_taken_up_again_goes_on_as_before(law, integrator):
    """Stop at t, start anew from there: the same end, later by t."""
    slicing = dict(integrator=integrator, time_slice=1e-5)
    for table, velocities in random_shots(49, 5, law, balls=4, fastest=1.5, mu_ball_surface=0.2):
        whole = simulate(table, velocities, **slicing)
        cut = round(0.4 * whole.duration, 3)
        first = simulate(table, velocities, until=cut, **slicing)
        rest = simulate(table, first.final_velocities, positions=first.final_positions, **slicing)
        assert np.abs(rest.final_positions - whole.final_positions).max() < 1e-9
        assert first.duration + rest.duration == pytest.approx(whole.duration, abs=1e-9)


@pytest.mark.parametrize('law', LAWS)
def test_until_equals_the_look_up(law):
    for table, velocities in random_shots(50, 10, law):
        whole = simulate(table, velocities)
        for until in (0.0, 0.1, 0.5 * whole.duration, 0.999 * whole.duration):
            part = simulate(table, velocities, until=until)
            assert part.duration == until
            assert np.abs(part.final_positions - whole.positions(until)).max() < 1e-12
            assert np.abs(part.final_velocities - whole.velocities(until)).max() < 1e-12
            assert np.all(part.events['t'] <= until)


def test_until_after_the_end_of_a_shot():
    whole = simulate(report_table(), (-4.0, 0.0))
    longer = simulate(report_table(), (-4.0, 0.0), until=1000.0)
    np.testing.assert_array_equal(longer.final_positions, whole.final_positions)
    assert longer.events.tobytes() == whole.events.tobytes()
    assert not np.any(longer.final_velocities)


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
@pytest.mark.parametrize('law', LAWS)
def test_the_same_input_gives_the_same_bits(law, integrator):
    for table, velocities in random_shots(51, 5, law):
        slicing = dict(integrator=integrator, time_slice=1e-4)
        one, two = (simulate(table, velocities, **slicing) for _ in range(2))
        assert one.final_positions.tobytes() == two.final_positions.tobytes()
        assert one.events.tobytes() == two.events.tobytes()
        assert one.duration == two.duration


@pytest.mark.parametrize(
    ('integrator', 'count'),
    [('event', 300), ('time_slice', 6)],
)
@pytest.mark.parametrize('law', LAWS)
def test_many_shots_are_bit_for_bit_those_played_one_by_one(law, integrator, count):
    rng = np.random.default_rng(52)
    table = dataclasses.replace(report_table(), ball_friction=law)
    velocities = np.array([random_velocity(rng) for _ in range(count)])
    options = dict(integrator=integrator, time_slice=1e-4)
    finals, durations, counts = simulate_many(table, velocities, **options)[:3]
    assert finals.shape == (count, 11, 2)
    for k, velocity in enumerate(velocities):
        shot = simulate(table, velocity, **options)
        assert finals[k].tobytes() == shot.final_positions.tobytes()
        assert durations[k] == shot.duration
        assert counts[k] == len(shot.events)


def test_many_shots_of_all_balls_with_other_positions_and_until():
    rng = np.random.default_rng(53)
    table = random_table(rng, 5)
    velocities = rng.normal(size=(40, 5, 2))
    mirrored = np.array([table.length, 0.0]) + table.positions * [-1.0, 1.0]
    options = dict(positions=mirrored, until=0.7)
    finals, durations, counts = simulate_many(table, velocities, **options)[:3]
    for k in range(len(velocities)):
        shot = simulate(table, velocities[k], **options)
        assert finals[k].tobytes() == shot.final_positions.tobytes()
        assert (durations[k], counts[k]) == (shot.duration, len(shot.events))


def test_no_shots_at_all():
    finals, durations, counts = simulate_many(report_table(), np.empty((0, 2)))[:3]
    assert finals.shape == (0, 11, 2)
    assert durations.shape == counts.shape == (0,)


def test_who_interrupts_many_shots_does_not_wait_for_the_other_threads(monkeypatch):
    helper_plays, taken = threading.Event(), []

    def play_parts(table, at_rest, shots_and_layouts, limits, ends, parts, *rest):
        if threading.current_thread() is threading.main_thread():
            assert helper_plays.wait(60.0)
            raise KeyboardInterrupt
        for part in parts:
            helper_plays.set()
            taken.append(part)
            time.sleep(0.01)

    monkeypatch.setattr(shots, 'play_parts', play_parts)
    monkeypatch.setattr(cores, 'CHUNK', 1)
    with pytest.raises(KeyboardInterrupt):
        simulate_many(report_table(), np.full((2000, 2), 0.1), threads=2)
    assert 0 < len(taken) < 2000


def test_the_outcomes_have_names_shapes_and_types():
    outcomes = simulate_many(report_table(), [(-4.0, 0.0), (0.0, 0.0), (-1.0, 0.0)])
    assert outcomes._fields == (
        *('finals', 'durations', 'event_counts', 'pocketed', 'first_hit', 'failed'),
        *('events', 'offsets'),
    )
    shapes = [array.shape for array in outcomes[:6]]
    assert shapes == [(3, 11, 2), (3,), (3,), (3, 11), (3,), (3,)]
    types = [array.dtype for array in outcomes[:6]]
    assert types == [float, float, np.int64, np.int64, np.int64, np.int8]
    assert outcomes.event_counts.tolist() == [24, 0, 1]
    assert outcomes.first_hit.tolist() == [1, -1, -1]
    assert np.all(outcomes.pocketed == -1) and not outcomes.failed.any()


@pytest.mark.parametrize('threads', [1, 2, 3, 100, None])
@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
def test_the_number_of_threads_changes_no_bit(integrator, threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 5)
    velocities = np.random.default_rng(59).normal(size=(23, 2))
    options = dict(integrator=integrator, time_slice=1e-3)
    expected = simulate_many(report_table(), velocities, threads=1, **options)
    found = simulate_many(report_table(), velocities, threads=threads, **options)
    for a, b in zip(found[:6], expected[:6], strict=True):
        assert a.tobytes() == b.tobytes()


@pytest.mark.parametrize('value', [0, -1, 1.5, 'all', np.nan])
def test_a_number_of_threads_that_is_none(value):
    with pytest.raises(ValueError, match='threads: '):
        simulate_many(report_table(), [(-1.0, 0.0)], threads=value)


@pytest.mark.parametrize('threads', [1, 2])
@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
def test_progress_is_told_up_to_the_total(integrator, threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 4)
    told = []
    simulate_many(
        report_table(),
        np.full((22, 2), 0.01),
        integrator=integrator,
        time_slice=1e-3,
        threads=threads,
        progress=lambda done, total: told.append((done, total)),
    )
    done = [pair[0] for pair in told]
    assert done == sorted(set(done)) and done[-1] == 22
    assert {pair[1] for pair in told} == {22}


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
@pytest.mark.parametrize('threads', [1, 2])
def test_an_exception_of_the_progress_ends_the_call(integrator, threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    told = []

    def stop(done, total):
        told.append(done)
        raise LookupError('enough')

    with pytest.raises(LookupError, match='enough'):
        simulate_many(
            report_table(),
            np.full((500, 2), 0.01),
            integrator=integrator,
            time_slice=1e-3,
            threads=threads,
            progress=stop,
        )
    assert 1 <= len(told) <= threads


def play_in_threads(tables, velocities, rounds):
    """Return what each of some threads gets, each playing on all the tables in turn."""
    found = [[] for _ in range(4)]
    errors = []

    def play(results):
        try:
            for _ in range(rounds):
                for table in tables:
                    for velocity in velocities:
                        results.append(simulate(table, velocity).events.tobytes())
        except BaseException as error:
            errors.append(error)

    workers = [threading.Thread(target=play, args=(results,)) for results in found]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert not errors
    return found


def test_shots_from_several_threads_and_on_alternating_tables():
    """Each thread keeps a work area for the table that it played on last."""
    rng = np.random.default_rng(60)
    tables = [report_table(), random_table(rng, 5), random_table(rng, 50, mu_ball_surface=0.3)]
    velocities = [random_velocity(rng) for _ in range(5)]
    expected = [simulate(t, v).events.tobytes() for t in tables for v in velocities]
    for results in play_in_threads(tables, velocities, rounds=3):
        assert results == 3 * expected


def test_tables_that_are_equal_but_not_the_same():
    velocity = (-4.0, 0.0)
    expected = simulate(report_table(), velocity)
    slow = dataclasses.replace(report_table(), mu_ball_surface=1.0)
    for table in (report_table(), slow, report_table(), slow):
        shot = simulate(table, velocity)
        same = shot.events.tobytes() == expected.events.tobytes()
        assert same == (table.mu_ball_surface == 0.1)


def test_a_shot_leaves_nothing_behind_for_the_next():
    """After one that is cut, one that fails, and one of all balls from elsewhere."""
    table, velocity = report_table(), (-4.0, 0.0)
    fresh = simulate(dataclasses.replace(table), velocity)
    elsewhere = np.array([table.length, 0.0]) + table.positions * [-1.0, 1.0]
    bad = np.tile(table.positions[0], (11, 1))
    rng = np.random.default_rng(61)
    for _ in range(3):
        simulate(table, rng.normal(size=(11, 2)), until=0.2, positions=elsewhere)
        with pytest.raises(ValueError, match='overlap'):
            simulate(table, velocity, positions=bad)
        with pytest.raises(ValueError, match='max_events'):
            simulate(table, velocity, max_events=3)
        with pytest.raises(ValueError, match='velocities'):
            simulate(table, (np.nan, 0.0))
        again = simulate(table, velocity)
        assert again.events.tobytes() == fresh.events.tobytes()
        assert again.segments.tobytes() == fresh.segments.tobytes()
        assert again.final_positions.tobytes() == fresh.final_positions.tobytes()


def test_a_table_of_two_thousand_balls():
    """So many that its work area is not kept."""
    table = dense_table(2000, decelerating=True)
    velocities = np.zeros((1, 2000, 2))
    velocities[0, ::40] = (1.5, 0.4)
    many = simulate_many(table, velocities, events=True)
    for _ in range(2):
        shot = simulate(table, velocities[0])
        assert shot.complete and len(shot.events) > 500
        assert shot.events.tobytes() == many.events.tobytes()
        assert shot.final_positions.tobytes() == many.finals[0].tobytes()
    assert worst_overlap(table, shot.final_positions[None]) < 1e-9
