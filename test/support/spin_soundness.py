"""What must hold for every shot of balls that spin."""

import threading

import numpy as np
import pytest

from pool_sim_ros.physics import simulate, simulate_many
from pool_sim_ros.physics.tolerances import HELD_GROWTH, LEAST_PARTING, MOST_HELD, STEADY_HELD

ALLOWED = 1e-9 * (1 + 1e-6)  # m: how deep a ball may be in another or in a cushion
MOST_EVENTS = 5000
HANG = 300.0  # s after which a batch, of some seconds or less, counts as endless
MOUTH = 0.1  # m: how far from a pocket's circle its mouth reaches at most,
MOUTH_DEPTH = 0.02  # and how far beyond the rails a ball may be that is not caught
POCKETED = 3


def pocket_of(table, places):
    """Return the pocket in whose circle each place (..., 2) lies, -1 for none."""
    found = np.full(places.shape[:-1], -1)
    for k, (x, y, radius) in enumerate(table.pockets):
        found[np.hypot(places[..., 0] - x, places[..., 1] - y) < radius] = k
    return found


def depth_in_cushions(table, places):
    """Return how deep balls at (..., 2) are in a cushion or a nose, or behind one, m.

    Negative: how far from all of them.
    """
    radius = table.radii[0]
    x, y = places[..., 0], places[..., 1]
    sides = np.minimum(np.minimum(x, table.length - x), np.minimum(y, table.width - y))
    beyond = radius - sides
    if table.cushions is None:
        return beyond
    near_pocket = np.zeros(x.shape, bool)
    for px, py, reach in table.pockets:
        near_pocket |= np.hypot(x - px, y - py) < reach + MOUTH
    depth = np.where(near_pocket, beyond - radius - MOUTH_DEPTH, beyond)
    for x0, y0, x1, y1, nx, ny in table.cushions.segments:
        along = (x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)
        before = (along >= 0.0) & (along <= (x1 - x0) ** 2 + (y1 - y0) ** 2)
        height = (x - x0) * nx + (y - y0) * ny
        depth = np.maximum(depth, np.where(before, radius - height, -np.inf))
    for x0, y0, nose in table.cushions.noses:
        depth = np.maximum(depth, nose + radius - np.hypot(x - x0, y - y0))
    return depth


def depth_in_balls(table, places):
    """Return how deep the deepest of the balls of each layout (..., n, 2) is in another, m.

    A place of NaN is that of a ball out of the play.
    """
    one, other = np.triu_indices(places.shape[-2], 1)
    if not len(one):
        return np.full(places.shape[:-2], -np.inf)
    apart = np.hypot(
        places[..., one, 0] - places[..., other, 0], places[..., one, 1] - places[..., other, 1]
    )
    depths = 2.0 * table.radii[0] - apart
    return np.where(np.isnan(depths), -np.inf, depths).max(axis=-1)


def assert_apart(table, places, caught, told):
    """Check layouts (k, n, 2), of which the balls `caught` (k, n) are in pockets, or -1."""
    assert np.isfinite(places).all(), told(~np.isfinite(places).all(axis=(1, 2)))
    held = caught >= 0
    if held.any():
        assert (places[held] == table.pockets[caught[held], :2]).all()
    seen = np.where(held[..., None], np.nan, places)
    deep = np.where(held, -np.inf, depth_in_cushions(table, seen)).max(axis=1) > ALLOWED
    assert not deep.any(), f'in a cushion: {told(deep)}'
    deep = depth_in_balls(table, seen) > ALLOWED
    assert not deep.any(), f'in a ball: {told(deep)}'


def within(seconds, what, *args, **options):
    """Call a function; fail where it does not return in this time."""
    answers, errors = [], []

    def call():
        try:
            answers.append(what(*args, **options))
        except Exception as error:
            errors.append(error)

    worker = threading.Thread(target=call, daemon=True)
    worker.start()
    worker.join(seconds)
    if errors:
        raise errors[0]
    if not answers:
        pytest.fail('no end')
    return answers[0]


def assert_batch_sound(batch, looks=(), closely=0):
    """Play many shots; check their ends, what is where at the `looks`, s, and some closely.

    Returns the most events of a shot.
    """
    table, velocities, spins, places = batch
    given = dict(spins=spins, positions=places, errors='mark', max_events=MOST_EVENTS)

    def told(bad):
        k = int(np.flatnonzero(bad)[0])
        shot = [part[k].tolist() for part in (velocities, spins, places)]
        return f'{int(bad.sum())} shots, the first {table.cushion_model} {shot}'

    found = within(HANG, simulate_many, table, velocities, **given)
    failed = found.failed != 0
    assert not failed.any(), f'failed {found.failed[failed][0]}: {told(failed)}'
    assert np.isfinite(found.durations).all()
    assert_apart(table, found.finals, found.pocketed, told)
    for time in looks:
        seen = within(HANG, simulate_many, table, velocities, until=time, **given)
        assert_apart(table, seen.finals, seen.pocketed, told)
        stay = (seen.pocketed < 0) | (seen.pocketed == found.pocketed)
        assert stay.all(), f'out of a pocket: {told(~stay.all(axis=1))}'
    for k in range(min(closely, len(velocities))):
        assert_sound(table, velocities[k], spins[k], places[k])
    return int(found.event_counts.max())


def assert_sound(table, velocity, spin, places=None):
    """Play one shot and look at it at each event and in between."""
    options = dict(spins=spin, positions=places, max_events=MOST_EVENTS)
    shot = within(HANG, simulate, table, velocity, **options)
    start = table.positions if places is None else np.asarray(places)

    def told(bad):
        where = np.asarray(times)[np.flatnonzero(bad)[0]]
        given = [np.asarray(part).tolist() for part in (velocity, spin, start)]
        return f'at {where} s, {table.cushion_model} {given}'

    instants = np.unique(np.append(0.0, shot.events['t']))
    between = (instants[1:] + instants[:-1]) / 2
    times = np.concatenate([instants, between, np.linspace(0.0, shot.duration, 100)])
    caught = np.broadcast_to(pocket_of(table, start), (len(times), len(start))).copy()
    for event in shot.events[shot.events['kind'] == POCKETED]:
        caught[times >= event['t'], event['a']] = event['b']
    assert_apart(table, shot.positions(times), caught, told)
    assert (caught[np.argmax(times)] == shot.pocketed).all()
    times = instants
    rises = energy_rises(table, velocity, spin, shot, instants)
    assert not rises.any(), f'energy rises {told(rises)}'
    return shot


def energy_of(table, velocities, spins):
    """Return the energies in J of (k, n, 2) velocities and (k, n, 3) spins."""
    inertia = 0.4 * table.radii**2
    return ((velocities**2).sum(-1) + inertia * (spins**2).sum(-1)) @ table.masses / 2


def least_parting(contacts):
    """Return how fast weak contacts part at most, m/s, after so many contacts of a shot."""
    held = np.clip(np.asarray(contacts) - STEADY_HELD, 0, MOST_HELD - STEADY_HELD)
    return LEAST_PARTING * HELD_GROWTH**held


def energy_rises(table, velocity, spin, shot, instants):
    """Return at which instants there is more energy than before by more than docs/physics.md says.

    A weak contact parts at u = 1 mm/s at most, faster where there were many: `least_parting`. One
    adds at most m u^2 / 2, with the reduced mass m of two balls; k of one instant add at most
    M (k u)^2 / 2, where M is the mass of the balls in them.
    """
    n = len(table.balls)
    v, w = np.zeros((1, n, 2)), np.zeros((1, n, 3))
    v[0, 0], w[0, 0] = velocity, spin
    energy = np.concatenate(
        [energy_of(table, v, w), energy_of(table, shot.velocities(instants), shot.spins(instants))]
    )
    contacts = shot.events[shot.events['kind'] < 2]
    first = np.searchsorted(contacts['t'], instants, side='left')
    last = np.searchsorted(contacts['t'], instants, side='right')
    parting = least_parting(last)
    one, other = table.masses[contacts['a']], table.masses[contacts['b'] % n]
    balls = contacts['kind'] == 0
    mass = np.append(0.0, np.cumsum(np.where(balls, one + other, one)))
    mass = mass[last] - mass[first]
    alone = np.flatnonzero(last - first == 1)
    alone = alone[balls[first[alone]]]
    a, b = one[first[alone]], other[first[alone]]
    mass[alone] = a * b / (a + b)
    given = mass / 2 * ((last - first) * parting) ** 2
    return np.diff(energy) > 1e-12 * energy[0] + given
