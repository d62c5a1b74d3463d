"""Which contacts belong to one instant, against a look at every pair and every cushion."""

import math

import naive_events
import numpy as np
import pytest
from clusters import APART, clusters, moving
from numba import njit
from tables import table_of

from pool_sim_ros.physics.event_driven.contact_group import closing_speed, gather, take_alone


@njit
def gathered(state, a, b, slowest):
    return gather(state, a, b, 0.0, slowest)


@njit
def alone(state, a, b):
    return take_alone(state, a, b, 0.0)


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


@pytest.mark.parametrize('slowest', [-math.inf, 0.0, 1e-4, 0.5])
def test_all_that_hangs_together_and_closes(slowest):
    rng = np.random.default_rng(1)
    sizes = set()
    for _ in range(150):
        table = table_of(clusters(rng))
        n = len(table.balls)
        velocities = rng.choice([0.0, 1.0], (n, 1)) * rng.normal(size=(n, 2))
        state = moving(table, velocities)
        touching = naive_events.touching_contacts(table, table.positions)
        _, which = touching[rng.integers(len(touching))]
        a, b = key_of(which)
        count, members = gathered(state, a, b, slowest)
        contacts, keys, balls = found_by(state, count, members)
        expected = touching_group(table, velocities, a, slowest)
        assert keys == set(expected)
        assert balls == sorted({k for key in keys for k in key if k >= 0})
        for contact in contacts:
            twin = expected[int(contact['a']), int(contact['b'])]
            assert (contact['nx'], contact['ny']) == pytest.approx(tuple(twin.normal), abs=1e-12)
            closing = -naive_events.separation_speed(twin, velocities)
            assert contact['closing'] == pytest.approx(closing, abs=1e-12)
        assert np.all(state.group.by_ball['index'] == -1), 'the next group begins empty'
        sizes.add(count)
    assert len(sizes) > 3


def test_the_contact_alone_even_where_it_parts():
    table = table_of([(0.5, 0.5), (0.6, 0.5), (0.7, 0.5)])
    state = moving(table, [(-1.0, 0.0), (0.0, 0.0), (-5.0, 0.0)])
    for a, b in ((0, 1), (1, 0)):
        count, members = alone(state, a, b)
        contacts, keys, balls = found_by(state, count, members)
        assert keys == {(0, 1)} and balls == [0, 1]
        assert contacts[0]['closing'] == -1.0
        assert (contacts[0]['nx'], contacts[0]['ny']) == pytest.approx((1.0, 0.0))


@pytest.mark.parametrize(
    ('cushion', 'normal'), list(enumerate([(-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)]))
)
def test_a_cushion_alone(cushion, normal):
    state = moving(table_of([(0.5, 0.5), (0.6, 0.5)]), [(0.3, -0.2), (0.0, 0.0)])
    count, members = alone(state, 0, -2 - cushion)
    contacts, keys, balls = found_by(state, count, members)
    assert keys == {(0, -2 - cushion)} and balls == [0]
    assert contacts[0]['closing'] == pytest.approx(np.dot((0.3, -0.2), normal))


def test_the_closing_speed_of_members():
    state = moving(table_of([(0.5, 0.5), (0.6, 0.5)]), [(3.0, 1.0), (1.0, -1.0)])
    alone(state, 0, 1)
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
    count, members = gathered(state, 9, 10, -math.inf)
    assert (count, members) == (42, 19)
    assert len(state.group.contacts) >= count
