"""How a disc moves: against the plain twins, and what of it must hold."""

import math

import naive
import naive_events
import numpy as np
import pytest
from numba import njit
from tables import random_table, random_velocity, under

from pool_sim_ros.physics.boundary import PHASE_END, cushion_of_partner
from pool_sim_ros.physics.log import STOP
from pool_sim_ros.physics.motion import (
    MOVES,
    RESTS,
    acceleration,
    end_phase,
    path_from,
    phase_end_time,
    position_at,
    relative_motion,
    set_off,
    time_to_boundary,
    time_to_cell_edge,
    time_to_resting_ball,
    velocity_at,
)


@njit
def begin(balls, i, table, vx, vy, now):
    balls[i].since = now
    set_off(balls[i], table, vx, vy)


@njit
def look(balls, i, table, t):
    ball = balls[i]
    return position_at(ball, table, t), velocity_at(ball, table, t), acceleration(ball, table)


@njit
def ends_at(balls, i, table):
    return phase_end_time(balls[i], table)


@njit
def end(balls, i, table, now):
    return end_phase(balls[i], table, now)


@njit
def cushion_ahead(balls, i, table, now):
    ball = balls[i]
    return time_to_boundary(path_from(ball, table, now), table, ball)


@njit
def edge_ahead(balls, i, table, now, edges):
    return time_to_cell_edge(path_from(balls[i], table, now), table, *edges)


@njit
def resting_ball_ahead(balls, i, table, now, dx, dy, touch):
    return time_to_resting_ball(path_from(balls[i], table, now), table, dx, dy, touch)


@njit
def seen_from(balls, i, j, table, now):
    first = path_from(balls[i], table, now)
    return relative_motion(first, table, path_from(balls[j], table, now))


def set_off_at_random(rng, **fields):
    """Return a table, its records, of which each is set off at 2 s, and the velocities."""
    table = random_table(rng, 3, **fields)
    balls = table.balls_at_rest.copy()
    velocities = np.array([random_velocity(rng, 0.01, 5.0) for _ in range(3)])
    for i, velocity in enumerate(velocities):
        begin(balls, i, table.for_kernels, *velocity, 2.0)
    return table, balls, velocities


def test_it_moves_as_the_plain_twin():
    rng = np.random.default_rng(1)
    for _ in range(100):
        table, balls, velocities = set_off_at_random(rng)
        for i in range(3):
            lasts = math.hypot(*velocities[i]) / table.deceleration
            assert ends_at(balls, i, table.for_kernels) == pytest.approx(2.0 + lasts, rel=1e-14)
            for share in (0.0, rng.random(), 1.0):
                step = share * lasts
                place, velocity, slowing = look(balls, i, table.for_kernels, 2.0 + step)
                x, v = naive_events.advance(
                    table.positions, velocities, step * (1 - 1e-15), table.deceleration
                )
                assert place == pytest.approx(tuple(x[i]), abs=1e-12)
                assert velocity == pytest.approx(tuple(v[i]), abs=1e-12)
                assert math.hypot(*slowing) == pytest.approx(table.deceleration, rel=1e-14)
                assert np.dot(slowing, velocities[i]) < 0.0


def test_at_the_end_of_its_phase_it_rests_where_it_was_heading():
    rng = np.random.default_rng(2)
    for _ in range(100):
        table, balls, _ = set_off_at_random(rng)
        now = ends_at(balls, 0, table.for_kernels)
        place, _, _ = look(balls, 0, table.for_kernels, now)
        changes = balls[0]['changes']
        assert end(balls, 0, table.for_kernels, now) == STOP
        assert balls[0]['phase'] == RESTS and balls[0]['changes'] == changes + 1
        assert balls[0]['since'] == now
        for later in (now, now + 5.0, 1e100):
            found, velocity, slowing = look(balls, 0, table.for_kernels, later)
            assert found == (balls[0]['x'], balls[0]['y'])
            assert found == pytest.approx(place, abs=1e-14)
            assert velocity == slowing == (0.0, 0.0)
            assert not np.signbit(slowing).any()


@pytest.mark.parametrize('velocity', [(0.0, 0.0), (-0.0, 0.0), (1e-200, 0.0)])
def test_what_is_too_slow_to_have_a_direction_rests(velocity):
    """The square of 1e-200 is no number any more."""
    table = random_table(np.random.default_rng(3), 1)
    balls = table.balls_at_rest.copy()
    begin(balls, 0, table.for_kernels, *velocity, 0.0)
    assert balls[0]['phase'] == RESTS
    assert look(balls, 0, table.for_kernels, 7.0)[1] == (0.0, 0.0)


def test_the_direction_is_a_unit_vector():
    rng = np.random.default_rng(4)
    for _ in range(100):
        _, balls, velocities = set_off_at_random(rng)
        for i in range(3):
            assert math.hypot(balls[i]['ux'], balls[i]['uy']) == pytest.approx(1.0, abs=1e-15)
            assert balls[i]['speed'] == pytest.approx(math.hypot(*velocities[i]), rel=1e-15)
            assert balls[i]['phase'] == MOVES


@pytest.mark.parametrize('friction', [0.0, 0.2])
def test_the_first_cushion_equals_the_plain_twin(friction):
    rng = np.random.default_rng(5)
    met = 0
    for _ in range(200):
        table, balls, velocities = set_off_at_random(rng, mu_ball_surface=friction)
        times = [
            naive.time_to_cushion(
                *(table.positions[0], velocities[0], table.radii[0], cushion),
                *(table.length, table.width, table.deceleration),
            )
            for cushion in range(4)
        ]
        seconds, partner = cushion_ahead(balls, 0, table.for_kernels, 2.0)
        assert seconds == pytest.approx(min(times), rel=1e-12)
        if seconds < math.inf:
            assert cushion_of_partner(partner) == int(np.argmin(times))
            met += 1
        else:
            assert partner == PHASE_END
    assert met > 50


def test_a_ball_at_rest_ahead_equals_the_plain_twin():
    rng = np.random.default_rng(6)
    met = 0
    for _ in range(500):
        friction = rng.choice([0.0, 0.2])
        table, balls, velocities = set_off_at_random(rng, mu_ball_surface=friction)
        place = rng.uniform(-0.5, 0.5, 2)
        touch = 0.9 * min(0.3, math.hypot(*place))
        found = resting_ball_ahead(balls, 0, table.for_kernels, 2.0, *place, touch)
        twin = naive.time_to_ball_at_rest(
            (0.0, 0.0), velocities[0], place, touch, table.deceleration
        )
        assert found == pytest.approx(twin, rel=1e-9)
        met += found < math.inf
    assert 50 < met < 450


def test_the_edge_of_a_cell_is_where_the_ball_leaves_it():
    rng = np.random.default_rng(7)
    left = 0
    for _ in range(300):
        table, balls, velocities = set_off_at_random(rng)
        x, y = table.positions[0]
        edges = [x - rng.random(), x + rng.random(), y - rng.random(), y + rng.random()]
        for k in range(4):
            if rng.random() < 0.3:
                edges[k] = math.copysign(math.inf, (-1, 1)[k % 2])
        seconds, *step = edge_ahead(balls, 0, table.for_kernels, 2.0, tuple(edges))
        lasts = math.hypot(*velocities[0]) / table.deceleration
        if seconds == math.inf:
            place, _, _ = look(balls, 0, table.for_kernels, 2.0 + lasts)
            assert edges[0] <= place[0] <= edges[1] and edges[2] <= place[1] <= edges[3]
            continue
        left += 1
        place, velocity, _ = look(balls, 0, table.for_kernels, 2.0 + seconds)
        axis = 0 if step[0] else 1
        assert sorted(map(abs, step)) == [0, 1] and step[axis] * velocity[axis] > 0.0
        edge = edges[2 * axis + (step[axis] > 0)]
        assert place[axis] == pytest.approx(edge, abs=1e-12)
        other = 1 - axis
        assert edges[2 * other] - 1e-12 <= place[other] <= edges[2 * other + 1] + 1e-12
    assert left > 50


def test_the_motion_of_one_ball_seen_from_another():
    rng = np.random.default_rng(8)
    for _ in range(100):
        table, balls, velocities = set_off_at_random(rng)
        motion = seen_from(balls, 0, 1, table.for_kernels, 2.0)
        (xa, va, ga), (xb, vb, gb) = (look(balls, i, table.for_kernels, 2.0) for i in (0, 1))
        expected = np.hstack([np.subtract(xb, xa), np.subtract(vb, va), np.subtract(gb, ga)])
        np.testing.assert_allclose(motion, expected, atol=1e-13)


def test_without_friction_it_never_stops():
    table = under(random_table(np.random.default_rng(9), 1), mu_ball_surface=0.0)
    balls = table.balls_at_rest.copy()
    begin(balls, 0, table.for_kernels, 0.3, -0.4, 1.0)
    assert ends_at(balls, 0, table.for_kernels) == math.inf
    _, velocity, slowing = look(balls, 0, table.for_kernels, 1e6)
    assert velocity == pytest.approx((0.3, -0.4)) and slowing == (0.0, 0.0)
