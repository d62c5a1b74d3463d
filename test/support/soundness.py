"""What must hold for every shot of the exact engine."""

import functools
import threading

import numpy as np
import pytest
from tables import kinetic_energy, worst_overlap

from pool_sim_ros.physics import compile_kernels, report_table, simulate, simulate_many

ALLOWED = 1e-9 * (1 + 1e-6)  # m: how deep a ball may be in another or in a cushion
V_MIN = 1e-4  # m/s: what the rule for sustained contact may give both sides of a contact
PRESSED = 200  # weak contacts of a ball, after which it counts as pressed: at least so many
HANG = 30.0  # s after which a shot, of a millisecond or less, counts as endless
MOST_LOOKS = 2000  # times at which a long shot is checked for overlaps


@functools.cache
def compile_once():
    """Compile for discs, lest the time that this takes counts as that of an endless shot."""
    compile_kernels(report_table())


def count_events(table, velocities, **options):
    """Return how many events a shot has; fail where it does not end."""
    compile_once()
    counts = []

    def play():
        counts.append(simulate_many(table, np.asarray(velocities)[None], **options)[2][0])

    worker = threading.Thread(target=play, daemon=True)
    worker.start()
    worker.join(HANG)
    if not counts:
        pytest.fail(f'no end: {table}, velocities {velocities!r}, {options}')
    return int(counts[0])


def assert_sound(table, velocities, most_events=5000, **options):
    """Play a shot and check what must hold for every one."""
    velocities = np.asarray(velocities, dtype=float)
    assert count_events(table, velocities, **options) <= most_events
    shot = simulate(table, velocities, **options)
    again = simulate(table, velocities, **options)
    assert shot.final_positions.tobytes() == again.final_positions.tobytes()
    assert shot.events.tobytes() == again.events.tobytes()
    assert np.isfinite(shot.final_positions).all() and np.isfinite(shot.final_velocities).all()
    instants = np.unique(np.concatenate([[0.0], shot.events['t']]))
    between = (instants[1:] + instants[:-1]) / 2
    times = np.concatenate([instants, between, np.linspace(0.0, shot.duration, 200)])
    times = times[:: 1 + len(times) // MOST_LOOKS]
    assert worst_overlap(table, shot.positions(times)) <= ALLOWED
    assert worst_overlap(table, shot.final_positions[None]) <= ALLOWED
    if table.ball_friction == 'coulomb':
        assert_energy_never_rises(table, velocities, shot, instants)
    return shot


def most_contacts_so_far(table, shot, instants):
    """Return at each instant how many contacts that ball has had which meets there most often."""
    had = np.zeros(len(table.balls), int)
    most = np.zeros(len(instants), int)
    for event in shot.events[shot.events['kind'] < 2]:
        meet = [event['a'], event['b']] if event['kind'] == 0 else [event['a']]
        had[meet] += 1
        at = np.searchsorted(instants, event['t'])
        most[at] = max(most[at], had[meet].max())
    return most


def assert_energy_never_rises(table, velocities, shot, instants):
    """But for weak contacts: k of one instant that part at a speed leave a ball at most k times it.

    That speed is V_MIN; where balls have met often enough to be pressed, up to 16 times it.
    """
    start = np.zeros((len(table.balls), 2))
    start[: velocities.size // 2] = velocities.reshape(-1, 2)
    energy = kinetic_energy(table, np.concatenate([start[None], shot.velocities(instants)]))
    contacts = np.searchsorted(shot.events['t'], instants, side='right')
    contacts -= np.searchsorted(shot.events['t'], instants, side='left')
    parting = V_MIN * np.where(most_contacts_so_far(table, shot, instants) > PRESSED, 16.0, 1.0)
    slack = 1e-12 * energy[0] + 0.5 * table.masses.sum() * (contacts * parting) ** 2
    assert np.all(np.diff(energy) <= slack)
