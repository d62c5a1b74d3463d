"""On a table with few balls: which of them move, and where the others rest, side by side in memory.

Each ball then looks at all others at once. The compiler makes vector instructions of the loops
here, which go through arrays of numbers; of loops through the balls' records it cannot.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import inlined
from pool_sim_ros.physics.motion import N_ROWS, RESTS

X, Y, RADIUS, DISTANCE = 0, 1, 2, 3
"""Rows of `FewBalls.rows`."""

LANES = 8
"""There are a multiple of so many columns: what vector instructions leave over costs most."""

FAR = 1e30
"""Where a column without a ball says that it rests, m: nothing comes there."""


class FewBalls(NamedTuple):
    """The balls of a table with few of them; on a table with many there are no columns.

    It has few arrays, since each costs seven arguments wherever a kernel calls another.
    """

    # (N_ROWS, n or some more): where a ball rests, NaN while it moves; radius; room, m; then how it
    # moves.
    rows: NDArray[np.float64]
    moving: NDArray[np.int64]  # (n + 1,): the numbers of those that move, in order; their count


def new_few_balls(balls: NDArray[np.void], wanted: bool) -> FewBalls:
    """Return it for balls that all rest; without columns, only with room, unless `wanted`."""
    n = len(balls)
    rows = np.zeros((N_ROWS, -(-n // LANES) * LANES if wanted else 0))
    if wanted:
        rows[X, n:] = FAR
        rows[X, :n], rows[Y, :n], rows[RADIUS, :n] = balls['x'], balls['y'], balls['radius']
    return FewBalls(rows, np.zeros(len(balls) + 1, np.int64))


@inlined
def n_moving(few: FewBalls) -> int:
    """Return how many balls move."""
    return few.moving[len(few.moving) - 1]


@inlined
def note_motion(few: FewBalls, balls: NDArray[np.void], i: int) -> None:
    """Note whether ball `i` moves now, and where it rests if not."""
    if few.rows.shape[1] == 0:
        return
    ball, moving = balls[i], few.moving
    moved = few.rows[X, i] != few.rows[X, i]
    moves = ball.phase != RESTS
    few.rows[X, i] = np.nan if moves else ball.x
    few.rows[Y, i] = ball.y
    if moves == moved:
        return
    count = n_moving(few)
    if moves:
        k = count
        while k > 0 and moving[k - 1] > i:
            moving[k] = moving[k - 1]
            k -= 1
        moving[k] = i
        moving[len(moving) - 1] = count + 1
    else:
        k = 0
        while moving[k] != i:
            k += 1
        for m in range(k, count - 1):
            moving[m] = moving[m + 1]
        moving[len(moving) - 1] = count - 1


@inlined
def put_at_rest(few: FewBalls, i: int, x: float, y: float) -> None:
    """Note that ball `i` rests at (x, y), m, where all others rest too or will be put."""
    if few.rows.shape[1] > 0:
        few.rows[X, i] = x
        few.rows[Y, i] = y


@inlined
def touches_resting(few: FewBalls, x: float, y: float, radius: float, i: int, but: int) -> bool:
    """Return whether any resting ball, except numbers `i` and `but`, is within `radius` of (x, y).

    `radius` in m is to the surface of that ball.
    """
    found = 0
    for k in range(few.rows.shape[1]):
        dx, dy = few.rows[X, k] - x, few.rows[Y, k] - y
        near = radius + few.rows[RADIUS, k]
        found |= (dx * dx + dy * dy <= near * near) & (k != i) & (k != but)
    return found != 0
