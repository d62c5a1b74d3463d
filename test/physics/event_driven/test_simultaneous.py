"""Impulses of several contacts at one instant, against the plain twin that tries every set."""

import naive_events
import numpy as np
import pytest
from clusters import clusters, moving
from numba import njit
from tables import LAWS, table_of, under

from pool_sim_ros.physics.event_driven.contact_group import (
    gather,
    keep_closing,
    keep_those_in_contact,
)
from pool_sim_ros.physics.event_driven.simultaneous import (
    find_normal_impulses,
    move_as_one,
    resolve,
    total_compliance,
)
from pool_sim_ros.physics.tolerances import TOUCHING


@njit
def closing(state, a, b):
    count, members = gather(state, a, b, 0.0, TOUCHING)
    count = keep_closing(state.group, count)
    return count, keep_those_in_contact(state.group, count, members)


@njit
def solve(state, a, b, e):
    count, members = closing(state, a, b)
    for c in range(count):
        state.group.contacts[c].separation = e * state.group.contacts[c].closing
    if count > 0:
        find_normal_impulses(state.balls, state.group, count, members)
    return count, members


@njit
def resolved(state, a, b, e):
    count, members = closing(state, a, b)
    for c in range(count):
        state.group.contacts[c].separation = e * state.group.contacts[c].closing
    resolve(state, count, members)
    return count, members


@njit
def as_one(state, a, b):
    count, members = gather(state, a, b, 0.0, TOUCHING)
    move_as_one(state.balls, state.group, count, members)
    return count, members


def contacts_of(state, count, table, e):
    """Return the contacts of a group as the plain twin has them."""
    return [
        naive_events.Contact(
            int(one['a']),
            int(one['b']) if one['b'] >= 0 else -1,
            np.array([one['nx'], one['ny']]),
            e,
            table.mu_ball_ball if one['b'] >= 0 else table.mu_ball_cushion,
        )
        for one in state.group.contacts[:count]
    ]


def random_groups(rng, trials, law='coulomb', most=7):
    """Yield tables, velocities, restitutions, states and a contact of a group of a few."""
    for _ in range(trials):
        table = under(table_of(clusters(rng)), ball_friction=law)
        velocities = rng.normal(size=(len(table.balls), 2))
        touching = naive_events.touching_contacts(table, table.positions)
        contact, which = touching[rng.integers(len(touching))]
        b = which[2] if which[0] == 0 else -2 - which[2]
        yield table, velocities, rng.choice([0.0, 0.5, 0.9, 1.0]), (contact.a, b)


def velocities_of(state, velocities, members):
    after = velocities.copy()
    for i in state.group.members[:members]:
        after[i] = state.group.by_ball[i]['vx'], state.group.by_ball[i]['vy']
    return after


def test_normal_impulses_equal_the_plain_twin():
    rng = np.random.default_rng(1)
    compared = 0
    for table, velocities, e, (a, b) in random_groups(rng, 200):
        state = moving(table, velocities)
        count, members = solve(state, a, b, e)
        if not 1 <= count <= 7:
            continue
        contacts = contacts_of(state, count, table, e)
        impulses = naive_events.cluster_impulses(contacts, velocities, table.masses)
        expected = naive_events.push(contacts, impulses, velocities, table.masses)
        found = velocities_of(state, velocities, members)
        assert np.abs(found - expected).max() < 1e-9
        compared += count > 1
    assert compared > 40


def test_impulses_only_push_and_contacts_part_as_fast_as_they_must():
    """The complementarity itself, for groups too large for the twin."""
    rng = np.random.default_rng(2)
    for table, velocities, e, (a, b) in random_groups(rng, 200):
        state = moving(table, velocities)
        count, members = solve(state, a, b, e)
        after = velocities_of(state, velocities, members)
        momentum = table.masses @ (after - velocities)
        contacts = contacts_of(state, count, table, e)
        for one, contact in zip(state.group.contacts[:count], contacts, strict=True):
            assert one['impulse'] >= 0.0
            excess = naive_events.separation_speed(contact, after) - one['separation']
            assert excess > -1e-9
            assert abs(excess * one['impulse']) < 1e-9
            if contact.b < 0:
                momentum += one['impulse'] * contact.normal
        assert np.abs(momentum).max() < 1e-12


def test_friction_equals_the_plain_twin_under_coulomb():
    rng = np.random.default_rng(3)
    compared = 0
    for table, velocities, e, (a, b) in random_groups(rng, 200):
        table = under(table, mu_ball_ball=rng.choice([0.0, 0.05, 0.5, 5.0]))
        state = moving(table, velocities)
        count, members = resolved(state, a, b, e)
        if not 2 <= count <= 7:
            continue
        contacts = contacts_of(state, count, table, e)
        impulses = naive_events.cluster_impulses(contacts, velocities, table.masses)
        pushed = naive_events.push(contacts, impulses, velocities, table.masses)
        expected = naive_events.cluster_friction(contacts, impulses, pushed, table.masses)
        found = velocities_of(state, velocities, members)
        assert np.abs(found - expected).max() < 1e-8
        compared += 1
    assert compared > 40


@pytest.mark.parametrize('law', LAWS)
def test_without_friction_the_law_does_not_matter(law):
    table = table_of([(0.5, 0.5), (0.6, 0.5), (0.7, 0.5)], mu_ball_ball=0.0, ball_friction=law)
    state = moving(table, np.array([(1.0, 0.4), (0.0, 0.0), (0.0, 0.0)]))
    _, members = resolved(state, 0, 1, 1.0)
    found = velocities_of(state, np.array([(1.0, 0.4), (0.0, 0.0), (0.0, 0.0)]), members)
    np.testing.assert_allclose(found, [(0.0, 0.4), (1.0, 0.0), (0.0, 0.0)], atol=1e-9)


def test_the_compliance_is_the_sum_of_what_all_impulses_can_do():
    rng = np.random.default_rng(4)
    for table, velocities, e, (a, b) in random_groups(rng, 100):
        state = moving(table, velocities)
        count, _ = solve(state, a, b, e)
        if count == 0:
            continue
        jacobian = naive_events.normal_directions(
            contacts_of(state, count, table, e), len(table.balls)
        )
        # The two sides of a contact are added up apart: an upper bound, the same but for signs.
        delassus = np.abs(jacobian @ (jacobian / np.repeat(table.masses, 2)).T).sum(axis=1)
        for c in range(count):
            found = total_compliance(state.balls, state.group, count, c)
            assert found >= delassus[c] * (1 - 1e-9)


def test_what_moves_as_one_keeps_its_momentum_but_not_into_a_cushion():
    rng = np.random.default_rng(5)
    spots = [(0.05, 0.5), (0.15, 0.5), (0.25, 0.5), (1.0, 0.5)]
    for _ in range(50):
        table = table_of(spots)
        velocities = rng.normal(size=(4, 2))
        state = moving(table, velocities)
        _, members = as_one(state, 0, 1)
        assert sorted(state.group.members[:members]) == [0, 1, 2]
        common = velocities[:3].mean(axis=0)
        common[0] = max(common[0], 0.0)
        found = velocities_of(state, velocities, members)
        np.testing.assert_allclose(found, [common] * 3 + [velocities[3]], atol=1e-14)
