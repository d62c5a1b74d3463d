"""Balls that move, side by side in memory: which of them may a path meet, or does a ball touch?

The rows are those of `event_driven.few_balls`. The compiler makes vector instructions of the loop
here: it looks at all balls in the time in which two or three are looked at one by one.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.contact_time import RelativeMotion, gap_from_below, stays_positive
from pool_sim_ros.physics.jit import Record, inlined

STILL_X, STILL_Y, RADII, MAY_MEET = 0, 1, 2, 3
"""Rows that others write: NaN in the first for a ball that moves. The last one is room."""

PATH = 4
"""The first of the rows with x, y, vx, vy, ax, ay, since and the end of the phase of a ball."""

SINCE, ENDS = 6, 7
"""The last two of them, counted from there."""

N_ROWS = PATH + ENDS + 1
"""How many rows there are."""


@inlined
def keep_in_rows(ball: Record, rows: NDArray[np.float64], i: int) -> None:
    """Write down in column `i` how a ball moves."""
    column = rows[PATH:, i]
    column[0], column[1], column[2], column[3] = ball.x, ball.y, ball.vx, ball.vy
    column[4], column[5], column[SINCE], column[ENDS] = ball.ax, ball.ay, ball.since, ball.phase_end


@inlined
def mark_those_near(
    path: Any, radius: float, now: float, lasts: float, rows: NDArray[np.float64]
) -> None:
    """Mark with 1 each moving ball that a path may touch within `lasts` s of `now`, others with 0.

    `radius`, m, is that of the ball on the path. This is the first look of `time_to_moving_ball`,
    for all at once, and leaves out only what that would leave out.
    """
    paths = rows[PATH:]
    x, y, vx, vy, ax, ay = paths[0], paths[1], paths[2], paths[3], paths[4], paths[5]
    since, ends = paths[SINCE], paths[ENDS]
    still, radii, may_meet = rows[STILL_X], rows[RADII], rows[MAY_MEET]
    for k in range(rows.shape[1]):
        elapsed = now - since[k]
        motion = RelativeMotion(
            x[k] + elapsed * (vx[k] + 0.5 * elapsed * ax[k]) - path.x,
            y[k] + elapsed * (vy[k] + 0.5 * elapsed * ay[k]) - path.y,
            vx[k] + elapsed * ax[k] - path.vx,
            vy[k] + elapsed * ay[k] - path.vy,
            ax[k] - path.ax,
            ay[k] - path.ay,
        )
        horizon = min(lasts, ends[k] - now)
        gap, closing, opening = gap_from_below(motion, radius + radii[k], horizon)
        misses = stays_positive(gap, closing, opening, horizon)
        may_meet[k] = (still[k] != still[k]) & (not misses)


def touched_in_rows(
    table: Any,
    rows: NDArray[np.float64],
    place: tuple[float, float],
    near: float,
    pair: tuple[int, int],
    now: float,
) -> tuple[bool, bool]:
    """Return that the rows tell, and whether any ball but `pair`, moving or at rest, touches."""
    paths = rows[PATH:]
    x, y, vx, vy, ax, ay = paths[0], paths[1], paths[2], paths[3], paths[4], paths[5]
    since = paths[SINCE]
    still_x, still_y, radii = rows[STILL_X], rows[STILL_Y], rows[RADII]
    found = 0
    for k in range(rows.shape[1]):
        elapsed = now - since[k]
        moves = still_x[k] != still_x[k]
        at_x = x[k] + elapsed * (vx[k] + 0.5 * elapsed * ax[k])
        at_y = y[k] + elapsed * (vy[k] + 0.5 * elapsed * ay[k])
        dx = (at_x if moves else still_x[k]) - place[0]
        dy = (at_y if moves else still_y[k]) - place[1]
        touch = near + radii[k]
        found |= (dx * dx + dy * dy <= touch * touch) & (k != pair[0]) & (k != pair[1])
    return True, found != 0
