"""What happens in one slice, step by step, to the last bit of the plain listing."""

import math

import naive
import numpy as np
import pytest
from tables import LAWS, random_table

from pool_sim_ros.physics.log import new_log
from pool_sim_ros.physics.time_slice.listing import (
    NEVER,
    collide,
    look_at_next_slice,
    meet_balls,
    meet_cushions,
    move,
    next_look,
)
from pool_sim_ros.physics.time_slice.play import new_state

STEP = 1e-3


def begun(table, velocities, positions=None):
    places = table.positions if positions is None else positions
    return new_state(table, places, np.array(velocities), STEP, new_log(100, 100))


def assert_same_bits(found, twin):
    """Equal to the last bit; the two zeros count as one number."""
    found, twin = np.asarray(found) + 0.0, np.asarray(twin) + 0.0
    np.testing.assert_array_equal(found.view(np.int64), twin.view(np.int64))


def random_state(rng, law='report', balls=4):
    table = random_table(rng, balls, law, mu_ball_surface=rng.choice([0.0, 0.2]))
    velocities = rng.choice([0.0, 1e-4, 1.0, 30.0], (balls, 1)) * rng.normal(size=(balls, 2))
    return table, velocities


def test_a_ball_moves():
    rng = np.random.default_rng(1)
    for _ in range(200):
        table, velocities = random_state(rng)
        state = begun(table, velocities)
        for i in range(4):
            move(state, i)
            x, v = naive.move(
                table.positions[i].tolist(),
                velocities[i].tolist(),
                *(STEP, table.mu_ball_surface, table.gravity),
            )
            assert_same_bits(state.x[i], x)
            assert_same_bits(state.v[i], v)


def test_a_ball_meets_cushions():
    rng = np.random.default_rng(2)
    met = 0
    for _ in range(300):
        table, velocities = random_state(rng)
        beyond = rng.uniform(-0.02, (table.length + 0.02, table.width + 0.02), (4, 2))
        state = begun(table, velocities, beyond)
        for i in range(4):
            before = state.log.counts[0]
            meet_cushions(state, i, 0.5)
            x, v, cushions = naive.wall_collisions(
                beyond[i].tolist(), velocities[i].tolist(), table.balls[i].radius, table
            )
            assert_same_bits(state.x[i], x)
            assert_same_bits(state.v[i], v)
            events = state.log.events[before : state.log.counts[0]]
            assert events[['kind', 'a', 'b']].tolist() == [(1, i, k) for k in cushions]
            assert state.changed[i] == bool(cushions)
            met += len(cushions)
    assert met > 100


@pytest.mark.parametrize('law', LAWS)
def test_two_balls_collide(law):
    rng = np.random.default_rng(3)
    for _ in range(300):
        table, velocities = random_state(rng, law)
        state = begun(table, velocities)
        a, b = sorted(rng.choice(4, 2, replace=False))
        collide(state, a, b, 0.5)
        va, vb = naive.ball_collision(
            table,
            a,
            b,
            *(table.positions[k].tolist() for k in (a, b)),
            *(velocities[k].tolist() for k in (a, b)),
        )
        if law == 'report':
            assert_same_bits(state.v[[a, b]], [va, vb])
        else:  # not the listing's: the reduced mass may be rounded in another order
            np.testing.assert_allclose(state.v[[a, b]], [va, vb], rtol=1e-13, atol=1e-15)
        assert state.log.events[0][['kind', 'a', 'b']].tolist() == (0, a, b)
        assert state.changed.tolist() == [k in (a, b) for k in range(4)]


def test_a_pair_is_resolved_once_until_it_parts():
    table = random_table(np.random.default_rng(4), 2, mu_ball_surface=0.0)
    touching = np.array([[0.5, 0.5], [0.5 + 0.9 * table.radii.sum(), 0.5]])
    state = begun(table, [(1.0, 0.0), (0.0, 0.0)], touching)
    for contacts, x in ((1, None), (1, None), (1, 0.9), (2, touching[1, 0])):
        if x is not None:
            state.x[1, 0] = x
        state.clock[0] += 1
        state.due[:] = 0
        meet_balls(state, 0.0)
        assert state.log.counts[0] == contacts


def test_no_pair_touches_before_it_is_looked_at():
    rng = np.random.default_rng(5)
    sooner = 0
    for _ in range(300):
        table, velocities = random_state(rng)
        state = begun(table, velocities)
        state.clock[0] = rng.integers(0, 1000)
        touch = table.radii[:2].sum()
        gap = math.dist(*table.positions[:2]) - touch
        slice_of_look = next_look(state, 0, 1, gap)
        assert slice_of_look > state.clock[0]
        if slice_of_look == NEVER:
            assert not velocities[:2].any()
            continue
        slices = slice_of_look - state.clock[0] - 1
        # The worst: both run at each other and are not slowed.
        fastest = sum(math.hypot(*v) for v in velocities[:2])
        assert slices * STEP * fastest < gap
        sooner += slices > 0
    assert sooner > 50


def test_all_pairs_of_a_ball_that_was_hit_are_looked_at():
    table = random_table(np.random.default_rng(6), 5)
    pairs = [(a, b) for a in range(5) for b in range(a + 1, 5)]
    for i in range(5):
        state = begun(table, np.zeros((5, 2)))
        state.due[:] = NEVER
        state.clock[0] = 7
        look_at_next_slice(state, i)
        assert state.due.tolist() == [8 if i in pair else NEVER for pair in pairs]
