"""Friction of several contacts at one instant, against a twin in vectors; and what it must keep."""

import dataclasses
import math

import naive_spin
import numpy as np
import pytest
from clusters import begin
from numba import njit
from spinning import RADIUS, random_strikes, spinning_table

from pool_sim_ros.physics import pool_table, rack, simulate
from pool_sim_ros.physics.boundary import cushion_of_partner
from pool_sim_ros.physics.event_driven.contact_group import (
    gather,
    keep_closing,
    keep_those_in_contact,
)
from pool_sim_ros.physics.event_driven.simultaneous import resolve
from pool_sim_ros.physics.event_driven.state import new_state
from pool_sim_ros.physics.log import new_log
from pool_sim_ros.physics.tolerances import TOUCHING, V_ROUNDING

APART = 2.0 * RADIUS * (1.0 + 1e-12)


@njit
def resolve_all(state, first, e):
    count, members = gather(state, first, -1, 0.0, TOUCHING)
    count = keep_closing(state.group, count)
    members = keep_those_in_contact(state.group, count, members)
    for c in range(count):
        state.group.contacts[c].separation = e * state.group.contacts[c].closing
    if count > 0:
        resolve(state, count, members)
    return count, members


def lattice(rng):
    """Return places of two to nine balls that touch each other, maybe a rail or a corner."""
    rows = [
        (RADIUS + APART * (i + j / 2), RADIUS + j * APART * math.sqrt(3) / 2)
        for i in range(3)
        for j in range(3)
    ]
    off = rng.choice([0.0, 0.3], 2)
    chosen = rng.permutation(9)[: rng.integers(2, 10)]
    return np.array([rows[k] for k in chosen]) + off


def random_group(seed):
    """Return a table, velocities, spins, and the state after the impulses of an instant."""
    rng = np.random.default_rng(seed)
    places = lattice(rng)
    n = len(places)
    table = spinning_table(
        places,
        masses=rng.choice([np.full(n, 0.17), 10 ** rng.uniform(-2.5, 0.5, n)]),
        mu_ball_ball=rng.choice([0.0, 0.06, 1.0]),
        mu_ball_cushion=rng.choice([0.0, 0.2, 1.0]),
        e_ball_ball=rng.uniform(),
        e_cue_ball=rng.uniform(),
        ball_friction=rng.choice(['coulomb', 'alciatore']),
        friction_bound=rng.choice(['impulse', 'restitution']),
        nose_height=RADIUS * rng.uniform(0.6, 1.9),
    )
    velocities, spins = random_strikes(rng, n, (0.0, 3.0), 80.0)
    balls = table.balls_at_rest.copy()
    for k, axis in enumerate('xyz'):
        balls[f'w{axis}'] = spins[:, k]
    state = new_state(table.for_kernels, balls, new_log(0, 0))
    begin(state, velocities)
    # Rolling balls are given the spin that goes with it: take what the engine has.
    spins = np.column_stack([state.balls[f'w{axis}'] for axis in 'xyz'])
    count, members = resolve_all(state, 0, float(rng.uniform()))
    return table, spins, state, state.group.contacts[:count].copy(), members


def friction_of(table, contact, velocities, spins):
    """Return the friction on ball a of one contact, N s, and the arm from its centre, m."""
    a, b, normal = contact['a'], contact['b'], np.array([contact['nx'], contact['ny'], 0.0])
    masses, impulse = table.masses, contact['impulse']
    if b >= 0:
        arm, push_along = RADIUS * normal, normal
        slip = velocities[a] + np.cross(spins[a], arm)
        slip = slip - velocities[b] - np.cross(spins[b], -arm)
        e = table.e_cue_ball if 0 in (a, b) else table.e_ball_ball
        bound = impulse * (2 * e / (1 + e) if table.friction_bound == 'restitution' else 1.0)
        mass = masses[a] * masses[b] / (masses[a] + masses[b])
    else:
        push_along = naive_spin.push_direction(normal, RADIUS, table.nose_height, 0, 'impulse')
        push_along = np.array([float(part) for part in push_along])
        arm = -RADIUS * push_along
        slip = velocities[a] + np.cross(spins[a], arm)
        bound = impulse / math.hypot(*push_along[:2])
        mass = masses[a]
    slip = slip - push_along * (slip @ push_along)
    size = np.linalg.norm(slip)
    if b < 0:
        mu = table.mu_ball_cushion
    elif table.ball_friction == 'alciatore':
        mu = 0.009951 + 0.108 * math.exp(-1.088 * size)
    else:
        mu = table.mu_ball_ball
    return -min(2 / 7 * mass, mu * bound / size if size else 0.0) * slip, arm


def twin(table, contacts, velocities, spins):
    """Return velocities and spins after the friction of all contacts, taken at once."""
    masses = table.masses[:, None]
    inertia = 0.4 * masses * RADIUS**2
    change, turn = np.zeros_like(velocities), np.zeros_like(spins)
    for contact in contacts[contacts['impulse'] > 0]:
        friction, arm = friction_of(table, contact, velocities, spins)
        a, b = contact['a'], contact['b']
        change[a] += friction / masses[a]
        turn[a] += np.cross(arm, friction) / inertia[a]
        if b >= 0:
            change[b] -= friction / masses[b]
            turn[b] += np.cross(arm, friction) / inertia[b]
    change[:, 2] = 0.0  # the cloth holds the balls
    linear = (masses * velocities * change + inertia * spins * turn).sum()
    square = (masses * change**2 + inertia * turn**2).sum() / 2
    share = min(1.0, max(0.0, -linear / square)) if square > 0 else 0.0
    return velocities + share * change, spins + share * turn


def energy(table, velocities, spins):
    parts = (velocities**2).sum(-1) + 0.4 * RADIUS**2 * (spins**2).sum(-1)
    return (table.masses * parts).sum() / 2


@pytest.mark.parametrize('seed', range(60))
def test_friction_is_that_of_the_twin_and_takes_energy(seed):
    table, spins, state, contacts, members = random_group(seed)
    chosen, group = state.group.members[:members], state.group.by_ball
    before, after = np.zeros((2, len(spins), 3))
    for i in chosen:
        before[i, :2] = group[i]['before_x'], group[i]['before_y']
        after[i, :2] = group[i]['vx'], group[i]['vy']
    expected, turned = twin(table, contacts, before, spins)
    found = np.column_stack([state.balls[f'w{axis}'] for axis in 'xyz'])
    np.testing.assert_allclose(found[chosen], turned[chosen], rtol=1e-9, atol=1e-8)
    at_cushion = np.unique(contacts['a'][(contacts['b'] < 0) & (contacts['impulse'] > 0)])
    free = np.setdiff1d(chosen, at_cushion)
    np.testing.assert_allclose(after[free], expected[free], rtol=1e-9, atol=1e-10)
    for contact in contacts[(contacts['b'] < 0) & (contacts['impulse'] > 0)]:
        assert 0 <= cushion_of_partner(int(contact['b'])) < 4
        normal = contact['nx'], contact['ny'], 0.0
        assert after[contact['a']] @ normal <= 1e-12
        # Friction does not press a ball into a cushion; along it nothing else changes.
        along = np.array([-contact['ny'], contact['nx'], 0.0])
        if (contacts['a'][contacts['b'] < 0] == contact['a']).sum() == 1:
            assert after[contact['a']] @ along == pytest.approx(
                expected[contact['a']] @ along, abs=1e-10
            )
    rest = [i for i in range(len(spins)) if i not in chosen]
    spins_of_rest = found[rest] - spins[rest]
    assert not spins_of_rest.any()
    was, now = (energy(table, v, w) for v, w in ((before, spins), (after, found)))
    assert now <= was * (1 + 1e-13) + table.masses.sum() * V_ROUNDING


def test_some_groups_have_several_contacts_of_both_sorts():
    """Lest the twin is never asked."""
    kinds = [random_group(seed)[3]['b'] for seed in range(60)]
    assert sum(len(b) > 2 and (b < 0).any() and (b >= 0).any() for b in kinds) > 10


def layouts():
    """Yield a table of touching balls, and the places to strike from."""
    rng = np.random.default_rng(7)
    for name in ('triangle', 'nine_ball'):
        table = pool_table('7ft')
        yield dataclasses.replace(table, balls=rack(table, name, spacing=0.0))
    for _ in range(6):
        yield spinning_table([(1.5, 0.5), *lattice(rng)])
    yield spinning_table([(0.5, 0.5), (0.5 + APART, 0.5)])
    yield spinning_table([(RADIUS, 0.5), (RADIUS + APART, 0.5), (RADIUS, 0.5 + APART)])


def strike_for(table):
    """Return a strike of the cue ball at the middle of the others, with spin."""
    way = table.positions[1:].mean(axis=0) - table.positions[0]
    return 3.0 * way / np.hypot(*way), np.array([20.0, -35.0, 40.0])


def soon_after(table, velocity, spin):
    """Play until shortly after the first contact of the cue ball."""
    shot = simulate(table, velocity, spins=spin)
    first = shot.events['t'][shot.events['kind'] == 0][0]
    return simulate(table, velocity, spins=spin, until=first + 2e-3)


@pytest.mark.parametrize('table', list(layouts()))
def test_the_order_of_balls_changes_nothing(table):
    velocity, spin = strike_for(table)
    shot = soon_after(table, velocity, spin)
    rng = np.random.default_rng(3)
    for _ in range(4):
        order = np.append(0, 1 + rng.permutation(len(table.balls) - 1))
        other = dataclasses.replace(table, balls=[table.balls[k] for k in order])
        permuted = simulate(other, velocity, spins=spin, until=shot.duration)
        np.testing.assert_allclose(
            permuted.final_positions, shot.final_positions[order], rtol=0, atol=1e-9
        )
        np.testing.assert_allclose(
            permuted.final_velocities, shot.final_velocities[order], rtol=0, atol=1e-8
        )


@pytest.mark.parametrize('table', list(layouts()))
@pytest.mark.parametrize('axis', [0, 1])
def test_a_mirrored_layout_plays_the_mirrored_shot(table, axis):
    velocity, spin = strike_for(table)
    shot = soon_after(table, velocity, spin)
    size = (table.length, table.width)[axis]
    places = table.positions.copy()
    places[:, axis] = size - places[:, axis]
    sign = np.ones(2)
    sign[axis] = -1.0
    turned = spin * np.append(-sign, -1.0)  # an axial vector
    mirrored = simulate(table, velocity * sign, spins=turned, positions=places, until=shot.duration)
    expected = shot.final_positions.copy()
    expected[:, axis] = size - expected[:, axis]
    np.testing.assert_allclose(mirrored.final_positions, expected, rtol=0, atol=1e-9)
