"""What is known of the resting balls of a small table, against the plain twin."""

import math

import naive
import numpy as np
import pytest
from tables import random_table

from pool_sim_ros.physics.event_driven.few_balls import (
    first_in_the_way,
    new_resting,
    note_motion,
    touches_resting,
)


def some_at_rest(rng, count):
    """Return balls of which about a third move, and what is noted of them."""
    balls = random_table(rng, count).balls_at_rest.copy()
    resting = new_resting(balls)
    for i in range(count):
        if rng.random() < 1 / 3:
            balls[i]['speed'], balls[i]['ux'] = 1.0, 1.0
            note_motion(resting, balls, i)
    return balls, resting


@pytest.mark.parametrize('count', [1, 2, 7, 8, 9, 40])
def test_what_moves_is_listed_in_order(count):
    rng = np.random.default_rng(count)
    balls = random_table(rng, min(count, 12)).balls_at_rest[rng.integers(0, min(count, 12), count)]
    resting = new_resting(balls)
    for _ in range(300):
        i = rng.integers(count)
        balls[i]['x'], balls[i]['y'] = rng.random(2)
        balls[i]['speed'] = rng.choice([0.0, 0.0, 1e-300, 3.0])
        note_motion(resting, balls, i)
        moves = balls['speed'] > 0.0
        assert resting.moving[: resting.count[0]].tolist() == np.flatnonzero(moves).tolist()
        assert np.array_equal(resting.x, np.where(moves, np.nan, balls['x']), equal_nan=True)
        assert np.array_equal(resting.y[~moves], balls['y'][~moves])


def test_of_a_table_with_many_balls_nothing_is_noted():
    balls = random_table(np.random.default_rng(0), 5).balls_at_rest.copy()
    resting = new_resting(balls[:0])
    balls['speed'] = 1.0
    note_motion(resting, balls, 3)
    assert resting.count[0] == 0


@pytest.mark.parametrize('count', [1, 3, 11, 12])
def test_the_first_in_the_way(count):
    rng = np.random.default_rng(count)
    met = 0
    for _ in range(500):
        balls, resting = some_at_rest(rng, count)
        x, y = rng.uniform(0.0, 1.0, 2)
        angle = rng.choice([rng.uniform(-math.pi, math.pi), 0.0, math.pi / 2])
        radius, reach = rng.choice([0.0, 0.03, 0.2]), rng.choice([0.0, 0.3, 5.0, math.inf])
        ux, uy = math.cos(angle), math.sin(angle)
        way, partner = first_in_the_way(resting, x, y, ux, uy, radius, reach)
        expected = naive.first_in_the_way(balls, (x, y), (ux, uy), radius, reach)
        assert partner == expected[1]
        assert way == pytest.approx(expected[0], abs=1e-12)
        met += partner >= 0
    assert 0 < met < 500


def test_it_meets_what_it_touches_but_not_what_it_grazes_or_leaves():
    balls = random_table(np.random.default_rng(1), 1).balls_at_rest.copy()
    balls['x'], balls['y'], balls['radius'] = 0.5, 0.5, 0.125
    resting = new_resting(balls)
    for x, y, ux, uy, expected in (
        (0.25, 0.5, 1.0, 0.0, (0.0, 0)),
        (0.3, 0.5, 1.0, 0.0, (0.0, 0)),
        (0.25, 0.5, -1.0, 0.0, (9.0, -1)),
        (0.0, 0.75, 1.0, 0.0, (9.0, -1)),
        (0.0, 0.5, 1.0, 0.0, (0.25, 0)),
    ):
        assert first_in_the_way(resting, x, y, ux, uy, 0.125, 9.0) == expected


def test_what_touches():
    rng = np.random.default_rng(5)
    found = 0
    for _ in range(500):
        balls, resting = some_at_rest(rng, 12)
        x, y = rng.uniform(0.0, 1.0, 2)
        i, but = rng.integers(0, 12), rng.integers(-5, 12)
        expected = any(
            math.dist((x, y), (ball['x'], ball['y'])) <= 0.1 + ball['radius']
            for k, ball in enumerate(balls)
            if ball['speed'] == 0.0 and k not in (i, but)
        )
        assert touches_resting(resting, x, y, 0.1, i, but) == expected
        found += expected
    assert 0 < found < 500
