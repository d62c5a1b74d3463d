"""The resting balls on a curved path, against a dense sampling of it."""

import math

import numpy as np
import pytest
from curved_paths import random_path, sampled
from numba import njit

from pool_sim_ros.physics.motion.ball_record import BALL
from pool_sim_ros.physics.motion.curved_path import (
    CurvedPath,
    first_in_rows,
    first_of_listed,
    time_to_place,
)

RADIUS = 0.03


@njit
def first_at_once(path, radius, lasts, rows):
    return first_in_rows(path, radius, lasts, rows)


@njit
def first_one_by_one(path, radius, lasts, balls, listed, count):
    return first_of_listed(path, radius, lasts, balls, listed, count)


@njit
def time_to(path, dx, dy, touch, before):
    return time_to_place(path, dx, dy, touch, before)


def test_no_ball_is_left_out_that_the_path_touches():
    """The first of several, whose contact a dense sampling sees; also one that touches already."""
    rng = np.random.default_rng(2)
    met = near = 0
    for _ in range(3000):
        path = random_path(rng)
        count = rng.integers(1, 13)
        times, points = sampled(path, path.lasts, 2000)
        rows = np.zeros((4, count))
        rows[2] = rng.choice([0.02, 0.05])
        touch = RADIUS + rows[2, 0]
        for k in range(count):
            # Close to the path, so that about half of them are touched, and most just so.
            angle, off = rng.uniform(-math.pi, math.pi), touch * rng.uniform(0.9, 1.1)
            spot = points[rng.integers(len(points))] + off * np.array(
                [math.cos(angle), math.sin(angle)]
            )
            if rng.random() < 0.1:
                spot = np.array([math.nan, math.nan]) if rng.random() < 0.5 else np.full(2, np.inf)
            elif math.dist(spot, points[0]) < touch:
                spot = points[0] + (touch + rng.choice([0.0, 0.01])) * (spot - points[0]) / (
                    math.dist(spot, points[0])
                )
            rows[:2, k] = spot
        before = path.lasts * rng.choice([1.0, 2.0, rng.random()])
        seconds, ball = first_at_once(path, RADIUS, before, rows)
        end = min(before, path.lasts)
        gaps = np.hypot(*(points[:, np.newaxis] - rows[:2].T).transpose(2, 0, 1)) - touch
        gaps[times > end] = np.inf
        cut = np.argwhere(gaps < -1e-12)
        if ball < 0:
            assert not len(cut) and seconds == end
            continue
        met += 1
        near += seconds > 0.0
        # No ball is cut into before the contact, and there the one that is named is touched.
        earlier = times < seconds
        assert not (gaps[earlier] < -1e-12).any()
        place = np.array(path[:2]) + seconds * (
            np.array(path[2:4]) + 0.5 * seconds * np.array(path[4:6])
        )
        assert math.dist(place, rows[:2, ball]) == pytest.approx(touch, abs=1e-12)
        each = [
            time_to(path, *(rows[:2, k] - path[:2]), touch, end)
            for k in range(count)
            if np.isfinite(rows[0, k])
        ]
        # To the last bits: the one after the other looks less and less far ahead.
        assert seconds == pytest.approx(min(each), rel=1e-12)
    assert met > 800 and near > 500


def test_one_by_one_gives_what_all_at_once_does():
    rng = np.random.default_rng(3)
    met = 0
    for _ in range(3000):
        path, count = random_path(rng), 8
        balls = np.zeros(count, BALL)
        balls['x'], balls['y'] = rng.uniform(-0.5, 1.5, (2, count))
        balls['radius'] = RADIUS
        listed = rng.permutation(count)
        used = rng.integers(0, count + 1)
        rows = np.full((4, count), np.nan)
        for k in listed[:used]:
            rows[:3, k] = balls[k]['x'], balls[k]['y'], RADIUS
        at_once = first_at_once(path, RADIUS, path.lasts, rows)
        seconds, ball = first_one_by_one(path, RADIUS, path.lasts, balls, listed, used)
        assert ball == at_once[1] and seconds == pytest.approx(at_once[0], rel=1e-12)
        met += at_once[1] >= 0
    assert met > 50


def test_a_graze_and_what_is_due_at_the_end_are_no_contacts():
    path = CurvedPath(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, False)
    assert time_to(path, 1.0, 0.0, 0.25, 9.0) == 0.75
    assert time_to(path, 1.0, 0.0, 0.25, 0.75) == math.inf
    assert time_to(path._replace(lasts=0.75), 1.0, 0.0, 0.25, 9.0) == math.inf
    assert time_to(path, 1.0, 0.2500001, 0.25, 9.0) == math.inf
