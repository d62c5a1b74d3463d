"""A capsule round a curved path, against a dense sampling of it."""

import math

import numpy as np
import pytest
from curved_paths import random_path, sampled
from numba import njit

from pool_sim_ros.physics.capsule import capsule_of, room_beside
from pool_sim_ros.physics.motion.curved_path import CurvedPath


@njit
def capsule(path, lasts):
    return capsule_of(path, lasts)


@njit
def room(path, lasts, dx, dy, reach):
    return room_beside(capsule_of(path, lasts), dx, dy, reach)


def test_the_path_stays_in_its_capsule():
    rng = np.random.default_rng(1)
    turned = 0
    for _ in range(1000):
        path = random_path(rng)
        lasts = path.lasts * rng.choice([1.0, rng.random()])
        found = capsule(path, lasts)
        _, points = sampled(path, lasts, 500)
        relative = points - points[0]
        along = relative @ (found.ux, found.uy)
        across = relative @ (found.uy, -found.ux)
        beyond = along - np.clip(along, 0.0, found.length)
        assert np.hypot(across, beyond).max() <= found.sag + 1e-12
        assert math.hypot(found.ux, found.uy) == pytest.approx(1.0, abs=1e-14)
        turned += np.abs(beyond).max() > 1e-6
    assert turned > 50


def test_a_path_that_ends_where_it_began_has_a_capsule_too():
    path = CurvedPath(0.5, 0.5, 1.0, 0.0, -2.0, 0.0, 1.0, False)
    found = capsule(path, 1.0)
    assert found.length == 0.0 and found.sag == 0.25
    still = capsule(path._replace(vx=0.0, ax=0.0), 1.0)
    assert still.length == still.sag == 0.0


def test_what_the_path_touches_has_no_room():
    rng = np.random.default_rng(3)
    touched = beside = 0
    for _ in range(2000):
        path, reach = random_path(rng), rng.choice([0.0, 0.03, 0.5])
        _, points = sampled(path, path.lasts, 500)
        dx, dy = points[rng.integers(500)] - points[0] + rng.normal(0.0, 2.0 * reach + 0.01, 2)
        nearest = np.hypot(*(points - points[0] - (dx, dy)).T).min()
        left = room(path, path.lasts, dx, dy, reach)
        if nearest <= reach:
            touched += 1
            assert left <= 0.0
        beside += left > 0.0
    assert touched > 200 and beside > 200
