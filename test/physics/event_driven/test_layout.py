"""Which layouts may be played, against a look at every pair and against `check_layout`."""

import math

import naive_shots
import numpy as np
import pytest
from numba import njit
from tables import random_layout

from pool_sim_ros.physics import Ball, Table
from pool_sim_ros.physics.event_driven.cell_grid import FEW
from pool_sim_ros.physics.event_driven.layout import place
from pool_sim_ros.physics.event_driven.state import new_state, reset, start_of
from pool_sim_ros.physics.log import new_log
from pool_sim_ros.physics.validation import is_bad

COUNTS = [1, 2, 9, 10, FEW, FEW + 1, 55]
LIMIT = 1e-9  # m: what a layout may overlap


@njit
def put(state, start, positions):
    reset(state, start, False)
    return place(state, start, positions)


def loose_table(rng, count):
    """Return a table with room for balls of unequal size."""
    radii = rng.uniform(0.01, 0.04, count)
    length, width = 0.2 * math.sqrt(count) + 0.1, 0.16 * math.sqrt(count) + 0.1
    spots = random_layout(rng, radii, length, width)
    balls = [Ball(str(k), 0.1, radii[k], tuple(spots[k])) for k in range(count)]
    return Table(length, width, balls)


def begun(table):
    state = new_state(table.for_kernels, table.balls_at_rest, new_log(0, 0))
    return state, start_of(state)


def spoiled(rng, table, layout):
    """Bring two balls, or a ball and a cushion, to some small gap; or lose a ball."""
    layout = layout.copy()
    n = len(layout)
    i, j = rng.integers(n, size=2)
    gap = rng.choice([-1e-9 * (1 + 1e-5), -1e-9 * (1 - 1e-5), -2e-9, 0.0, 1e-12, 1e-3, -0.005])
    if i != j and rng.random() < 0.7:
        angle = rng.choice([rng.uniform(-math.pi, math.pi), 0.0, math.pi / 2])
        apart = table.radii[i] + table.radii[j] + gap
        layout[i] = layout[j] + apart * np.array([math.cos(angle), math.sin(angle)])
    else:
        axis, far = rng.integers(2, size=2)
        size = (table.length, table.width)[axis]
        layout[i, axis] = size - table.radii[i] - gap if far else table.radii[i] + gap
    return layout


@pytest.mark.parametrize('count', COUNTS)
def test_any_layout(count):
    """Far from the table's own and near it, sound or not."""
    rng = np.random.default_rng(count)
    table = loose_table(rng, count)
    state, start = begun(table)
    verdicts = []
    for trial in range(600):
        if trial % 3 == 0:
            noise = 10.0 ** rng.uniform(-9, -1)
            layout = table.positions + noise * rng.uniform(-1.0, 1.0, (count, 2))
        elif trial % 30 == 1:
            layout = random_layout(rng, table.radii, table.length, table.width)
        else:
            layout = spoiled(rng, table, table.positions)
        found = put(state, start, layout)
        assert found == (not is_bad(table, layout))
        overlap = naive_shots.overlap(table, layout)
        if abs(overlap - LIMIT) > 1e-15:
            assert found == (overlap <= LIMIT)
        verdicts.append(found)
        np.testing.assert_array_equal(state.balls['x'], layout[:, 0])
        np.testing.assert_array_equal(state.balls['y'], layout[:, 1])
    assert 0 < sum(verdicts) < len(verdicts)


@pytest.mark.parametrize('count', [2, 9, FEW + 10])
@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf, 1e300])
def test_a_ball_that_is_nowhere(count, value):
    rng = np.random.default_rng(count)
    table = loose_table(rng, count)
    state, start = begun(table)
    for i in range(count):
        for axis in (0, 1):
            layout = table.positions.copy()
            layout[i, axis] = value
            assert not put(state, start, layout)
    assert put(state, start, table.positions)


@pytest.mark.parametrize('count', [9, FEW + 10])
def test_any_two_balls_that_overlap_are_found(count):
    """Each pair, so that no loop over pairs leaves one out."""
    rng = np.random.default_rng(count)
    table = loose_table(rng, count)
    state, start = begun(table)
    pairs = [(i, j) for i in range(count) for j in range(count) if i != j]
    for i, j in pairs if count < 20 else rng.permutation(pairs)[:300]:
        layout = table.positions.copy()
        layout[i] = layout[j]
        assert not put(state, start, layout)


@pytest.mark.parametrize('count', [3, FEW + 5])
@pytest.mark.parametrize('largest', [0.04, 0.004])
def test_agrees_with_the_check_to_the_last_bit(largest, count):
    """Both decide alike where rounding decides, else `simulate` would blame something else."""
    rng = np.random.default_rng(5)
    radii = rng.uniform(0.1 * largest, largest, count)
    side = 8.0 * largest * math.sqrt(count)
    spots = random_layout(rng, radii, side, side)
    balls = [Ball(str(k), 0.1, radii[k], tuple(spots[k])) for k in range(count)]
    table = Table(side, side, balls)
    state, start = begun(table)
    verdicts = set()
    for _ in range(3000):
        i, j = rng.choice(count, 2, replace=False)
        apart = table.radii[i] + (table.radii[j] - LIMIT)
        layout = table.positions.copy()
        # Rounded, so that the distance is exact to the last bit.
        layout[j] = np.round(layout[j] * 2**16) / 2**16
        layout[i] = layout[j] + (apart + rng.integers(-2, 3) * np.spacing(apart), 0.0)
        found = put(state, start, layout)
        assert found == (not is_bad(table, layout)), (i, j)
        verdicts.add(found)
    assert verdicts == {True, False}
