"""How a ball slides, rolls and spins: against vectors in space, and what of it must hold."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from numba import njit

from pool_sim_ros.physics.boundary import Rectangle, pocketed_boundary
from pool_sim_ros.physics.contacts import BallLaw, EdgeLaw
from pool_sim_ros.physics.log import ROLL, SPIN_SEGMENT, STOP
from pool_sim_ros.physics.motion import (
    BALL,
    RESTS,
    ROLLS,
    SLIDES,
    BallTable,
    acceleration,
    advance,
    catch,
    end_phase,
    first_resting_ball,
    first_resting_of,
    give_spin,
    in_play,
    lie_at,
    log_spin,
    path_from,
    phase_end_time,
    pocket_of,
    position_at,
    relative_motion,
    rest_begins,
    set_off,
    shown_at,
    time_to_cell_edge,
    time_to_resting_ball,
    velocity_at,
)
from pool_sim_ros.physics.motion.ball_record import spheres_at_rest

RADIUS, SLIDE, ROLL_LOSS, SPIN_LOSS = 0.03, 2.0, 0.1, 10.0
TABLE = BallTable(
    boundary=Rectangle(2.0, 1.0),
    slide=SLIDE,
    roll=ROLL_LOSS,
    spin=SPIN_LOSS,
    radius=RADIUS,
    rubbing=BallLaw(0.05, False, False),
    edge=EdgeLaw(0, 0.8, 0.2, 0.037, 0.2),
    e_cue_ball=0.95,
    e_ball_ball=0.95,
    e_ball_cushion=0.8,
    coulomb=True,
    cue_ball=0,
)


class Seen(NamedTuple):
    """What is seen of a ball."""

    place: tuple
    velocity: tuple
    spin: tuple
    phase: int
    ends: float


@njit
def begin(balls, table, v, w, now):
    ball = balls[0]
    ball.since = now
    give_spin(ball, table, w[0], w[1], w[2])
    set_off(ball, table, v[0], v[1])


@njit
def look(balls, table, t):
    ball = balls[0]
    return position_at(ball, table, t), velocity_at(ball, table, t), acceleration(ball, table)


@njit
def go_to(balls, table, now):
    return advance(balls[0], table, now)


@njit
def end(balls, table, now):
    return end_phase(balls[0], table, now)


@njit
def ends_at(balls, table):
    return phase_end_time(balls[0], table)


@njit
def spin_ends_at(balls, table):
    return rest_begins(balls[0], table)


@njit
def path_at(balls, table, now):
    return path_from(balls[0], table, now)


@njit
def edge_ahead(path, table, edges):
    return time_to_cell_edge(path, table, *edges)


@njit
def ahead(path, table, lasts, rows, balls, listed):
    radius = table.radius
    return (
        first_resting_ball(path, table, radius, lasts, rows),
        first_resting_of(path, table, radius, lasts, balls, listed, len(listed)),
        time_to_resting_ball(
            path, table, rows[0, 0] - path.x, rows[1, 0] - path.y, radius + rows[2, 0]
        ),
    )


@njit
def seen_from(path, other, table):
    return relative_motion(path, table, other)


@njit
def put_and_catch(balls, table, x, y, pocket):
    ball = balls[0]
    lie_at(ball, table, x, y)
    lies = in_play(ball, table), pocket_of(ball, table), shown_at(ball, table)
    if pocket >= 0:
        catch(ball, table, pocket, 3.0)
    return lies, (in_play(ball, table), pocket_of(ball, table), shown_at(ball, table))


@njit
def written(balls, table, segments):
    log_spin(segments[0], balls[0], table)


def one_ball(boundary=TABLE.boundary):
    one = np.ones(1)
    at = np.array([[1.0, 0.5]])
    return spheres_at_rest(at, RADIUS * one, 0.17 * one, one == 1.0, boundary)


def seen(balls):
    b = balls[0]
    place, velocity = (float(b['x']), float(b['y'])), (float(b['vx']), float(b['vy']))
    return Seen(place, velocity, tuple(b[['wx', 'wy', 'wz']].tolist()), b['phase'], b['phase_end'])


def slip_of(v, w):
    """Return the velocity of the point that touches the cloth."""
    return np.append(v, 0.0) + np.cross(w, (0.0, 0.0, -RADIUS))


def slide(v, w, t):
    """Return how far a ball slides in t s, and its velocity and spin then, by force and torque."""
    force = -SLIDE * slip_of(v, w) / np.linalg.norm(slip_of(v, w))  # for 1 kg
    turning = np.cross((0.0, 0.0, -RADIUS), force) / (0.4 * RADIUS**2)
    w = np.array(w) + t * turning
    w[2] = math.copysign(max(abs(w[2]) - SPIN_LOSS * t, 0.0), w[2])
    return t * np.array(v) + 0.5 * t * t * force[:2], np.array(v) + t * force[:2], w


def random_start(rng):
    v = rng.normal(0.0, rng.choice([0.0, 0.3, 2.0]), 2)
    return v, rng.normal(0.0, 40.0, 3)


def test_it_slides_as_force_and_torque_have_it():
    rng = np.random.default_rng(1)
    for _ in range(300):
        v, w = random_start(rng)
        balls = one_ball()
        begin(balls, TABLE, v, w, 2.0)
        assert balls[0]['phase'] == SLIDES
        lasts = 2.0 * np.linalg.norm(slip_of(v, w)) / (7.0 * SLIDE)
        assert ends_at(balls, TABLE) == pytest.approx(2.0 + lasts, abs=1e-14)
        t = lasts * rng.random()
        far, velocity, spin = slide(v, w, t)
        place, found, slowing = look(balls, TABLE, 2.0 + t)
        assert place == pytest.approx(tuple(far + (1.0, 0.5)), abs=1e-13)
        assert found == pytest.approx(tuple(velocity), abs=1e-13)
        assert math.hypot(*slowing) == pytest.approx(SLIDE, rel=1e-14)
        # To go there changes nothing of where it goes.
        assert go_to(balls, TABLE, 2.0 + t) == found
        assert seen(balls).place == place and seen(balls).spin == pytest.approx(spin, abs=1e-10)
        later = 2.0 + 0.5 * (t + lasts)
        far, velocity, _ = slide(v, w, later - 2.0)
        place, found, _ = look(balls, TABLE, later)
        assert place == pytest.approx(tuple(far + (1.0, 0.5)), abs=1e-13)
        assert found == pytest.approx(tuple(velocity), abs=1e-13)


def test_when_the_slip_is_gone_it_rolls_with_v_less_two_sevenths_of_the_slip():
    rng = np.random.default_rng(2)
    for _ in range(300):
        v, w = random_start(rng)
        balls = one_ball()
        begin(balls, TABLE, v, w, 2.0)
        now = ends_at(balls, TABLE)
        place, velocity, _ = look(balls, TABLE, now)
        changes = balls[0]['changes']
        assert end(balls, TABLE, now) == ROLL
        found = seen(balls)
        assert found.place == pytest.approx(place, abs=1e-13)
        assert found.velocity == pytest.approx(velocity, abs=1e-13)
        expected = v - 2.0 / 7.0 * slip_of(v, w)[:2]
        assert found.velocity == pytest.approx(tuple(expected), abs=1e-14)
        assert np.abs(slip_of(found.velocity, found.spin)).max() < 1e-15
        left = max(abs(w[2]) - SPIN_LOSS * (now - 2.0), 0.0)
        assert abs(found.spin[2]) == pytest.approx(left, abs=1e-9)
        assert found.phase == ROLLS and balls[0]['since'] == now
        # Nobody who is about to meet it need know.
        assert balls[0]['changes'] == changes


def test_it_rolls_without_slip_until_it_rests():
    rng = np.random.default_rng(3)
    for _ in range(200):
        v = rng.normal(0.0, 1.0, 2)
        w = np.array([-v[1] / RADIUS, v[0] / RADIUS, rng.normal(0.0, 300.0)])
        balls = one_ball()
        begin(balls, TABLE, v, w, 2.0)
        assert balls[0]['phase'] == ROLLS
        speed = math.hypot(*v)
        lasts = speed / ROLL_LOSS
        assert ends_at(balls, TABLE) == pytest.approx(2.0 + lasts)
        t = lasts * rng.random()
        place, velocity, _ = look(balls, TABLE, 2.0 + t)
        assert velocity == pytest.approx(tuple(v * (1.0 - t / lasts)), abs=1e-14)
        assert place == pytest.approx(
            tuple((1.0, 0.5) + v * t * (1.0 - 0.5 * t / lasts)), abs=1e-12
        )
        go_to(balls, TABLE, 2.0 + t)
        assert np.abs(slip_of(velocity, seen(balls).spin)).max() < 1e-14
        now = ends_at(balls, TABLE)
        place, velocity, _ = look(balls, TABLE, now)
        assert velocity == pytest.approx((0.0, 0.0), abs=1e-12)
        changes = balls[0]['changes']
        assert end(balls, TABLE, now) == STOP
        assert balls[0]['changes'] == changes + 1
        found = seen(balls)
        assert found.place == pytest.approx(place, abs=1e-12)
        assert found.phase == RESTS and found.ends == math.inf
        left = max(abs(w[2]) - SPIN_LOSS * (now - 2.0), 0.0)
        assert found.velocity == found.spin[:2] == (0.0, 0.0)
        assert abs(found.spin[2]) == pytest.approx(left, abs=1e-9)
        assert spin_ends_at(balls, TABLE) == pytest.approx(now + left / SPIN_LOSS, abs=1e-9)
        assert look(balls, TABLE, now + 1e6) == (found.place, (0.0, 0.0), (0.0, 0.0))


@pytest.mark.parametrize('way', [-1.0, 1.0])
def test_the_spin_about_the_vertical_axis_fades_and_does_not_come_back(way):
    balls = one_ball()
    begin(balls, TABLE, (2.0, 0.0), (0.0, 0.0, way * 1.0), 0.0)
    go_to(balls, TABLE, 0.05)
    assert balls[0]['wz'] == pytest.approx(way * 0.5)
    go_to(balls, TABLE, 0.2)
    assert balls[0]['wz'] == 0.0
    go_to(balls, TABLE, 0.25)
    assert balls[0]['wz'] == 0.0 and spin_ends_at(balls, TABLE) == 0.25


def test_a_ball_that_stands_may_spin_in_place():
    balls = one_ball()
    begin(balls, TABLE, (0.0, 0.0), (0.0, 0.0, -30.0), 1.0)
    found = seen(balls)
    assert found.phase == RESTS and found.spin == (0.0, 0.0, -30.0)
    assert spin_ends_at(balls, TABLE) == pytest.approx(4.0)
    assert look(balls, TABLE, 3.0) == ((1.0, 0.5), (0.0, 0.0), (0.0, 0.0))


def test_it_may_stand_for_a_moment_while_it_slides():
    """A draw shot: it stops, still slides, and comes back."""
    balls = one_ball()
    begin(balls, TABLE, (1.0, 0.0), (0.0, -4.0 / RADIUS, 0.0), 0.0)
    place, velocity, slowing = look(balls, TABLE, 0.5)
    assert place == pytest.approx((1.25, 0.5)) and velocity == pytest.approx((0.0, 0.0))
    assert slowing == pytest.approx((-2.0, 0.0))
    assert go_to(balls, TABLE, 0.5) == pytest.approx((0.0, 0.0))
    assert balls[0]['phase'] == SLIDES
    # A path from there is one as any other, and a new motion goes on sliding.
    path = path_at(balls, TABLE, 0.5)
    assert path[:6] == pytest.approx((1.25, 0.5, 0.0, 0.0, -2.0, 0.0))
    assert not path.rolls
    assert path.lasts == pytest.approx(10.0 / 14.0 - 0.5)
    begin(balls, TABLE, (0.0, 0.0), balls[0][['wx', 'wy', 'wz']].tolist(), 0.5)
    assert balls[0]['phase'] == SLIDES
    now = ends_at(balls, TABLE)
    assert now == pytest.approx(10.0 / 14.0)
    assert end(balls, TABLE, now) == ROLL
    assert seen(balls).velocity == pytest.approx((1.0 - 10.0 / 7.0, 0.0))


def test_a_slide_that_leaves_nothing_ends_at_rest():
    """Backspin that eats up the whole velocity: 5 v = -2 R w."""
    balls = one_ball()
    begin(balls, TABLE, (1.0, 0.0), (0.0, -2.5 / 0.03125 * 1.0, 0.0), 0.0)
    table = TABLE._replace(radius=0.03125)
    balls = one_ball()
    begin(balls, table, (1.0, 0.0), (0.0, -80.0, 0.0), 0.0)
    changes = balls[0]['changes']
    assert end(balls, table, ends_at(balls, table)) == STOP
    assert balls[0]['phase'] == RESTS and balls[0]['changes'] == changes + 1
    assert seen(balls).place == pytest.approx((1.0 + 0.25, 0.5))


def test_without_any_friction_it_never_stops():
    table = TABLE._replace(slide=0.0, roll=0.0, spin=0.0)
    balls = one_ball()
    begin(balls, table, (0.3, -0.4), (1.0, 2.0, 3.0), 0.0)
    assert ends_at(balls, table) == math.inf and balls[0]['phase'] == SLIDES
    place, velocity, _ = look(balls, table, 10.0)
    assert place == pytest.approx((4.0, -3.5)) and velocity == (0.3, -0.4)
    assert math.isfinite(path_at(balls, table, 1.0).lasts)
    go_to(balls, table, 5.0)
    assert seen(balls).spin == (1.0, 2.0, 3.0)


def test_the_path_from_a_time_on_is_the_motion():
    rng = np.random.default_rng(4)
    for _ in range(100):
        balls = one_ball()
        v, w = random_start(rng)
        begin(balls, TABLE, v, w, 1.0)
        if rng.random() < 0.5:
            end(balls, TABLE, ends_at(balls, TABLE))
        balls[0]['since'] = 1.0 if balls[0]['phase'] == SLIDES else balls[0]['since']
        start, stop = balls[0]['since'], ends_at(balls, TABLE)
        now = start + rng.random() * (stop - start)
        path = path_at(balls, TABLE, now)
        assert (path[:2], path[2:4], path[4:6]) == look(balls, TABLE, now)
        assert path.lasts == pytest.approx(stop - now)
        assert path.rolls == (balls[0]['phase'] == ROLLS)
        other = path._replace(x=0.1, vy=0.2, ax=0.3)
        found = seen_from(path, other, TABLE)
        assert found == tuple(np.subtract(other[:6], path[:6]))


def test_on_a_path_that_is_straight_both_ways_give_one_answer():
    """Of what a rolling ball meets: along the line, and by the curved path."""
    rng = np.random.default_rng(5)
    met = 0
    for _ in range(2500):
        balls = one_ball()
        v = rng.normal(0.0, 0.4, 2)
        begin(balls, TABLE, v, (-v[1] / RADIUS, v[0] / RADIUS, 0.0), 0.0)
        assert balls[0]['phase'] == ROLLS
        path = path_at(balls, TABLE, 0.0)
        others = np.zeros(6, BALL)
        others['x'], others['y'] = rng.uniform(0.0, (2.0, 1.0), (6, 2)).T
        others['radius'] = RADIUS
        if (np.hypot(others['x'] - 1.0, others['y'] - 0.5) < 2.0 * RADIUS).any():
            continue
        rows = np.array([others['x'], others['y'], others['radius'], np.zeros(6)])
        lasts, listed = rng.choice([0.2, 100.0]), np.arange(6)
        straight = ahead(path, TABLE, lasts, rows, others, listed)
        curved = ahead(path._replace(rolls=False), TABLE, lasts, rows, others, listed)
        for k in range(2):
            assert straight[k][1] == curved[k][1] == straight[0][1]
            if straight[k][1] >= 0:
                assert straight[k][0] == pytest.approx(curved[k][0], rel=1e-9, abs=1e-12)
        assert straight[2] == pytest.approx(curved[2], rel=1e-9, abs=1e-12)
        met += straight[0][1] >= 0
    assert met > 100


def test_the_edge_of_a_cell_is_where_it_is_first_left():
    rng = np.random.default_rng(6)
    left = 0
    for _ in range(500):
        balls = one_ball()
        begin(balls, TABLE, *random_start(rng), 0.0)
        if rng.random() < 0.4:
            end(balls, TABLE, ends_at(balls, TABLE))
        path = path_at(balls, TABLE, balls[0]['since'])
        x, y = path.x, path.y
        edges = [x - rng.random(), x + rng.random(), y - rng.random(), y + rng.random()]
        for k in range(4):
            if rng.random() < 0.3:
                edges[k] = math.copysign(math.inf, (-1, 1)[k % 2])
            elif rng.random() < 0.1:
                edges[k] = (x, y)[k // 2]
        seconds, *step = edge_ahead(path, TABLE, tuple(edges))
        until = min(seconds, path.lasts)
        t = np.linspace(0.0, until, 500)[:-1]
        places = [
            path.x + t * (path.vx + 0.5 * t * path.ax),
            path.y + t * (path.vy + 0.5 * t * path.ay),
        ]
        for axis in (0, 1):
            assert (places[axis] >= edges[2 * axis] - 1e-12).all()
            assert (places[axis] <= edges[2 * axis + 1] + 1e-12).all()
        if seconds == math.inf:
            continue
        left += 1
        assert sorted(map(abs, step)) == [0, 1]
        axis = 0 if step[0] else 1
        place = path[axis] + seconds * (path[2 + axis] + 0.5 * seconds * path[4 + axis])
        assert place == pytest.approx(edges[2 * axis + (step[axis] > 0)], abs=1e-12)
        # There it is on its way out.
        assert step[axis] * (path[2 + axis] + seconds * path[4 + axis]) >= -1e-12
    assert left > 150


def test_balls_in_and_out_of_play():
    pockets = np.array([[0.0, 0.0, 0.1], [2.0, 1.0, 0.1]])
    boundary = pocketed_boundary((2.0, 1.0), np.empty((0, 6)), np.empty((0, 3)), pockets, RADIUS)
    table, balls = TABLE._replace(boundary=boundary), one_ball(boundary)
    lies, _ = put_and_catch(balls, table, 0.3, 0.4, -1)
    assert lies == (True, -1, (0.3, 0.4))
    lies, _ = put_and_catch(balls, table, 1.95, 0.98, -1)
    assert lies == (False, 1, (2.0, 1.0)) and balls[0]['x'] == balls[0]['y'] == math.inf
    lies, caught = put_and_catch(balls, table, 0.3, 0.4, 0)
    assert lies == (True, -1, (0.3, 0.4)) and caught == (False, 0, (0.0, 0.0))
    balls = one_ball(boundary)
    begin(balls, table, (1.0, 2.0), (3.0, 4.0, 5.0), 0.0)
    changes = balls[0]['changes']
    put_and_catch(balls, table, 0.3, 0.4, 1)
    found = seen(balls)
    assert found.place == (math.inf, math.inf) and found.phase == RESTS
    assert found.velocity == (0.0, 0.0) and found.spin == (0.0, 0.0, 0.0)
    assert found.ends == math.inf and balls[0]['since'] == 3.0
    assert balls[0]['ax'] == balls[0]['ay'] == 0.0 and balls[0]['changes'] == changes + 1
    assert spin_ends_at(balls, table) == 3.0


def test_the_spin_that_is_written_down_leads_to_what_it_has_later():
    rng = np.random.default_rng(7)
    for k in range(100):
        balls, segments = one_ball(), np.zeros(1, SPIN_SEGMENT)
        begin(balls, TABLE, *random_start(rng), 0.0)
        if k % 2:
            end(balls, TABLE, ends_at(balls, TABLE))
        written(balls, TABLE, segments)
        one = segments[0]
        assert (one['wx'], one['wy'], one['wz']) == seen(balls).spin
        elapsed = rng.random() * (ends_at(balls, TABLE) - balls[0]['since'])
        go_to(balls, TABLE, balls[0]['since'] + elapsed)
        found = seen(balls).spin
        assert one['wx'] + elapsed * one['turn_x'] == pytest.approx(found[0], abs=1e-9)
        assert one['wy'] + elapsed * one['turn_y'] == pytest.approx(found[1], abs=1e-9)
    balls, segments = one_ball(), np.ones(1, SPIN_SEGMENT)
    written(balls, TABLE, segments)
    assert segments[['turn_x', 'turn_y', 'wx', 'wy', 'wz']].tolist() == [(0.0,) * 5]
