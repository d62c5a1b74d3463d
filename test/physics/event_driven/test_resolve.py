"""What is due is resolved, alone or with all that touches, as the plain twin has it."""

import itertools
import math

import naive_events
import numpy as np
import pytest
from clusters import clusters, moving
from numba import njit
from tables import LAWS, random_table, table_of, under

from pool_sim_ros.physics.event_driven.resolve import collide, is_touched, stands_alone
from pool_sim_ros.physics.log import N_EVENTS, N_SEGMENTS, new_log
from pool_sim_ros.physics.motion import RESTS, velocity_at
from pool_sim_ros.physics.tolerances import MAX_ROUNDS, PRESS_WINDOW, ROUND, STEADY_PRESSES, V_MIN


@njit
def met(state, a, b):
    return collide(state, a, b, 0.0)


@njit
def touched(state, i, but):
    return is_touched(state, i, but, 0.0)


@njit
def alone(state, a, b):
    return stands_alone(state, a, b, 0.0)


@njit
def velocity_of(state, i):
    return velocity_at(state.balls[i], state.table, 0.0)


def with_log(state):
    return state._replace(log=new_log(200, 200))


def velocities_of(state):
    return np.array([velocity_of(state, i) for i in range(len(state.balls))])


def touching_pair(rng, law):
    """Return a table on which two balls touch, and velocities at which they meet."""
    table = random_table(rng, 3, law)
    angle = rng.uniform(-math.pi, math.pi)
    normal = np.array([math.cos(angle), math.sin(angle)])
    balls = table.balls_at_rest.copy()
    middle = np.array([table.length, table.width]) / 2
    for i, part in ((0, -0.5), (1, 0.5)):
        spot = middle + part * (table.radii[0] + table.radii[1]) * normal
        balls[i]['x'], balls[i]['y'] = spot
    balls[2]['x'], balls[2]['y'] = table.radii[2] + 1e-3, table.radii[2] + 1e-3
    velocities = rng.normal(size=(3, 2))
    if (velocities[0] - velocities[1]) @ normal < 0.01:
        velocities[:2] += np.outer([1.0, -1.0], 3.0 * normal)
    return table, balls, normal, velocities


@pytest.mark.parametrize('law', LAWS)
def test_two_balls_alone(law):
    rng = np.random.default_rng(1)
    for trial in range(100):
        table, balls, normal, velocities = touching_pair(rng, law)
        velocities[2] = 0.0
        state = with_log(moving(table, velocities, balls))
        a, b = (0, 1) if trial % 2 else (1, 0)
        assert alone(state, a, b)
        assert met(state, a, b) == 2
        assert state.group.members[:2].tolist() == [a, b]
        e = table.e_cue_ball
        contact = naive_events.Contact(0, 1, normal, e, table.mu_ball_ball)
        expected = naive_events.single_collision(table, contact, velocities)
        np.testing.assert_allclose(velocities_of(state), expected, atol=1e-12)
        event = state.log.events[0]
        assert (state.log.counts[N_EVENTS], state.log.counts[N_SEGMENTS]) == (1, 2)
        assert (event['kind'], event['a'], event['b']) == (0, 0, 1)
        assert (event['nx'], event['ny']) == pytest.approx(tuple(normal), abs=1e-12)
        assert event['speed'] == pytest.approx((velocities[0] - velocities[1]) @ normal)
        point = (balls[0]['x'], balls[0]['y']) + balls[0]['radius'] * normal
        assert (event['x'], event['y']) == pytest.approx(tuple(point), abs=1e-12)


@pytest.mark.parametrize('cushion', range(4))
def test_a_cushion_alone(cushion):
    rng = np.random.default_rng(2)
    axis, outward = cushion // 2, 1 if cushion % 2 else -1
    normal = np.zeros(2)
    normal[axis] = outward
    for _ in range(50):
        table = random_table(rng, 1)
        balls = table.balls_at_rest.copy()
        size = (table.length, table.width)[axis]
        balls['xy'[axis]] = size - table.radii[0] if outward > 0 else table.radii[0]
        balls['yx'[axis]] = (table.width, table.length)[axis] / 2
        velocity = rng.normal(size=2)
        velocity[axis] = outward * (0.01 + abs(velocity[axis]))
        state = with_log(moving(table, [velocity], balls))
        assert alone(state, 0, -2 - cushion)
        assert met(state, 0, -2 - cushion) == 1
        contact = naive_events.Contact(0, -1, normal, table.e_ball_cushion, table.mu_ball_cushion)
        expected = naive_events.single_collision(table, contact, np.array([velocity]))
        np.testing.assert_allclose(velocities_of(state), expected, atol=1e-12)
        event = state.log.events[0]
        assert event[['kind', 'a', 'b']].tolist() == (1, 0, cushion)
        assert event['speed'] == pytest.approx(abs(velocity[axis]))


def test_what_touches():
    """Balls at rest on a cushion are not touched by it: nothing there pushes."""
    rng = np.random.default_rng(3)
    counts = {True: 0, False: 0}
    for _ in range(100):
        table = table_of(clusters(rng))
        n = len(table.balls)
        velocities = rng.choice([0.0, 1.0], (n, 1)) * rng.normal(size=(n, 2))
        state = moving(table, velocities)
        pairs = [which for _, which in naive_events.touching_contacts(table, table.positions)]
        for i in range(n):
            but = int(rng.choice([*range(n), -2, -3, -4, -5]))
            balls = {a + b - i for kind, a, b in pairs if kind == 0 and i in (a, b)} - {but}
            rests = state.balls[i]['phase'] == RESTS
            cushions = {-2 - b for kind, a, b in pairs if kind == 1 and a == i} - {but}
            expected = bool(balls) or (not rests and bool(cushions))
            assert touched(state, i, but) == expected
            counts[expected] += 1
    assert min(counts.values()) > 50


def test_a_ball_that_rattles_does_not_stand_alone():
    table = table_of([(0.5, 0.5), (0.6, 0.5)])
    state = moving(table, [(1.0, 0.0), (0.0, 0.0)])
    assert alone(state, 0, 1)
    state.balls['rounds'][1] = MAX_ROUNDS + 1
    state.balls['last_contact_time'][1] = -0.5 * ROUND
    assert not alone(state, 0, 1)
    state.balls['last_contact_time'][1] = -2.0 * ROUND
    assert not alone(state, 0, 1), 'it may still be pressed'
    state.balls['last_contact_time'][1] = -2.0 * PRESS_WINDOW
    assert alone(state, 0, 1)
    state.balls['last_contact_time'][1] = -0.5 * PRESS_WINDOW
    state.balls['rounds'][1], state.balls['presses'][1] = 0, STEADY_PRESSES + 1
    assert not alone(state, 0, 1)


@pytest.mark.parametrize('e', [1.0, 0.8, 0.3])
def test_a_group_equals_the_first_round_of_the_plain_twin(e):
    rng = np.random.default_rng(4)
    compared = 0
    for _ in range(150):
        table = under(
            table_of(clusters(rng), ball_friction='coulomb'),
            **{'e_cue_ball': e, 'e_ball_ball': e, 'e_ball_cushion': e},
        )
        velocities = rng.normal(size=(len(table.balls), 2))
        touching = naive_events.touching_contacts(table, table.positions)
        closing = [
            pair for pair in touching if naive_events.separation_speed(pair[0], velocities) < -V_MIN
        ]
        if not closing:
            continue
        contact, which = closing[rng.integers(len(closing))]
        around = naive_events.connected([contact], [c for c, _ in touching])
        group = [c for c, _ in closing if any(c is one for one in around)]
        if not 2 <= len(group) <= 7:
            continue
        state = with_log(moving(table, velocities))
        met(state, contact.a, which[2] if which[0] == 0 else -2 - which[2])
        impulses = naive_events.cluster_impulses(group, velocities, table.masses)
        pushed = naive_events.push(group, impulses, velocities, table.masses)
        expected = naive_events.cluster_friction(group, impulses, pushed, table.masses)
        np.testing.assert_allclose(velocities_of(state), expected, atol=1e-8)
        # Written down is what pushes.
        assert state.log.counts[N_EVENTS] == sum(impulses > 1e-9)
        compared += 1
    assert compared > 30


def test_a_contact_that_parts_already_pushes_nobody():
    """Rounding may have it: the two go on, and V_ROUNDING apart at least."""
    table = table_of([(0.5, 0.5), (0.6, 0.5), (0.7, 0.5)])
    velocities = np.array([(-1e-13, 0.0), (0.0, 0.0), (0.0, 0.0)])
    state = with_log(moving(table, velocities))
    met(state, 0, 1)
    found = velocities_of(state)
    assert np.abs(found - velocities).max() < 1e-10
    assert found[1, 0] - found[0, 0] > 0.0


@pytest.mark.parametrize('order', list(itertools.permutations(range(4))))
def test_a_ball_keeps_the_counts_of_its_own_weak_contacts(order):
    """One more than the larger count of each contact's two balls, in whatever order they are."""
    before = [0, 60, 0, 0]
    kept = [61, 61, 61, 1]
    table = table_of([(0.5 + 0.1 * k, 0.5) for k in order])
    state = moving(table, [(1.0 - 0.1 * V_MIN * k, 0.0) for k in order])
    state.balls['presses'] = [before[k] for k in order]
    state.balls['last_contact_time'] = -0.5 * PRESS_WINDOW
    assert met(with_log(state), order.index(1), order.index(2)) == 4
    assert state.balls['presses'].tolist() == [kept[k] for k in order]
