"""When a ball first touches what bounds a table with pockets.

Most of such a table is its inner rectangle, in which a ball touches the rails alone. What it can
touch once it has left that is mostly around the nearest pocket.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary.mouths import faces, height_above
from pool_sim_ros.physics.boundary.rectangle import time_to_rectangle
from pool_sim_ros.physics.boundary.seam import FIRST_CUSHION, PHASE_END
from pool_sim_ros.physics.boundary.surroundings import AROUND, WITHIN
from pool_sim_ros.physics.capsule import Capsule, capsule_of, room_beside
from pool_sim_ros.physics.contact_time import RelativeMotion, time_to_line, time_to_moving_ball
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.tolerances import TOUCHING


@inlined
def rail_at(boundary: Any, partner: int, x: float, y: float) -> int:
    """Return the partner that is the rail before (x, y) on a rectangle's side; PHASE_END: none."""
    rails = boundary.rows[boundary.n_parts + FIRST_CUSHION - partner]
    for m in range(len(rails)):
        k = int(rails[m])
        if k < 0:
            break
        if faces(boundary.rows[k], x, y):
            return FIRST_CUSHION - k
    return PHASE_END


@inlined
def is_inner(boundary: Any, x: float, y: float, radius: float) -> bool:
    """Return whether a ball at (x, y) is in the inner rectangle, where it may touch the rails."""
    least = radius - TOUCHING
    return (
        boundary.inner <= radius
        and least <= x <= boundary.length - least
        and least <= y <= boundary.width - least
    )


def time_to_cushions(boundary: Any, path: Any, radius: float) -> tuple[float, int]:
    leaves = 0.0
    if is_inner(boundary, path.x, path.y, radius):
        leaves, partner = time_to_rectangle(boundary, path, radius)
        if partner == PHASE_END:
            return leaves, partner
        x, y = place_on(path, leaves)
        rail = rail_at(boundary, partner, x, y)
        if rail != PHASE_END:
            return leaves, rail
    return time_outside(boundary, path, radius, leaves)


@inlined
def place_on(path: Any, t: float) -> tuple[float, float]:
    """Return where a path is after `t` s, m."""
    return path.x + t * (path.vx + 0.5 * t * path.ax), path.y + t * (path.vy + 0.5 * t * path.ay)


@kernel
def time_outside(boundary: Any, path: Any, radius: float, leaves: float) -> tuple[float, int]:
    """Return as `time_to_cushions`, for a path that is beyond the inner rectangle from `leaves` s.

    Most end in the mouth of the nearest pocket. What is not around it cannot be touched before the
    path is farther from it.
    """
    if boundary.n_parts > boundary.n_cushions:
        x, y = place_on(path, leaves)
        pocket, distance = nearest_pocket(boundary, x, y)
        best, partner = first_around(boundary, path, radius, pocket)
        way = max(best - leaves, 0.0) * max(speed_on(path, leaves), speed_on(path, best))
        if distance + way <= pocket[WITHIN]:
            return (best if partner != PHASE_END else np.inf), partner
    return time_to_anything(boundary, path, radius)


@inlined
def speed_on(path: Any, t: float) -> float:
    """Return the speed on a path after `t` s, m/s; between two times it is no higher than there."""
    vx, vy = path.vx + t * path.ax, path.vy + t * path.ay
    return np.sqrt(vx * vx + vy * vy)


@inlined
def nearest_pocket(boundary: Any, x: float, y: float) -> tuple[NDArray[np.float64], float]:
    """Return the pocket whose centre is nearest to (x, y), and how far away that is, m."""
    nearest, squared = boundary.n_cushions, np.inf
    for k in range(boundary.n_cushions, boundary.n_parts):
        dx, dy = x - boundary.rows[k, 0], y - boundary.rows[k, 1]
        if dx * dx + dy * dy < squared:
            nearest, squared = k, dx * dx + dy * dy
    return boundary.rows[nearest], np.sqrt(squared)


@inlined
def first_around(
    boundary: Any, path: Any, radius: float, pocket: NDArray[np.float64]
) -> tuple[float, int]:
    """Return the seconds to the first of what is around a pocket, or to the end, and which."""
    best, partner = path.lasts, PHASE_END
    numbers = pocket[AROUND:]
    # They rise: the segments come before what is round.
    straight = 0
    for m in range(len(numbers)):
        k = int(numbers[m])
        if not 0 <= k < boundary.n_segments:
            break
        straight += 1
        t = time_to_segment(boundary.rows[k], path, radius, best)
        if t < best:
            best, partner = t, FIRST_CUSHION - k
    capsule = capsule_of(path, best)
    for m in range(straight, len(numbers)):
        k = int(numbers[m])
        if k < 0:
            break
        t = time_to_round(boundary, k, path, capsule, radius, best)
        if t < best:
            best, partner = t, FIRST_CUSHION - k
    return best, partner


@kernel
def time_to_anything(boundary: Any, path: Any, radius: float) -> tuple[float, int]:
    """Return as `time_to_cushions`, from a look at every cushion and pocket."""
    best, partner = path.lasts, PHASE_END
    for k in range(boundary.n_segments):
        t = time_to_segment(boundary.rows[k], path, radius, best)
        if t < best:
            best, partner = t, FIRST_CUSHION - k
    capsule = capsule_of(path, best)
    for k in range(boundary.n_segments, boundary.n_parts):
        t = time_to_round(boundary, k, path, capsule, radius, best)
        if t < best:
            best, partner = t, FIRST_CUSHION - k
    return (best if partner != PHASE_END else np.inf), partner


@inlined
def time_to_round(
    boundary: Any, k: int, path: Any, capsule: Capsule, radius: float, before: float
) -> float:
    """Return the seconds until a ball touches nose or pocket `k`; inf if not `before`."""
    reach = radius if k < boundary.n_cushions else 0.0
    return time_to_circle(path, capsule, boundary.rows[k], reach, before)


@inlined
def time_to_segment(segment: NDArray[np.float64], path: Any, radius: float, before: float) -> float:
    """Return the seconds until a ball of `radius` touches a segment; inf if not `before`."""
    nx, ny = segment[4], segment[5]
    gap = height_above(segment, path.x, path.y) - radius
    closing, pressing = -(path.vx * nx + path.vy * ny), -(path.ax * nx + path.ay * ny)
    t = time_to_line(gap, closing, pressing, before)
    if t < before:
        x, y = place_on(path, t)
        if faces(segment, x, y):
            return t
    return np.inf


@inlined
def time_to_circle(
    path: Any, capsule: Capsule, circle: NDArray[np.float64], radius: float, before: float
) -> float:
    """Return the seconds until a ball of `radius` touches a circle; inf if not `before`.

    The capsule holds the path until then.
    """
    dx, dy = circle[0] - path.x, circle[1] - path.y
    reach = circle[2] + radius
    if room_beside(capsule, dx, dy, reach) > 0.0:
        return np.inf
    motion = RelativeMotion(dx, dy, -path.vx, -path.vy, -path.ax, -path.ay)
    return time_to_moving_ball(motion, reach, before)
