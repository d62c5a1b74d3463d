"""Balls put where a shot begins, and whether they may lie there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import is_outside
from pool_sim_ros.physics.event_driven.cell_grid import fill, has_few, neighbours
from pool_sim_ros.physics.event_driven.few_balls import RADIUS, X, Y, put_at_rest
from pool_sim_ros.physics.event_driven.state import State
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.tolerances import OVERLAP


@inlined
def place(state: State, positions: NDArray[np.float64]) -> bool:
    """Put balls at rest to (n, 2) positions in m; return whether they may lie there."""
    balls, grid, boundary = state.balls, state.grid, state.table.boundary
    outside = 0
    for i in range(len(balls)):
        x, y = positions[i, 0], positions[i, 1]
        balls[i].x, balls[i].y = x, y
        put_at_rest(grid.few, i, x, y)
        outside |= is_outside(boundary, x, y, balls[i].radius, OVERLAP)
    if outside != 0:
        return False
    if has_few(grid):
        return not few_overlap(state)
    fill(balls, grid)
    return not many_overlap(state)


@inlined
def few_overlap(state: State) -> bool:
    """Return whether any two balls overlap by more than OVERLAP, on a table with few."""
    rows = state.grid.few.rows
    found = 0
    for i in range(1, rows.shape[1]):
        x, y, reach = rows[X, i], rows[Y, i], rows[RADIUS, i] - OVERLAP
        for k in range(i):
            dx, dy = rows[X, k] - x, rows[Y, k] - y
            least = max(rows[RADIUS, k] + reach, 0.0)
            found |= dx * dx + dy * dy < least * least
    return found != 0


@kernel
def many_overlap(state: State) -> bool:
    """Return whether any two balls overlap by more than OVERLAP, by the cells."""
    balls, grid = state.balls, state.grid
    for i in range(len(balls)):
        for m in range(neighbours(balls, grid, i)):
            k = grid.near[m]
            dx, dy = balls[k].x - balls[i].x, balls[k].y - balls[i].y
            least = max(balls[k].radius + (balls[i].radius - OVERLAP), 0.0)
            if k < i and dx * dx + dy * dy < least * least:
                return True
    return False
