"""On a table with few balls: which of them move, and where the others rest, side by side in memory.

Each ball then looks at all others at once. The compiler makes vector instructions of the loops
here, which go through arrays of numbers; of loops through the balls' records it cannot.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from pool_sim_ros.physics.jit import inlined


class Resting(NamedTuple):
    """Of every ball, (n,) each; all are empty on a table with many balls."""

    x: np.ndarray  # where it rests, m; NaN while it moves
    y: np.ndarray
    radius: np.ndarray  # m
    way: np.ndarray  # room for the way to each, m
    moving: np.ndarray  # the numbers of those that move, in order
    count: np.ndarray  # (1,): how many those are


def new_resting(balls: np.ndarray) -> Resting:
    """Return it for balls that all rest."""
    n = len(balls)
    return Resting(
        balls['x'].copy(),
        balls['y'].copy(),
        balls['radius'].copy(),
        np.empty(n),
        np.empty(n, np.int64),
        np.zeros(1, np.int64),
    )


@inlined
def note_motion(resting, balls, i):
    """Note whether ball `i` moves now, and where it rests if not."""
    if len(resting.x) == 0:
        return
    ball = balls[i]
    moved = resting.x[i] != resting.x[i]
    moves = ball.speed > 0.0
    resting.x[i] = np.nan if moves else ball.x
    resting.y[i] = ball.y
    if moves == moved:
        return
    count = resting.count[0]
    if moves:
        k = count
        while k > 0 and resting.moving[k - 1] > i:
            resting.moving[k] = resting.moving[k - 1]
            k -= 1
        resting.moving[k] = i
        resting.count[0] = count + 1
    else:
        k = 0
        while resting.moving[k] != i:
            k += 1
        for m in range(k, count - 1):
            resting.moving[m] = resting.moving[m + 1]
        resting.count[0] = count - 1


@inlined
def first_in_the_way(resting, x, y, ux, uy, radius, reach):
    """Return the way in m to the first resting ball, and which that is.

    That of a ball at (x, y) on its way along (ux, uy): `contact_time.way_to_resting_ball`, for all
    at once. It is `reach`, and -1, where there is none before.
    """
    n = len(resting.x)
    for k in range(n):
        dx, dy = resting.x[k] - x, resting.y[k] - y
        touch = radius + resting.radius[k]
        along = dx * ux + dy * uy
        aside = dx * uy - dy * ux
        half_chord_squared = touch * touch - aside * aside
        way = max(along - np.sqrt(max(half_chord_squared, 0.0)), 0.0)
        meets = (along > 0.0) & (half_chord_squared > 0.0)
        resting.way[k] = way if meets else np.inf
    way, partner = reach, -1
    for k in range(n):
        if resting.way[k] < way:
            way, partner = resting.way[k], k
    return way, partner


@inlined
def touches_resting(resting, x, y, radius, i, but):
    """Return whether any resting ball, except numbers `i` and `but`, is within `radius` of (x, y).

    `radius` in m is to the surface of that ball.
    """
    found = 0
    for k in range(len(resting.x)):
        dx, dy = resting.x[k] - x, resting.y[k] - y
        near = radius + resting.radius[k]
        found |= (dx * dx + dy * dy <= near * near) & (k != i) & (k != but)
    return found != 0
