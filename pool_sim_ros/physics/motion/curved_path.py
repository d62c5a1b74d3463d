"""A path along which a ball has a constant acceleration, and the resting balls on it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.capsule import capsule_of, room_beside
from pool_sim_ros.physics.contact_time import RelativeMotion, first_root, time_to_moving_ball
from pool_sim_ros.physics.jit import Record, inlined
from pool_sim_ros.physics.motion.straight_path import StraightPath


class CurvedPath(NamedTuple):
    """From (x, y) in m at (vx, vy) in m/s with (ax, ay) in m/s^2 for `lasts` s.

    Where the ball `rolls` the path is straight.
    """

    x: float
    y: float
    vx: float
    vy: float
    ax: float
    ay: float
    lasts: float
    rolls: bool


@inlined
def time_over(gap: float, closing: float, pressing: float) -> float:
    """Return the seconds until an edge that is `gap` m away is crossed; inf for never."""
    return first_root(max(gap, 0.0), closing, -pressing) if gap < np.inf else np.inf


@inlined
def straight(path: CurvedPath) -> StraightPath:
    """Return the path of a ball that rolls."""
    speed = np.sqrt(path.vx * path.vx + path.vy * path.vy)
    inverse = 1.0 / speed if speed > 0.0 else 0.0
    return StraightPath(path.x, path.y, path.vx * inverse, path.vy * inverse, speed)


@inlined
def time_to_place(path: CurvedPath, dx: float, dy: float, touch: float, before: float) -> float:
    """Return the seconds until the path is `touch` m from (dx, dy), which is relative to its start.

    inf where that is not `before`, s.
    """
    motion = RelativeMotion(dx, dy, -path.vx, -path.vy, -path.ax, -path.ay)
    return time_to_moving_ball(motion, touch, min(before, path.lasts))


@inlined
def first_in_rows(
    path: CurvedPath, radius: float, lasts: float, rows: NDArray[np.float64]
) -> tuple[float, int]:
    """Return the seconds to the first resting ball, and which; `lasts` and -1 for none before.

    `rows` is as `FewBalls.rows`; its last one is room for the squared distance from the capsule.
    """
    x, y, radii, room = rows[0], rows[1], rows[2], rows[3]
    lasts = min(lasts, path.lasts)
    capsule = capsule_of(path, lasts)
    nearest = 0
    for k in range(len(x)):
        room[k] = room_beside(capsule, x[k] - path.x, y[k] - path.y, radius + radii[k])
        nearest += room[k] <= 0.0
    ball = -1
    if nearest > 0:
        for k in range(len(x)):
            if room[k] <= 0.0:
                t = time_to_place(path, x[k] - path.x, y[k] - path.y, radius + radii[k], lasts)
                if t < lasts:
                    lasts, ball = t, k
    return lasts, ball


@inlined
def first_of_listed(
    path: CurvedPath,
    radius: float,
    lasts: float,
    balls: NDArray[np.void],
    listed: NDArray[np.int64],
    count: int,
) -> tuple[float, int]:
    """Return as `first_in_rows`, for the first `count` numbers of balls in `listed`."""
    ball = -1
    for m in range(count):
        other: Record = balls[listed[m]]
        touch = radius + other.radius
        t = time_to_place(path, other.x - path.x, other.y - path.y, touch, lasts)
        if t < lasts:
            lasts, ball = t, listed[m]
    return lasts, ball
