"""A capsule that holds a curved path: what is beside it cannot be touched on the way.

A path here has a start (x, y) in m, a velocity (vx, vy) in m/s and a constant acceleration
(ax, ay) in m/s^2.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pool_sim_ros.physics.jit import inlined


class Capsule(NamedTuple):
    """All that is within `sag` m of the chord of a path: the path is inside."""

    ux: float  # unit vector along the chord
    uy: float
    length: float  # m
    sag: float


@inlined
def capsule_of(path: Any, lasts: float) -> Capsule:
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
def room_beside(capsule: Capsule, dx: float, dy: float, reach: float) -> float:
    """Return the room between a capsule and a circle, as a difference of squares, m^2.

    (dx, dy), m, is from the start of the path to the centre, and `reach` is how near the path
    may come. Where the room is positive, the path comes less near.
    """
    along = dx * capsule.ux + dy * capsule.uy
    nearby = min(max(along, 0.0), capsule.length)
    across, beyond = dx * capsule.uy - dy * capsule.ux, along - nearby
    wide = reach + capsule.sag
    return across * across + beyond * beyond - wide * wide
