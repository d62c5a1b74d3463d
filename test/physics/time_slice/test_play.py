"""The report's integrator: its printed numbers, and its plain loop bit for bit."""

import dataclasses
import math
import sys
from importlib.resources import files

import naive
import numpy as np
import pytest
from tables import LAWS, random_table, random_velocity, report_shots, table_of
from thinned import every

from pool_sim_ros.physics import ShotCancelled, ShotTooLong, report_table, simulate
from pool_sim_ros.physics.time_slice.play import last_slice

play_module = sys.modules['pool_sim_ros.physics.time_slice.play']  # its room exports `play`
PUBLISHED = files('pool_sim_ros.me212') / 'published_final_positions.csv'


def assert_same_bits(found, twin):
    """Equal to the last bit; the two zeros count as one number."""
    found, twin = np.asarray(found) + 0.0, np.asarray(twin) + 0.0
    np.testing.assert_array_equal(found.view(np.int64), twin.view(np.int64))


def assert_equals_twin(table, velocities, time_slice, positions=None, until=None):
    twin = naive.time_slice(table, velocities, positions, time_slice, until)
    shot = simulate(
        table,
        velocities,
        positions=positions,
        integrator='time_slice',
        time_slice=time_slice,
        until=until,
    )
    assert_same_bits(shot.final_positions, twin.positions)
    assert_same_bits(shot.final_velocities, twin.velocities)
    cut = np.any(shot.final_velocities)
    assert shot.duration == pytest.approx(until if cut else twin.slices * time_slice, rel=1e-12)
    contacts = shot.events[shot.events['kind'] != 2]
    found = list(zip(contacts['kind'], contacts['a'], contacts['b'], strict=True))
    assert found == [contact[1:] for contact in twin.contacts]
    times = [contact[0] * time_slice for contact in twin.contacts]
    np.testing.assert_allclose(contacts['t'], times, rtol=0, atol=1.001 * time_slice)
    return twin


@pytest.mark.parametrize('shot', [1, 2, 3, 4])
def test_printed_positions(shot):
    """Listing 1: all eleven final positions, to the last printed digit."""
    rows = [line.split(',') for line in PUBLISHED.read_text().split()[1:]]
    printed = {row[1]: (row[2], row[3]) for row in rows if row[0] == str(shot)}
    table = report_table()
    result = simulate(table, report_shots()[shot - 1], integrator='time_slice', time_slice=1e-6)
    found = {
        ball.label: (f'{x / 0.0254:.2f}', f'{y / 0.0254:.2f}')
        for ball, (x, y) in zip(table.balls, result.final_positions, strict=True)
    }
    assert len(printed) == 11
    assert found == printed


@pytest.mark.parametrize(('shot', 'law'), every(4, range(4), LAWS))
def test_report_shots_equal_the_plain_loop(shot, law):
    table = dataclasses.replace(report_table(), ball_friction=law)
    twin = assert_equals_twin(table, report_shots()[shot], 1e-4)
    assert twin.contacts


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('seed', range(6))
def test_random_tables_equal_the_plain_loop(seed, law):
    rng = np.random.default_rng(100 + seed)
    table = random_table(rng, rng.integers(1, 8), law, mu_ball_surface=0.2)
    velocities = [random_velocity(rng, 0.5, 4.0) for _ in table.balls]
    assert_equals_twin(table, velocities, 1e-3)


@pytest.mark.parametrize('law', LAWS)
def test_coarse_slices_equal_the_plain_loop(law):
    """Slices so coarse that balls overlap deeply, several at once, and are clamped in corners."""
    rng = np.random.default_rng(7)
    for _ in range(20):
        table = random_table(rng, 6, law)
        velocities = [random_velocity(rng, 0.5, 4.0) for _ in table.balls]
        assert_equals_twin(table, velocities, 0.01)


@pytest.mark.parametrize('law', LAWS)
def test_without_surface_friction_equals_the_plain_loop(law):
    rng = np.random.default_rng(8)
    for until in (0.5, 0.5004, 0.5006):
        table = random_table(rng, 5, law, mu_ball_surface=0.0)
        velocities = [random_velocity(rng, 0.5, 4.0) for _ in table.balls]
        assert_equals_twin(table, velocities, 1e-3, until=until)


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('gap', [0.0, 1e-12, -1e-12, -9e-10])
def test_touching_at_the_start_equals_the_plain_loop(gap, law):
    """Balls that touch or overlap within the tolerance, also cushions."""
    reach = 0.1 + gap
    places = [(0.6, 0.5), (0.6 + reach, 0.5), (0.6, 0.5 + reach), (0.05 + gap, 0.2)]
    table = table_of(places, ball_friction=law)
    for velocity in ((1.0, 0.0), (-1.0, 0.3), (0.7, 0.7)):
        assert_equals_twin(table, velocity, 1e-3)
    everything = [(1.0, 0.1), (-0.5, 0.2), (0.0, -1.0), (-1.0, 0.5)]
    assert_equals_twin(table, everything, 1e-3)


def test_other_start_positions_equal_the_plain_loop():
    table = table_of([(0.5, 0.5), (1.0, 0.5)])
    assert_equals_twin(table, (1.0, 0.1), 1e-3, positions=[(1.5, 0.2), (0.3, 0.25)])


def test_the_trajectory_passes_through_the_slices():
    """positions() between the contacts is the parabola, within 1e-9 m of the loop's slices."""
    table, time_slice = table_of([(0.5, 0.5), (0.8, 0.52), (1.2, 0.5)]), 2e-5
    times, slices = [], []

    def watch(number, positions):
        if number % 97 == 0:
            times.append(number * time_slice)
            slices.append([list(position) for position in positions])

    velocity = (2.0, 0.1)
    twin = naive.time_slice(table, velocity, time_slice=time_slice, watch=watch)
    assert len(twin.contacts) > 1 and len(times) > 100
    shot = simulate(table, velocity, integrator='time_slice', time_slice=time_slice)
    assert np.abs(shot.positions(times) - np.array(slices)).max() < 1e-9


def test_cut_short_equals_the_whole_shot_up_to_there():
    table, velocity = report_table(), report_shots()[0]
    whole = simulate(table, velocity, integrator='time_slice', time_slice=1e-4)
    part = simulate(table, velocity, integrator='time_slice', time_slice=1e-4, until=0.5)
    assert np.abs(part.final_positions - whole.positions([part.duration])[0]).max() < 1e-9
    assert part.duration == pytest.approx(0.5, abs=1e-4)


@pytest.mark.parametrize(
    ('until', 'expected'),
    [(0.0, 0), (0.5, 500), (0.50049, 500), (0.50051, 501), (math.inf, 10**18), (1e300, 10**18)],
)
def test_the_last_slice(until, expected):
    assert last_slice(until, 1e-3) == expected


def test_a_limit_of_events_that_a_cut_shot_keeps():
    """Balls still move, but no event is left before the cut."""
    table, options = report_table(), {'integrator': 'time_slice', 'time_slice': 1e-3}
    whole = simulate(table, (-4.0, 0.0), **options)
    times = np.unique(whole.events['t'])
    cut = (times[4] + times[5]) / 2
    part = simulate(table, (-4.0, 0.0), until=cut, **options)
    again = simulate(table, (-4.0, 0.0), until=cut, max_events=len(part.events), **options)
    assert again.events.tobytes() == part.events.tobytes()


@pytest.mark.parametrize('part', [1, 7, 1000])
def test_a_shot_in_parts_is_the_same_shot(monkeypatch, part):
    table, velocity = report_table(), report_shots()[0]
    monkeypatch.setattr(play_module, 'SLICES_A_CALL', part * (len(table.balls) ** 2 + 100))
    monkeypatch.setattr(play_module, 'FEWEST_SLICES_A_CALL', 1)
    asked = []
    for until in (None, 0.5):
        options = dict(integrator='time_slice', time_slice=1e-4, until=until)
        whole = simulate(table, velocity, **options)
        parted = simulate(table, velocity, **options, cancelled=lambda: asked.append(1))
        assert_same_bits(parted.final_positions, whole.final_positions)
        assert_same_bits(parted.final_velocities, whole.final_velocities)
        assert (parted.duration, parted.complete) == (whole.duration, whole.complete)
        assert parted.events.tobytes() == whole.events.tobytes()
        assert parted.segments.tobytes() == whole.segments.tobytes()
    assert len(asked) >= 2e4 / part


def test_a_shot_that_fails_in_parts_fails_as_a_whole_does(monkeypatch):
    monkeypatch.setattr(play_module, 'SLICES_A_CALL', 1000)
    for cancelled in (None, lambda: False):
        with pytest.raises(ShotTooLong):
            simulate(
                report_table(), (-4.0, 0.0), integrator='time_slice', time_slice=1e-4,
                max_events=5, cancelled=cancelled,
            )  # fmt: skip


def test_a_cancelled_shot_ends_at_once():
    looks = iter([False, False, True])
    nothing_slows = dataclasses.replace(report_table(), mu_ball_surface=1e-4)
    with pytest.raises(ShotCancelled):
        simulate(
            nothing_slows, (-4.0, 0.0), integrator='time_slice', until=1e6,
            cancelled=lambda: next(looks),
        )  # fmt: skip
