"""Distances and times along a straight path, against plain twins and 50 digits."""

import math

import naive
import numpy as np
import pytest
from mpmath import mp, mpf
from tables import random_table

from pool_sim_ros.physics.motion import MOVES, RESTS
from pool_sim_ros.physics.motion.straight_path import (
    StraightPath,
    distance_covered,
    distance_to_resting_ball,
    first_on_path,
    time_to_cover,
)

A = 0.980665


def test_ball_at_rest_against_twin():
    rng = np.random.default_rng(23)
    hits = 0
    for _ in range(1000):
        velocity = rng.normal(size=2)
        target = rng.uniform(-0.5, 0.5, 2)
        if math.hypot(*target) < 0.11:
            continue
        speed = math.hypot(*velocity)
        distance = distance_to_resting_ball(*target, *(velocity / speed), 0.11, math.inf)
        if distance <= speed * speed / (2 * A):
            found = time_to_cover(distance, speed, A)
        else:
            found = math.inf
        twin = naive.time_to_ball_at_rest((0.0, 0.0), velocity, target, 0.11, A)
        assert found == pytest.approx(twin, rel=1e-11)
        hits += math.isfinite(found)
    assert hits > 20


@pytest.mark.parametrize('speed', [1e-12, 1e-3, 1.0, 100.0])
@pytest.mark.parametrize('share', [0.0, 1e-15, 0.5, 1.0 - 1e-12, 1.0])
def test_time_to_cover(speed, share):
    stopping_distance = speed * speed / (2 * A)
    distance = share * stopping_distance
    with mp.workdps(50):
        under_root = max(mpf(speed) ** 2 - 2 * mpf(A) * mpf(distance), mpf(0))
        exact = float((mpf(speed) - mp.sqrt(under_root)) / mpf(A))
    found = time_to_cover(distance, speed, A)
    # At the very end of the distance the root of a rounding, 1e-8 of the whole time, remains.
    assert found == pytest.approx(exact, rel=1e-7 if share > 0.9 else 1e-14)


def test_time_to_cover_without_friction():
    assert time_to_cover(0.5, 2.0, 0.0) == 0.25


def test_distance_covered_is_the_inverse_of_time_to_cover():
    rng = np.random.default_rng(24)
    for speed, share in zip(rng.uniform(0.01, 10.0, 100), rng.uniform(0.0, 0.9, 100), strict=True):
        distance = share * speed * speed / (2 * A)
        lasts = time_to_cover(distance, speed, A)
        assert distance_covered(lasts, speed, A) == pytest.approx(distance, rel=1e-12)
    assert distance_covered(math.inf, 1.0, A) == math.inf


def rows_of(balls):
    """Return where balls rest, as `few_balls` has it."""
    moves = balls['phase'] != RESTS
    x = np.where(moves, np.nan, balls['x'])
    return np.array([x, balls['y'], balls['radius'], np.zeros(len(balls))])


@pytest.mark.parametrize('count', [1, 3, 11, 12])
def test_the_first_on_a_path(count):
    rng = np.random.default_rng(count)
    met = 0
    for _ in range(500):
        balls = random_table(rng, count).balls_at_rest.copy()
        moving = rng.random(count) < 1 / 3
        balls['phase'] = np.where(moving, MOVES, RESTS)
        rows = rows_of(balls)
        x, y = rng.uniform(0.0, 1.0, 2)
        angle = rng.choice([rng.uniform(-math.pi, math.pi), 0.0, math.pi / 2])
        radius, reach = rng.choice([0.0, 0.03, 0.2]), rng.choice([0.0, 0.3, 5.0, math.inf])
        path = StraightPath(x, y, math.cos(angle), math.sin(angle), 1.0)
        distance, partner = first_on_path(path, radius, reach, rows)
        expected = naive.first_in_the_way(balls, (x, y), (path.ux, path.uy), radius, reach)
        assert partner == expected[1]
        assert distance == pytest.approx(expected[0], abs=1e-12)
        met += partner >= 0
    assert 0 < met < 500


def test_it_meets_what_it_touches_but_not_what_it_grazes_or_leaves():
    balls = random_table(np.random.default_rng(1), 1).balls_at_rest.copy()
    balls['x'], balls['y'], balls['radius'] = 0.5, 0.5, 0.125
    rows = rows_of(balls)
    for x, y, ux, uy, expected in (
        (0.25, 0.5, 1.0, 0.0, (0.0, 0)),
        (0.3, 0.5, 1.0, 0.0, (0.0, 0)),
        (0.25, 0.5, -1.0, 0.0, (9.0, -1)),
        (0.0, 0.75, 1.0, 0.0, (9.0, -1)),
        (0.0, 0.5, 1.0, 0.0, (0.25, 0)),
    ):
        assert first_on_path(StraightPath(x, y, ux, uy, 1.0), 0.125, 9.0, rows) == expected
