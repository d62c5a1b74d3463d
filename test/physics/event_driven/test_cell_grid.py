"""Who is listed as near a ball on a table with many, against all pairs."""

import naive
import numpy as np
import pytest
from benchmark.workloads import dense_table

from pool_sim_ros.physics.event_driven.cell_grid import enter, fill, leave, neighbours, new_cells
from pool_sim_ros.physics.event_driven.prediction import first_of, sort_out


def crowded(rng, count=60):
    """Return balls and their cells; they may overlap, so that some cells hold many."""
    table = dense_table(count, decelerating=True)
    balls = table.balls_at_rest.copy()
    balls['x'] = rng.uniform(0.0, table.length, count) ** 2 / table.length
    balls['y'] = rng.uniform(0.0, table.width, count) ** 2 / table.width
    cells = new_cells(table.length, table.width, balls)
    fill(balls, cells)
    return balls, cells


def assert_all_are_near(balls, cells):
    for i in range(len(balls)):
        listed = cells.near[: neighbours(balls, cells, i)].tolist()
        assert sorted(listed) == naive.neighbours(balls, i)


def test_neighbours_are_listed_once_each():
    rng = np.random.default_rng(31)
    balls, cells = crowded(rng)
    most = max(np.unique(balls[['cell_x', 'cell_y']], return_counts=True)[1])
    assert most > 3
    assert_all_are_near(balls, cells)


def test_neighbours_after_some_went_elsewhere():
    rng = np.random.default_rng(32)
    balls, cells = crowded(rng)
    rows, columns = cells.first.shape
    for _ in range(40):
        for i in rng.permutation(len(balls))[:10]:
            leave(balls, cells, i)
            balls[i]['cell_x'], balls[i]['cell_y'] = rng.integers(columns), rng.integers(rows)
            enter(balls, cells, i)
        assert_all_are_near(balls, cells)


def test_those_near_are_sorted_out():
    rng = np.random.default_rng(33)
    balls, cells = crowded(rng)
    balls['speed'] = rng.random(len(balls)) < 0.5
    for i in range(len(balls)):
        count = neighbours(balls, cells, i)
        near = cells.near[:count].tolist()
        n_resting, n_moving = sort_out(balls, cells, count, i)
        assert cells.near[:n_resting].tolist() == [j for j in near if balls[j]['speed'] == 0]
        moving = [j for j in near if balls[j]['speed'] > 0 and j != i]
        assert cells.moving[:n_moving].tolist() == moving


def test_the_first_of_those_that_rest():
    rng = np.random.default_rng(34)
    balls, cells = crowded(rng)
    met = 0
    for i in range(len(balls)):
        angle = rng.uniform(0.0, 2.0 * np.pi)
        balls[i]['ux'], balls[i]['uy'], balls[i]['speed'] = np.cos(angle), np.sin(angle), 1.0
        ball = balls[i]
        n_resting, _ = sort_out(balls, cells, neighbours(balls, cells, i), i)
        some = cells.near[:n_resting]
        reach = rng.choice([0.02, np.inf])
        way, partner = first_of(balls, some, n_resting, ball, ball['x'], ball['y'], reach)
        expected = naive.first_in_the_way(
            balls[some], (ball['x'], ball['y']), (ball['ux'], ball['uy']), ball['radius'], reach
        )
        assert way == pytest.approx(expected[0], abs=1e-12)
        assert partner == (some[expected[1]] if expected[1] >= 0 else -1)
        balls[i]['speed'] = 0.0
        met += partner >= 0
    assert 0 < met < len(balls)
