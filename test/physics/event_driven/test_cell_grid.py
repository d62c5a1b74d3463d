"""Who is listed as near a ball on a table with many, against all pairs."""

import naive
import numpy as np
from benchmark.workloads import dense_table

from pool_sim_ros.physics.event_driven.cell_grid import (
    cell_edges,
    enter,
    fill,
    leave,
    move_on,
    neighbours,
    new_grid,
)


def crowded(rng, count=60):
    """Return balls and their cells; they may overlap, so that some grid hold many."""
    table = dense_table(count, decelerating=True)
    balls = table.balls_at_rest.copy()
    balls['x'] = rng.uniform(0.0, table.length, count) ** 2 / table.length
    balls['y'] = rng.uniform(0.0, table.width, count) ** 2 / table.width
    grid = new_grid(table.length, table.width, balls)
    fill(balls, grid)
    return balls, grid


def assert_all_are_near(balls, grid):
    for i in range(len(balls)):
        listed = grid.near[: neighbours(balls, grid, i)].tolist()
        assert sorted(listed) == naive.neighbours(balls, i)


def test_neighbours_are_listed_once_each():
    rng = np.random.default_rng(31)
    balls, grid = crowded(rng)
    most = max(np.unique(balls[['cell_x', 'cell_y']], return_counts=True)[1])
    assert most > 3
    assert_all_are_near(balls, grid)


def test_neighbours_after_some_went_elsewhere():
    rng = np.random.default_rng(32)
    balls, grid = crowded(rng)
    rows, columns = grid.first.shape
    for _ in range(40):
        for i in rng.permutation(len(balls))[:10]:
            leave(balls, grid, i)
            balls[i]['cell_x'], balls[i]['cell_y'] = rng.integers(columns), rng.integers(rows)
            enter(balls, grid, i)
        assert_all_are_near(balls, grid)


def test_a_grid_is_filled_anew():
    rng = np.random.default_rng(33)
    balls, grid = crowded(rng)
    balls['x'] = rng.permutation(balls['x'])
    fill(balls, grid)
    assert_all_are_near(balls, grid)


def test_no_edge_of_a_cell_is_a_side_of_the_table():
    balls, grid = crowded(np.random.default_rng(34))
    rows, columns = grid.first.shape
    for x in range(columns):
        for y in range(rows):
            balls[0]['cell_x'], balls[0]['cell_y'] = x, y
            x_low, x_high, y_low, y_high = cell_edges(grid, balls[0])
            assert x_low == (x * grid.width if x > 0 else -np.inf)
            assert x_high == ((x + 1) * grid.width if x < columns - 1 else np.inf)
            assert y_low == (y * grid.height if y > 0 else -np.inf)
            assert y_high == ((y + 1) * grid.height if y < rows - 1 else np.inf)


def test_going_on_to_the_next_cell_lists_who_was_not_near_before():
    rng = np.random.default_rng(35)
    balls, grid = crowded(rng)
    rows, columns = grid.first.shape
    moved = 0
    for _ in range(300):
        i = rng.integers(len(balls))
        step_x, step_y = [(1, 0), (-1, 0), (0, 1), (0, -1)][rng.integers(4)]
        x, y = balls[i]['cell_x'] + step_x, balls[i]['cell_y'] + step_y
        if not (0 <= x < columns and 0 <= y < rows):
            continue
        before = set(naive.neighbours(balls, i))
        count = move_on(balls, grid, i, step_x, step_y)
        assert (balls[i]['cell_x'], balls[i]['cell_y']) == (x, y)
        assert sorted(grid.near[:count]) == sorted(set(naive.neighbours(balls, i)) - before)
        assert_all_are_near(balls, grid)
        moved += count > 0
    assert moved > 20
