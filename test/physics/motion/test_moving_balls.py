"""Which moving balls a path may meet, beside a look at each by itself."""

import math

import numpy as np
import pytest
from numba import njit

from pool_sim_ros.physics.contact_time import RelativeMotion, time_to_moving_ball
from pool_sim_ros.physics.motion.ball_record import BALL
from pool_sim_ros.physics.motion.curved_path import CurvedPath
from pool_sim_ros.physics.motion.moving_balls import (
    MAY_MEET,
    N_ROWS,
    keep_in_rows,
    mark_those_near,
    touched_in_rows,
)

RADIUS = 0.03


@njit
def keep(balls, rows):
    for i in range(len(balls)):
        keep_in_rows(balls[i], rows, i)


@njit
def mark(path, radius, now, lasts, rows):
    mark_those_near(path, radius, now, lasts, rows)


touches = njit(touched_in_rows)


@njit
def meets_after(motion, touch, horizon):
    return time_to_moving_ball(motion, touch, horizon)


def random_balls(rng, count):
    """Return balls that slide, roll, touch one another, and hardly move, and which of them rest."""
    balls = np.zeros(count, BALL)
    balls['x'], balls['y'] = rng.uniform(0.0, 1.0, (2, count))
    speeds = rng.choice([1e-12, 0.1, 3.0], count)
    balls['vx'], balls['vy'] = rng.normal(size=(2, count)) * speeds
    balls['ax'], balls['ay'] = rng.normal(size=(2, count)) * rng.choice([0.0, 0.1, 2.0], count)
    balls['since'] = rng.uniform(0.0, 0.5, count)
    balls['phase_end'] = 0.5 + rng.choice([0.0, 0.01, 1.0], count)
    return balls, rng.random(count) < 0.2


def rows_of(balls, rests):
    rows = np.full((N_ROWS, len(balls)), math.nan)
    rows[0, rests], rows[1, rests] = balls['x'][rests], balls['y'][rests]
    rows[2] = RADIUS
    keep(balls, rows)
    return rows


@pytest.mark.parametrize('count', [1, 2, 7, 16])
def test_no_ball_is_left_out_that_is_met(count):
    rng = np.random.default_rng(count)
    met = left_out = 0
    now = 0.5
    for _ in range(400):
        balls, rests = random_balls(rng, count)
        ux, uy, speed = *rng.normal(size=2), rng.choice([0.0, 1.0, 4.0])
        path = CurvedPath(*rng.uniform(0.0, 1.0, 2), speed * ux, speed * uy, -ux, uy, 1.0, False)
        if rng.random() < 0.3:  # it touches the first one
            angle = rng.uniform(-math.pi, math.pi)
            e = now - balls['since'][0]
            x, y = (
                balls[p][0] + e * (balls[v][0] + 0.5 * e * balls[a][0])
                for p, v, a in [('x', 'vx', 'ax'), ('y', 'vy', 'ay')]
            )
            path = path._replace(
                x=x + 2 * RADIUS * math.cos(angle), y=y + 2 * RADIUS * math.sin(angle)
            )
        lasts = rng.choice([0.0, 0.02, 0.4, 1.0])
        rows = rows_of(balls, rests)
        mark(path, RADIUS, now, lasts, rows)
        for ball, still, near in zip(balls, rests, rows[MAY_MEET], strict=True):
            assert near in (0.0, 1.0)
            if still:
                assert near == 0.0, 'a ball that rests is looked at elsewhere'
                continue
            e = now - ball['since']
            motion = RelativeMotion(
                ball['x'] + e * (ball['vx'] + 0.5 * e * ball['ax']) - path.x,
                ball['y'] + e * (ball['vy'] + 0.5 * e * ball['ay']) - path.y,
                ball['vx'] + e * ball['ax'] - path.vx,
                ball['vy'] + e * ball['ay'] - path.vy,
                ball['ax'] - path.ax,
                ball['ay'] - path.ay,
            )
            touches = meets_after(motion, 2 * RADIUS, min(lasts, ball['phase_end'] - now)) < np.inf
            met += touches
            left_out += near == 0.0
            assert near == 1.0 or not touches
    assert met > 20 and left_out > 100


@pytest.mark.parametrize('count', [1, 2, 7, 16])
def test_what_touches_a_place_equals_a_look_at_each_ball(count):
    rng = np.random.default_rng(count)
    now, told = 0.5, [0, 0]
    for _ in range(2000):
        balls, rests = random_balls(rng, count)
        rows = rows_of(balls, rests)
        places = []
        for ball, still in zip(balls, rests, strict=True):
            e = 0.0 if still else now - ball['since']
            places.append(
                (
                    ball['x'] + e * (ball['vx'] + 0.5 * e * ball['ax']),
                    ball['y'] + e * (ball['vy'] + 0.5 * e * ball['ay']),
                )
            )
        pair = tuple(rng.integers(-1, count, 2).tolist())
        near = float(rng.choice([RADIUS, 0.1]))
        k, angle = rng.integers(count), rng.uniform(0.0, 2 * math.pi)
        away = (near + RADIUS) * (1.0 + rng.choice([-0.5, -1e-9, 1e-9, 0.5]))
        place = places[k][0] + away * math.cos(angle), places[k][1] + away * math.sin(angle)
        expected = any(
            math.dist(place, spot) <= near + RADIUS
            for m, spot in enumerate(places)
            if m not in pair
        )
        assert touches(None, rows, place, near, pair, now) == (True, expected)
        told[expected] += 1
    assert min(told) > 100
