"""Balls put where a shot begins, and whether they may lie there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import is_outside
from pool_sim_ros.physics.event_driven.cell_grid import fill, has_few, neighbours
from pool_sim_ros.physics.event_driven.few_balls import RADIUS, X, Y, put_at_rest
from pool_sim_ros.physics.event_driven.state import Start, State
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.motion import in_play, lie_at
from pool_sim_ros.physics.tolerances import OVERLAP


@inlined
def place(state: State, start: Start, positions: NDArray[np.float64]) -> bool:
    """Put balls at rest to (n, 2) positions in m; return whether they may lie there."""
    balls, grid = state.balls, state.grid
    near = 0
    for i in range(len(balls)):
        x, y = positions[i, 0], positions[i, 1]
        lie_at(balls[i], state.table, x, y)
        put_at_rest(grid.few, i, balls[i].x, balls[i].y)
        dx, dy = x - start.balls[i].x, y - start.balls[i].y
        near += dx * dx + dy * dy <= start.clearance_squared
    if has_few(grid):
        # Most layouts of a planner are the table's own but for some noise.
        return near == len(balls) or not (any_outside(state) or few_overlap(state))
    if any_outside(state):
        return False
    fill(balls, grid)
    return not many_overlap(state)


@kernel
def any_outside(state: State) -> bool:
    """Return whether any ball is beyond a cushion by more than OVERLAP, or nowhere."""
    balls, boundary = state.balls, state.table.boundary
    for i in range(len(balls)):
        if in_play(balls[i], state.table) and is_outside(
            boundary, balls[i].x, balls[i].y, balls[i].radius, OVERLAP
        ):
            return True
    return False


@kernel
def few_overlap(state: State) -> bool:
    """Return whether any two balls overlap by more than OVERLAP, on a table with few."""
    rows, widest = state.grid.few.rows[:, : len(state.balls)], state.grid.widest
    # As if all were as wide as the widest: fewer numbers, and hardly ever are two so near.
    return any_nearer(rows, widest * widest) and any_overlap(rows)


@inlined
def any_nearer(rows: NDArray[np.float64], squared: float) -> bool:
    """Return whether any two balls are nearer to each other than the root of `squared`, m^2.

    Two balls at a time are compared with all before them: each number is then loaded half as
    often. Without branches, the compiler makes vector instructions of it.
    """
    n = rows.shape[1]
    found = 0
    i = 1
    while i + 1 < n:
        x, y, next_x, next_y = rows[X, i], rows[Y, i], rows[X, i + 1], rows[Y, i + 1]
        for k in range(i):
            dx, dy = rows[X, k] - x, rows[Y, k] - y
            next_dx, next_dy = rows[X, k] - next_x, rows[Y, k] - next_y
            found |= dx * dx + dy * dy < squared
            found |= next_dx * next_dx + next_dy * next_dy < squared
        dx, dy = next_x - x, next_y - y
        found |= dx * dx + dy * dy < squared
        i += 2
    if i < n:
        for k in range(i):
            dx, dy = rows[X, k] - rows[X, i], rows[Y, k] - rows[Y, i]
            found |= dx * dx + dy * dy < squared
    return found != 0


@kernel
def any_overlap(rows: NDArray[np.float64]) -> bool:
    """Return whether any two balls overlap by more than OVERLAP, pair by pair."""
    for i in range(1, rows.shape[1]):
        for k in range(i):
            dx, dy = rows[X, k] - rows[X, i], rows[Y, k] - rows[Y, i]
            least = max(rows[RADIUS, i] + rows[RADIUS, k] - OVERLAP, 0.0)
            if dx * dx + dy * dy < least * least:
                return True
    return False


@kernel
def many_overlap(state: State) -> bool:
    """Return whether any two balls overlap by more than OVERLAP, by the cells."""
    balls, grid = state.balls, state.grid
    for i in range(len(balls)):
        for m in range(neighbours(balls, grid, i)):
            k = grid.near[m]
            dx, dy = balls[k].x - balls[i].x, balls[k].y - balls[i].y
            least = max(balls[i].radius + balls[k].radius - OVERLAP, 0.0)
            if k < i and dx * dx + dy * dy < least * least:
                return True
    return False
