"""One motion however it is asked for: cut, taken up again, repeated, or one of many."""

import dataclasses
import threading
import time

import numpy as np
import pytest
from tables import LAWS, random_shots, random_table, random_velocity

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
