"""Which contacts belong to one instant, against a look at every pair and every cushion."""

import math

import naive_events
import numpy as np
import pytest
from clusters import APART, clusters, moving
from numba import njit
from tables import table_of

from pool_sim_ros.physics.event_driven.contact_group import (
    closing_speed,
    gather,
    join,
    keep_closing,
    keep_those_in_contact,
)
from pool_sim_ros.physics.tolerances import CLOSING_ROUNDING, TOUCHING, V_MIN


@njit
def everything(state, a, b):
    count, members = gather(state, a, b, 0.0, TOUCHING)
    return count, keep_those_in_contact(state.group, count, members)


@njit
def what_closes(state, a, b):
    count, members = gather(state, a, b, 0.0, TOUCHING)
    count = keep_closing(state.group, count)
    return count, keep_those_in_contact(state.group, count, members)


@njit
def joined(state, i, members):
    return join(state, members, i, 0.0)


def found_by(state, count, members):
    contacts = state.group.contacts[:count]
    keys = {(int(c['a']), int(c['b'])) for c in contacts}
    assert len(keys) == count, 'each once'
    return contacts, keys, sorted(state.group.members[:members].tolist())


def key_of(which):
    kind, a, b = which
    return (a, b) if kind == 0 else (a, -2 - b)


def touching_group(table, velocities, a, slowest):
    """Return the contacts of the plain twin, of all that hangs together with a ball."""
    pairs = naive_events.touching_contacts(table, table.positions)
    some = [contact for contact, _ in pairs if a in (contact.a, contact.b)]
    group = naive_events.connected(some, [contact for contact, _ in pairs])
    return {
        key_of(which): contact
        for contact, which in pairs
        if any(contact is one for one in group)
        and -naive_events.separation_speed(contact, velocities) > slowest
    }


@pytest.mark.parametrize(
    ('scale', 'slowest'), [(1.0, V_MIN), (1e-5, CLOSING_ROUNDING), (1e-13, CLOSING_ROUNDING)]
)
@pytest.mark.parametrize('collect', [everything, what_closes])
def test_all_that_hangs_together_or_closes(collect, scale, slowest):
    """What closes weakly takes part where nothing closes faster, and rounding never does."""
    rng = np.random.default_rng(1)
    sizes = set()
    for _ in range(150):
        table = table_of(clusters(rng))
        n = len(table.balls)
        velocities = scale * rng.choice([0.0, 1.0], (n, 1)) * rng.normal(size=(n, 2))
        state = moving(table, velocities)
        touching = naive_events.touching_contacts(table, table.positions)
        _, which = touching[rng.integers(len(touching))]
        a, b = key_of(which)
        count, members = collect(state, a, b)
        contacts, keys, balls = found_by(state, count, members)
        least = slowest if collect is what_closes else -math.inf
        expected = touching_group(table, velocities, a, least)
        assert keys == set(expected)
        assert balls == sorted({k for key in keys for k in key if k >= 0})
        for contact in contacts:
            twin = expected[int(contact['a']), int(contact['b'])]
            assert (contact['nx'], contact['ny']) == pytest.approx(tuple(twin.normal), abs=1e-12)
            closing = -naive_events.separation_speed(twin, velocities)
            assert contact['closing'] == pytest.approx(closing, abs=1e-12 * scale)
        assert np.all(state.group.by_ball['index'] == -1), 'the next group begins empty'
        sizes.add(count)
    assert len(sizes) > 3 or (collect is what_closes and scale < V_MIN and sizes == {0})


def test_what_closes_weakly_waits_for_what_does_not():
    table = table_of([(0.5, 0.5), (0.6, 0.5), (0.7, 0.5)])
    for first, expected in ((1.0, {(0, 1)}), (2e-5, {(0, 1), (1, 2)})):
        state = moving(table, [(first, 0.0), (1e-5, 0.0), (0.0, 0.0)])
        _, keys, _ = found_by(state, *what_closes(state, 0, 1))
        assert keys == expected


def test_the_closing_speed_of_members():
    state = moving(table_of([(0.5, 0.5), (0.6, 0.5)]), [(3.0, 1.0), (1.0, -1.0)])
    assert joined(state, 0, 0) == 1 and joined(state, 1, 1) == 2 == joined(state, 0, 2)
    assert closing_speed(state.group, 0, 1, 1.0, 0.0) == 2.0
    assert closing_speed(state.group, 0, 1, 0.0, 1.0) == 2.0
    assert closing_speed(state.group, 1, -2, 0.6, 0.8) == pytest.approx(-0.2)


def test_a_hexagonal_crowd_has_room():
    """Nineteen balls around one, each touching six: no more contacts than there is room for."""
    spots = [
        (1.0 + APART * (i + j / 2), 0.5 + j * APART * math.sqrt(3) / 2)
        for i in range(-2, 3)
        for j in range(-2, 3)
        if abs(i + j) <= 2
    ]
    table = table_of(spots)
    state = moving(table, np.zeros((19, 2)))
    count, members = everything(state, 9, 10)
    assert (count, members) == (42, 19)
    assert len(state.group.contacts) >= count
