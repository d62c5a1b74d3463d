"""A path along which a ball has a constant acceleration, and the resting balls on it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.contact_time import RelativeMotion, time_to_moving_ball
from pool_sim_ros.physics.jit import Record, inlined


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
def time_to_place(path: CurvedPath, dx: float, dy: float, touch: float, before: float) -> float:
    """Return the seconds until the path is `touch` m from (dx, dy), which is relative to its start.

    inf where that is not `before`, s.
    """
    motion = RelativeMotion(dx, dy, -path.vx, -path.vy, -path.ax, -path.ay)
    return time_to_moving_ball(motion, touch, min(before, path.lasts))


class Capsule(NamedTuple):
    """All that is within `sag` m of the chord of a path: the path is inside."""

    ux: float  # unit vector along the chord
    uy: float
    length: float  # m
    sag: float


@inlined
def capsule_of(path: CurvedPath, lasts: float) -> Capsule:
    """Return a capsule that holds the first `lasts` s of a path.

    From a point that runs along the chord evenly the path is off by ``a t (T - t) / 2``, which is
    at most ``a T^2 / 8``. Only the part across the chord matters, unless the path turns back.
    """
    dx = lasts * (path.vx + 0.5 * lasts * path.ax)
    dy = lasts * (path.vy + 0.5 * lasts * path.ay)
    length = np.sqrt(dx * dx + dy * dy)
    if length > 0.0:
        ux, uy = dx / length, dy / length
    else:
        ux, uy = 1.0, 0.0
    end_vx, end_vy = path.vx + lasts * path.ax, path.vy + lasts * path.ay
    squared = (path.ax * uy - path.ay * ux) ** 2
    if (path.vx * ux + path.vy * uy < 0.0) | (end_vx * ux + end_vy * uy < 0.0):
        # It turns back, and so leaves its chord beyond an end.
        squared = path.ax * path.ax + path.ay * path.ay
    half = 0.5 * lasts
    sag = 0.5 * half * half * np.sqrt(squared)
    return Capsule(ux, uy, length, sag)


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
        dx, dy = x[k] - path.x, y[k] - path.y
        along = dx * capsule.ux + dy * capsule.uy
        nearby = min(max(along, 0.0), capsule.length)
        across, beyond = dx * capsule.uy - dy * capsule.ux, along - nearby
        reach = radius + radii[k] + capsule.sag
        room[k] = across * across + beyond * beyond - reach * reach
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
