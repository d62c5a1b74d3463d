"""Which balls are near: the table is divided into cells, none narrower than a ball.

Two balls can touch only where their cells are the same or neighbours, corners included. A table
with few balls is one cell: looking at all of them is faster than keeping track.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_driven.few_balls import FewBalls, n_moving, new_few_balls
from pool_sim_ros.physics.jit import Record, inlined, kernel
from pool_sim_ros.physics.tolerances import CELL_MARGIN

FEW = 40
"""Balls up to which the table is one cell; cells pay from about here."""

CELLS_PER_BALL = 3.0
"""Cells per ball, where the balls are small enough."""

USUAL = 2
"""Balls of a cell that are listed without a branch: hardly ever is there another."""


class CellGrid(NamedTuple):
    """The cells, and who is in which; n, the number of balls, stands for nobody."""

    first: NDArray[np.int32]  # (rows, columns): the first ball of each cell
    following: NDArray[np.int32]  # by ball: the next one in its cell; nobody follows nobody
    near: NDArray[np.int64]  # (n + 1,): those that are near; all where there are few
    few: FewBalls  # kept where the table has few balls; its `moving` is room where it has many
    width: float  # of a cell, m
    height: float  # m
    widest: float  # diameter of the widest ball, m


def new_grid(length: float, width: float, balls: NDArray[np.void]) -> CellGrid:
    """Return an empty grid for a table of `length` x `width` m."""
    columns = rows = 1
    n = len(balls)
    widest = 2.0 * float(balls['radius'].max())
    if n > FEW:
        side = max(widest * (1.0 + CELL_MARGIN), np.sqrt(length * width / (n * CELLS_PER_BALL)))
        columns, rows = max(int(length / side), 1), max(int(width / side), 1)
    first = np.full((rows, columns), n, np.int32)
    following = np.full(n + 1, n, np.int32)
    near = np.arange(n + 1)
    few = new_few_balls(balls, wanted=first.size == 1)
    return CellGrid(first, following, near, few, length / columns, width / rows, widest)


@kernel
def fill(balls: NDArray[np.void], grid: CellGrid) -> None:
    """Put every ball into the cell in which it lies; the grid may hold others before."""
    rows, columns = grid.first.shape
    for row in range(rows):
        for column in range(columns):
            grid.first[row, column] = len(balls)
    for i in range(len(balls)):
        ball = balls[i]
        # Where a ball in a pocket is, which is far away, no integer can tell.
        ball.cell_x = int(min(max(ball.x / grid.width, 0.0), columns - 1.0))
        ball.cell_y = int(min(max(ball.y / grid.height, 0.0), rows - 1.0))
        enter(balls, grid, i)


@inlined
def enter(balls: NDArray[np.void], grid: CellGrid, i: int) -> None:
    """Make ball `i` the first of the cell whose numbers it has."""
    ball = balls[i]
    first = grid.first[ball.cell_y, ball.cell_x]
    grid.following[i] = first
    ball.previous = -1
    if first < len(balls):
        balls[first].previous = i
    grid.first[ball.cell_y, ball.cell_x] = i


@inlined
def leave(balls: NDArray[np.void], grid: CellGrid, i: int) -> None:
    """Take ball `i` out of its cell."""
    ball = balls[i]
    following = grid.following[i]
    if ball.previous >= 0:
        grid.following[ball.previous] = following
    else:
        grid.first[ball.cell_y, ball.cell_x] = following
    if following < len(balls):
        balls[following].previous = ball.previous


@inlined
def has_few(grid: CellGrid) -> bool:
    """Return whether the table is one cell, whose `few` is kept."""
    return grid.few.rows.shape[1] > 0


@inlined
def neighbours(balls: NDArray[np.void], grid: CellGrid, i: int) -> int:
    """Write the balls that ball `i` may touch, and itself, into `near`; return their number."""
    if has_few(grid):
        return len(balls)
    x, y = balls[i].cell_x, balls[i].cell_y
    return list_cells(balls, grid, x - 1, x + 1, y - 1, y + 1)


@inlined
def all_moving(balls: NDArray[np.void], grid: CellGrid, i: int) -> tuple[NDArray[np.int64], int]:
    """Return an array, and how many of it to look at for all that move and ball `i` may touch."""
    if has_few(grid):
        return grid.few.moving, n_moving(grid.few)
    return grid.near, neighbours(balls, grid, i)


@inlined
def list_cells(balls: NDArray[np.void], grid: CellGrid, x0: int, x1: int, y0: int, y1: int) -> int:
    """Write the balls of cells (x0, y0) to (x1, y1) into `near`; return how many they are."""
    rows, columns = grid.first.shape
    n = len(balls)
    count = 0
    for y in range(max(y0, 0), min(y1, rows - 1) + 1):
        for x in range(max(x0, 0), min(x1, columns - 1) + 1):
            k = grid.first[y, x]
            for _ in range(USUAL):
                grid.near[count] = k
                count += k < n
                k = grid.following[k]
            while k < n:
                grid.near[count] = k
                count += 1
                k = grid.following[k]
    return count


@inlined
def cell_edges(grid: CellGrid, ball: Record) -> tuple[float, float, float, float]:
    """Return where a ball leaves its cell: x low and high, y low and high, m.

    The sides of the table are no way out: infinite.
    """
    rows, columns = grid.first.shape
    x_low = ball.cell_x * grid.width if ball.cell_x > 0 else -np.inf
    x_high = (ball.cell_x + 1) * grid.width if ball.cell_x < columns - 1 else np.inf
    y_low = ball.cell_y * grid.height if ball.cell_y > 0 else -np.inf
    y_high = (ball.cell_y + 1) * grid.height if ball.cell_y < rows - 1 else np.inf
    return x_low, x_high, y_low, y_high


@inlined
def move_on(balls: NDArray[np.void], grid: CellGrid, i: int, step_x: int, step_y: int) -> int:
    """Move ball `i` by one cell in x or in y.

    Writes the balls that it may touch there, and could not before, into `near`; returns how many
    they are.
    """
    ball = balls[i]
    leave(balls, grid, i)
    ball.cell_x += step_x
    ball.cell_y += step_y
    enter(balls, grid, i)
    x, y = ball.cell_x + step_x, ball.cell_y + step_y
    beside_x, beside_y = (0, 1) if step_x != 0 else (1, 0)
    return list_cells(balls, grid, x - beside_x, x + beside_x, y - beside_y, y + beside_y)
