"""What holds in every shot of balls that spin, between contacts and at them."""

import math
import zlib

import numpy as np
import pytest
from spin_shots import KINDS
from spin_soundness import least_parting

from pool_sim_ros.physics import simulate
from pool_sim_ros.physics.tolerances import TOUCHING

ROUNDING = 1e-11  # m/s, and R times rad/s
CONTACTS = (0, 1)


def shots_of(kind, numbers, count):
    """Yield shots of a kind of random ones, with the velocities and spins at the strike."""
    for number in numbers:
        rng = np.random.default_rng([zlib.crc32(kind.encode()), number, 2])
        batch = KINDS[kind](rng, number, count)
        for velocity, spin, places in zip(*batch[1:], strict=True):
            yield simulate(batch.table, velocity, spins=spin, positions=places)


@pytest.fixture(scope='module')
def shots():
    return [shot for kind in KINDS for shot in shots_of(kind, range(6), 3)]


def own(shot, ball):
    return shot.segments[shot.segments['ball'] == ball]


def vectors(segments, *names):
    return np.column_stack([segments[name] for name in names])


def faded(wz, fall):
    return np.sign(wz) * np.maximum(np.abs(wz) - fall, 0.0)


def at_ends(shot, segments):
    """Return places, velocities and spins where each segment but the last goes over to the next."""
    lasts = np.diff(segments['t'])[:, None]
    first = segments[:-1]
    v, a = vectors(first, 'vx', 'vy'), vectors(first, 'ax', 'ay')
    places = vectors(first, 'x', 'y') + lasts * (v + lasts * a / 2)
    turned = vectors(first, 'wx', 'wy') + lasts * vectors(first, 'turn_x', 'turn_y')
    fade = 2.5 * shot.table.mu_spin * shot.table.gravity / shot.table.radii[0]
    wz = faded(first['wz'], fade * lasts[:, 0])
    return places, v + lasts * a, np.column_stack([turned, wz])


def events_of(shot, ball):
    events = shot.events
    both = (events['kind'] == 0) & (events['b'] == ball)
    return events[(events['a'] == ball) | both]


def slip_of(v, w, radius):
    return v + radius * np.column_stack([-w[:, 1], w[:, 0]])


def check_joints(shot):
    """Places are continuous but in pockets, and all else is where no contact is."""
    radius, compared = shot.table.radii[0], 0
    for ball in range(len(shot.table.balls)):
        segments, events = own(shot, ball), events_of(shot, ball)
        if len(segments) < 2:
            continue
        places, v, w = at_ends(shot, segments)
        begins = segments[1:]
        caught = np.isin(begins['t'], events['t'][events['kind'] == 3])
        moved = np.abs(vectors(begins, 'x', 'y') - places).max(axis=1)
        assert (moved[~caught] <= TOUCHING).all()
        free = ~caught & ~np.isin(begins['t'], events['t'][np.isin(events['kind'], CONTACTS)])
        jump = np.abs(vectors(begins, 'vx', 'vy') - v).max(axis=1)
        turn = radius * np.abs(vectors(begins, 'wx', 'wy', 'wz') - w).max(axis=1)
        speed = 1.0 + np.abs(v).max(axis=1) + radius * np.abs(w).max(axis=1)
        assert (jump[free] <= ROUNDING * speed[free]).all()
        assert (turn[free] <= ROUNDING * speed[free]).all()
        compared += int(free.sum())
    return compared


def check_phases(shot):
    """Each segment is a slide, a roll or rest, with the acceleration that is stated."""
    table = shot.table
    radius = table.radii[0]
    moving = shot.segments[np.hypot(shot.segments['ax'], shot.segments['ay']) > 0.0]
    v, w = vectors(moving, 'vx', 'vy'), vectors(moving, 'wx', 'wy', 'wz')
    a = vectors(moving, 'ax', 'ay')
    slip = slip_of(v, w, radius)
    size, speed = np.hypot(*slip.T), np.hypot(*v.T)
    rolls = np.abs(np.hypot(*a.T) / (table.mu_roll * table.gravity) - 1.0) < 1e-9
    assert (size[rolls] <= ROUNDING * (1.0 + speed[rolls])).all()
    against = np.where(rolls[:, None], v, slip)
    friction = np.where(rolls, table.mu_roll, table.mu_slide) * table.gravity
    expected = -friction[:, None] * against / np.where(rolls, speed, size)[:, None]
    clear = np.where(rolls, speed, size) > 1e-6  # else rounding turns it
    np.testing.assert_allclose(a[clear], expected[clear], rtol=1e-7, atol=1e-9)
    torque = 2.5 / radius * np.column_stack([a[:, 1], -a[:, 0]])
    turns = vectors(moving, 'turn_x', 'turn_y')
    torque = np.where(rolls[:, None], np.column_stack([-a[:, 1], a[:, 0]]) / radius, torque)
    np.testing.assert_allclose(turns, torque, rtol=1e-12, atol=1e-9)
    still = shot.segments[np.hypot(shot.segments['ax'], shot.segments['ay']) == 0.0]
    for name in ('vx', 'vy', 'wx', 'wy', 'turn_x', 'turn_y'):
        assert not still[name].any()
    return int(clear.sum())


def check_rolling(shot):
    """No slip at any time of a roll, from what the trajectory shows."""
    radius, compared = shot.table.radii[0], 0
    rolls = shot.events[shot.events['kind'] == 4]
    for event in rolls[:10]:
        later = events_of(shot, event['a'])['t']
        later = later[later > event['t']]
        # A contact shortly after may be part of no event of its own.
        segments = own(shot, event['a'])['t']
        ends = min(np.append(later, shot.duration).min(), segments[segments > event['t']].min())
        times = np.linspace(event['t'], ends, 12)[:-1]
        v, w = shot.velocities(times)[:, event['a']], shot.spins(times)[:, event['a']]
        assert np.abs(slip_of(v, w, radius)).max() <= ROUNDING * (1.0 + np.abs(v).max())
        compared += len(times)
    return compared


def lone_hits(shot):
    """Yield the contacts of two balls that are alone at their instant, with what goes before."""
    joints = {}
    for ball in range(len(shot.table.balls)):
        segments = own(shot, ball)
        if len(segments) > 1:
            joints[ball] = segments[1:], *at_ends(shot, segments)[1:]
    times = shot.events['t']
    for event in shot.events[shot.events['kind'] == 0]:
        if np.searchsorted(times, event['t'], 'right') - np.searchsorted(times, event['t']) > 1:
            continue
        sides = []
        for ball in (event['a'], event['b']):
            begins, v, w = joints[int(ball)]
            at = np.flatnonzero(begins['t'] == event['t'])
            # A ball alone in all that happens to it at this instant.
            if len(at) != 1:
                break
            k = int(at[0])
            after = begins[k]
            v_after = np.array([after['vx'], after['vy']])
            w_after = np.array([after['wx'], after['wy'], after['wz']])
            sides.append((v[k], w[k], v_after, w_after))
        if len(sides) == 2:
            yield event, sides


def check_hits(shot):
    """Momentum is kept, both balls get the same torque, and they part by their restitution."""
    table, compared = shot.table, 0
    radius, masses = table.radii[0], table.masses
    for event, ((v1, w1, u1, x1), (v2, w2, u2, x2)) in lone_hits(shot):
        m1, m2 = masses[event['a']], masses[event['b']]
        speed = 1.0 + sum(np.abs(v).max() for v in (v1, v2))
        speed += radius * sum(np.abs(w).max() for w in (w1, w2))
        small = ROUNDING * speed
        assert np.abs(m1 * (u1 - v1) + m2 * (u2 - v2)).max() <= small * (m1 + m2)
        torque = m1 * (x1 - w1)
        assert radius * np.abs(torque - m2 * (x2 - w2)).max() <= small * (m1 + m2)
        normal = np.array([event['nx'], event['ny']])
        assert radius * abs(torque[:2] @ normal) <= small * (m1 + m2)
        closing = (v1 - v2) @ normal
        assert event['speed'] == pytest.approx(max(closing, 0.0), abs=small)
        parting = (u2 - u1) @ normal
        cue = table.is_cue[event['a']] or table.is_cue[event['b']]
        e = table.e_cue_ball if cue else table.e_ball_ball
        least = least_parting(np.count_nonzero(shot.events['t'] <= event['t']))
        weak = closing <= 2.0 * least
        if weak:
            assert -small <= parting <= max(e * closing, least) + small
        else:
            assert parting == pytest.approx(e * closing, abs=small)
        # Tangential push of friction: at most mu J, and no more than stops the slip.
        compared += 1
    return compared


def check_turning(shot):
    """Unit quaternions that are continuous; a roll without sidespin turns by distance over R."""
    radius = shot.table.radii[0]
    until = min(shot.duration, 1.0)
    times = np.linspace(0.0, until, 400)
    found = shot.orientations(times)
    np.testing.assert_allclose(np.linalg.norm(found, axis=2), 1.0, rtol=0, atol=1e-12)
    fastest = np.linalg.norm(shot.spins(np.append(times, shot.events['t'])), axis=2).max()
    step = until / 399
    if fastest * step < 1.0:
        assert np.abs(np.diff(found, axis=0)).max() <= fastest * step / 2 + 1e-6
    compared = 0
    for ball in range(len(shot.table.balls)):
        segments = own(shot, ball)
        ends = np.append(segments['t'][1:], shot.duration)
        rolls = np.hypot(segments['ax'], segments['ay']) > 0.0
        slip = slip_of(vectors(segments, 'vx', 'vy'), vectors(segments, 'wx', 'wy'), radius)
        rolls &= (np.hypot(*slip.T) < 1e-12) & (segments['wz'] == 0.0) & (ends > segments['t'])
        for k in np.flatnonzero(rolls)[:2]:
            begin, end = segments['t'][k], ends[k] - 1e-3 * (ends[k] - segments['t'][k])
            before, after = shot.orientations([begin, end])[:, ball]
            way = np.subtract(*shot.positions([end, begin])[:, ball])
            half = math.hypot(*way) / radius / 2
            axis = np.array([-way[1], way[0], 0.0]) / max(math.hypot(*way), 1e-300)
            turn = np.array([*(math.sin(half) * axis), math.cos(half)])
            expected = product(turn, before)
            off = min(np.abs(after - expected).max(), np.abs(after + expected).max())
            assert off < 1e-6
            compared += 1
    return compared


def product(one, other):
    """Return the turn of a quaternion x, y, z, w after another."""
    vector = one[3] * other[:3] + other[3] * one[:3] + np.cross(one[:3], other[:3])
    return np.array([*vector, one[3] * other[3] - one[:3] @ other[:3]])


CHECKS = {
    'joints': check_joints,
    'phases': check_phases,
    'rolling': check_rolling,
    'hits': check_hits,
    'turning': check_turning,
}


@pytest.mark.parametrize('name', CHECKS)
def test_a_few_shots(name, shots):
    assert sum(CHECKS[name](shot) for shot in shots) > 100


@pytest.mark.soak
@pytest.mark.parametrize('kind', KINDS)
def test_many_shots(kind):
    for shot in shots_of(kind, range(10, 60), 40):
        for check in CHECKS.values():
            check(shot)
