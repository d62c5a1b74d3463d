"""Which balls are near: the table is divided into cells, none narrower than a ball.

Two balls can touch only where their cells are the same or neighbours, corners included. A table
with few balls is one cell: looking at all of them is faster than keeping track.
"""

from typing import NamedTuple

import numpy as np

from pool_sim_ros.physics.event_driven.few_balls import Resting, new_resting
from pool_sim_ros.physics.jit import inlined, kernel

FEW = 40
"""Balls up to which the table is one cell; cells pay from about here."""

SPARE = 1e-6
"""What a cell is wider than the widest ball, as a part of it: far above rounding."""

CELLS_PER_BALL = 3.0
"""Cells per ball, where the balls are small enough."""

USUAL = 2
"""Balls of a cell that are listed without a branch: hardly ever is there another."""


class Cells(NamedTuple):
    """The grid, and who is in which cell; n, the number of balls, stands for nobody."""

    first: np.ndarray  # (rows, columns): the first ball of each cell
    after: np.ndarray  # by ball: the next one in its cell; after nobody comes nobody
    near: np.ndarray  # room for the numbers of all balls; holds them where the table has few
    moving: np.ndarray  # the same for those that move
    resting: Resting  # kept where the table has few balls
    width: float  # m
    height: float  # m


def new_cells(length: float, width: float, balls: np.ndarray) -> Cells:
    """Return an empty grid for a table of `length` x `width` m."""
    columns = rows = 1
    n = len(balls)
    if n > FEW:
        widest = 2.0 * balls['radius'].max() * (1.0 + SPARE)
        side = max(widest, np.sqrt(length * width / (n * CELLS_PER_BALL)))
        columns, rows = max(int(length / side), 1), max(int(width / side), 1)
    first = np.full((rows, columns), n, np.int32)
    after = np.full(n + 1, n, np.int32)
    near = np.arange(n + 1)
    resting = new_resting(balls if first.size == 1 else balls[:0])
    return Cells(first, after, near, np.empty_like(near), resting, length / columns, width / rows)


@kernel
def fill(balls, cells):
    """Put every ball into the cell in which it lies."""
    rows, columns = cells.first.shape
    for i in range(len(balls)):
        ball = balls[i]
        ball.cell_x = min(max(int(ball.x / cells.width), 0), columns - 1)
        ball.cell_y = min(max(int(ball.y / cells.height), 0), rows - 1)
        enter(balls, cells, i)


@inlined
def enter(balls, cells, i):
    """Make ball `i` the first of the cell whose numbers it has."""
    ball = balls[i]
    first = cells.first[ball.cell_y, ball.cell_x]
    cells.after[i] = first
    ball.before = -1
    if first < len(balls):
        balls[first].before = i
    cells.first[ball.cell_y, ball.cell_x] = i


@inlined
def leave(balls, cells, i):
    """Take ball `i` out of its cell."""
    ball = balls[i]
    after = cells.after[i]
    if ball.before >= 0:
        cells.after[ball.before] = after
    else:
        cells.first[ball.cell_y, ball.cell_x] = after
    if after < len(balls):
        balls[after].before = ball.before


@inlined
def neighbours(balls, cells, i):
    """Write the balls that ball `i` may touch, and itself, into `near`; return their number."""
    if has_few(cells):
        return len(balls)
    x, y = balls[i].cell_x, balls[i].cell_y
    return list_cells(balls, cells, x - 1, x + 1, y - 1, y + 1)


@inlined
def has_few(cells):
    """Return whether the table is one cell, whose `resting` is kept."""
    return len(cells.resting.x) > 0


@inlined
def all_moving(balls, cells, i):
    """Return an array, and how many of it to look at for all that move and ball `i` may touch."""
    if has_few(cells):
        return cells.resting.moving, cells.resting.count[0]
    return cells.near, neighbours(balls, cells, i)


@inlined
def list_cells(balls, cells, x0, x1, y0, y1):
    """Write the balls of cells (x0, y0) to (x1, y1) into `near`; return how many they are."""
    rows, columns = cells.first.shape
    n = len(balls)
    count = 0
    for y in range(max(y0, 0), min(y1, rows - 1) + 1):
        for x in range(max(x0, 0), min(x1, columns - 1) + 1):
            k = cells.first[y, x]
            for _ in range(USUAL):
                cells.near[count] = k
                count += k < n
                k = cells.after[k]
            while k < n:
                cells.near[count] = k
                count += 1
                k = cells.after[k]
    return count


@inlined
def ways_out(cells, ball, x, y):
    """Return the ways in m to where a moving ball, now at (x, y), leaves its cell in x and in y.

    The sides of the table are no ways out: inf.
    """
    rows, columns = cells.first.shape
    to_x = to_y = np.inf
    if ball.ux > 0.0 and ball.cell_x < columns - 1:
        to_x = ((ball.cell_x + 1) * cells.width - x) / ball.ux
    elif ball.ux < 0.0 and ball.cell_x > 0:
        to_x = (ball.cell_x * cells.width - x) / ball.ux
    if ball.uy > 0.0 and ball.cell_y < rows - 1:
        to_y = ((ball.cell_y + 1) * cells.height - y) / ball.uy
    elif ball.uy < 0.0 and ball.cell_y > 0:
        to_y = (ball.cell_y * cells.height - y) / ball.uy
    return to_x, to_y


@inlined
def move_on(balls, cells, i, x, y):
    """Move ball `i`, at (x, y) on the edge of its cell, into the next cell.

    Writes the balls that it may touch there, and could not before, into `near`; returns how many
    they are.
    """
    ball = balls[i]
    to_x, to_y = ways_out(cells, ball, x, y)
    leave(balls, cells, i)
    if to_x <= to_y:
        step = 1 if ball.ux > 0.0 else -1
        ball.cell_x += step
        x0 = x1 = ball.cell_x + step
        y0, y1 = ball.cell_y - 1, ball.cell_y + 1
    else:
        step = 1 if ball.uy > 0.0 else -1
        ball.cell_y += step
        x0, x1 = ball.cell_x - 1, ball.cell_x + 1
        y0 = y1 = ball.cell_y + step
    enter(balls, cells, i)
    return list_cells(balls, cells, x0, x1, y0, y1)
