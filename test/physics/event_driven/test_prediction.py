"""Which balls a moving one looks at, against the plain twin."""

import naive
import numpy as np
import pytest
from benchmark.workloads import dense_table
from numba import njit

from pool_sim_ros.physics.event_driven.cell_grid import neighbours
from pool_sim_ros.physics.event_driven.prediction import is_among, sort_out
from pool_sim_ros.physics.event_driven.state import new_state
from pool_sim_ros.physics.log import new_log
from pool_sim_ros.physics.motion import MOVES, RESTS, first_resting_of, path_from


@njit
def first_of(table, balls, i, lasts, listed):
    """Ask for the first of the `listed` resting balls on the path of ball `i`."""
    path = path_from(balls[i], table, 0.0)
    return first_resting_of(path, table, balls[i].radius, lasts, balls, listed, len(listed))


def crowded(rng, count=60):
    """Return a state with many balls; they may overlap, so that some cells hold many."""
    table = dense_table(count, decelerating=True)
    balls = table.balls_at_rest.copy()
    balls['x'] = rng.uniform(0.0, table.length, count) ** 2 / table.length
    balls['y'] = rng.uniform(0.0, table.width, count) ** 2 / table.width
    return new_state(table.for_kernels, balls, new_log(0, 0))


def test_those_near_are_sorted_out():
    rng = np.random.default_rng(33)
    state = crowded(rng)
    balls, grid = state.balls, state.grid
    balls['phase'] = np.where(rng.random(len(balls)) < 0.5, MOVES, RESTS)
    for i in range(len(balls)):
        count = neighbours(balls, grid, i)
        near = grid.near[:count].tolist()
        n_resting, n_others = sort_out(state, count, i)
        assert grid.near[:n_resting].tolist() == [j for j in near if balls[j]['phase'] == RESTS]
        moving = [j for j in near if balls[j]['phase'] != RESTS and j != i]
        assert grid.few.moving[:n_others].tolist() == moving


def test_the_first_of_those_that_rest():
    rng = np.random.default_rng(34)
    state = crowded(rng)
    balls, grid, table = state.balls, state.grid, state.table
    met = 0
    for i in range(len(balls)):
        angle = rng.uniform(0.0, 2.0 * np.pi)
        balls[i]['ux'], balls[i]['uy'], balls[i]['speed'] = np.cos(angle), np.sin(angle), 1.0
        balls[i]['phase'] = MOVES
        ball = balls[i]
        n_resting, _ = sort_out(state, neighbours(balls, grid, i), i)
        some = grid.near[:n_resting].copy()
        lasts = rng.choice([0.02, np.inf])
        reach = lasts * (1.0 - 0.5 * table.deceleration * lasts) if lasts < 1.0 else np.inf
        seconds, partner = first_of(table, balls, i, lasts, some)
        expected = naive.first_in_the_way(
            balls[some], (ball['x'], ball['y']), (ball['ux'], ball['uy']), ball['radius'], reach
        )
        assert partner == (some[expected[1]] if expected[1] >= 0 else -1)
        if partner >= 0:
            distance = seconds * (1.0 - 0.5 * table.deceleration * seconds)
            assert distance == pytest.approx(expected[0], abs=1e-12)
        balls[i]['speed'], balls[i]['phase'] = 0.0, RESTS
        met += partner >= 0
    assert 0 < met < len(balls)


def test_only_the_first_of_some_count():
    some = np.array([4, 2, 7])
    assert is_among(2, some, 2) and not is_among(7, some, 2) and not is_among(4, some, 0)
