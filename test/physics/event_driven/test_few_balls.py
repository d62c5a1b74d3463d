"""What is known of the resting balls of a small table, against the plain twin."""

import math

import numpy as np
import pytest
from tables import random_table

from pool_sim_ros.physics.event_driven.few_balls import (
    X,
    Y,
    n_moving,
    new_few_balls,
    note_motion,
    put_at_rest,
    touches_resting,
)
from pool_sim_ros.physics.motion import MOVES, RESTS


def some_at_rest(rng, count):
    """Return balls of which about a third move, and what is noted of them."""
    balls = random_table(rng, count).balls_at_rest.copy()
    few = new_few_balls(balls, wanted=True)
    for i in range(count):
        if rng.random() < 1 / 3:
            balls[i]['phase'] = MOVES
            note_motion(few, balls, i)
    return balls, few


@pytest.mark.parametrize('count', [1, 2, 7, 8, 9, 40])
def test_what_moves_is_listed_in_order(count):
    rng = np.random.default_rng(count)
    balls = random_table(rng, min(count, 12)).balls_at_rest[rng.integers(0, min(count, 12), count)]
    few = new_few_balls(balls, wanted=True)
    for _ in range(300):
        i = rng.integers(count)
        balls[i]['x'], balls[i]['y'] = rng.random(2)
        balls[i]['phase'] = rng.choice([RESTS, RESTS, MOVES])
        note_motion(few, balls, i)
        moves = balls['phase'] != RESTS
        assert few.moving[: n_moving(few)].tolist() == np.flatnonzero(moves).tolist()
        assert np.array_equal(
            few.rows[X, :count], np.where(moves, np.nan, balls['x']), equal_nan=True
        )
        assert np.array_equal(few.rows[Y, :count][~moves], balls['y'][~moves])


def test_of_a_table_with_many_balls_nothing_is_noted():
    balls = random_table(np.random.default_rng(0), 5).balls_at_rest.copy()
    few = new_few_balls(balls, wanted=False)
    balls['phase'] = MOVES
    note_motion(few, balls, 3)
    put_at_rest(few, 3, 0.5, 0.5)
    assert n_moving(few) == 0


def test_what_touches():
    rng = np.random.default_rng(5)
    found = 0
    for _ in range(500):
        balls, few = some_at_rest(rng, 12)
        x, y = rng.uniform(0.0, 1.0, 2)
        i, but = rng.integers(0, 12), rng.integers(-5, 12)
        expected = any(
            math.dist((x, y), (ball['x'], ball['y'])) <= 0.1 + ball['radius']
            for k, ball in enumerate(balls)
            if ball['phase'] == RESTS and k not in (i, but)
        )
        assert touches_resting(few, x, y, 0.1, i, but) == expected
        found += expected
    assert 0 < found < 500
