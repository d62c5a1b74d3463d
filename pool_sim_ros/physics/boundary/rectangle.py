"""The report's boundary: four cushions parallel to the axes.

They need a comparison where other cushions need a dot product. Number 0 is x = 0, 1: x = length,
2: y = 0, 3: y = width. The functions are the implementations of those in `seam`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pool_sim_ros.physics.boundary.seam import FIRST_CUSHION, PHASE_END
from pool_sim_ros.physics.contact_time import time_to_line
from pool_sim_ros.physics.jit import inlined


class Rectangle(NamedTuple):
    """Four cushions parallel to the axes, from (0, 0) to (length, width), m."""

    length: float
    width: float


def n_cushions(boundary: Rectangle) -> int:
    return 4


def cushion_gap(boundary: Rectangle, cushion: int, x: float, y: float, radius: float) -> float:
    if cushion == 0:
        return x - radius
    if cushion == 1:
        return boundary.length - radius - x
    if cushion == 2:
        return y - radius
    return boundary.width - radius - y


def cushion_normal(boundary: Rectangle, cushion: int, x: float, y: float) -> tuple[float, float]:
    if cushion == 0:
        return -1.0, 0.0
    if cushion == 1:
        return 1.0, 0.0
    if cushion == 2:
        return 0.0, -1.0
    return 0.0, 1.0


def distance_to_cushions(
    boundary: Rectangle, x: float, y: float, ux: float, uy: float, radius: float
) -> tuple[float, int]:
    distance, partner = np.inf, PHASE_END
    if ux > 0.0:
        distance, partner = (boundary.length - radius - x) / ux, FIRST_CUSHION - 1
    elif ux < 0.0:
        distance, partner = (radius - x) / ux, FIRST_CUSHION
    if uy > 0.0:
        to_y = (boundary.width - radius - y) / uy
        if to_y < distance:
            distance, partner = to_y, FIRST_CUSHION - 3
    elif uy < 0.0:
        to_y = (radius - y) / uy
        if to_y < distance:
            distance, partner = to_y, FIRST_CUSHION - 2
    return max(distance, 0.0), partner


def to_cushion_axes(
    boundary: Rectangle, cushion: int, normal: tuple[float, float], v: tuple[float, float]
) -> tuple[float, float]:
    # Both ways: the parts change places, or not.
    return (v[0], v[1]) if cushion < 2 else (v[1], v[0])


def touches_cushion(boundary: Rectangle, x: float, y: float, reach: float, but: int) -> bool:
    return (
        (x <= reach and but != 0)
        or (boundary.length - x <= reach and but != 1)
        or (y <= reach and but != 2)
        or (boundary.width - y <= reach and but != 3)
    )


def is_outside(boundary: Rectangle, x: float, y: float, radius: float, tolerance: float) -> bool:
    least = radius - tolerance
    inside_x = (least <= x) & (x <= boundary.length - radius + tolerance)
    inside_y = (least <= y) & (y <= boundary.width - radius + tolerance)
    return not (inside_x & inside_y)


from_cushion_axes = to_cushion_axes


@inlined
def time_to_rectangle(boundary: Any, path: Any, radius: float) -> tuple[float, int]:
    """Return the seconds until a curved path touches one of the four sides, and its partner."""
    lasts = path.lasts
    seconds, partner = np.inf, PHASE_END
    t = time_to_line(path.x - radius, -path.vx, -path.ax, lasts)
    if t < seconds:
        seconds, partner = t, FIRST_CUSHION
    t = time_to_line(boundary.length - radius - path.x, path.vx, path.ax, lasts)
    if t < seconds:
        seconds, partner = t, FIRST_CUSHION - 1
    t = time_to_line(path.y - radius, -path.vy, -path.ay, lasts)
    if t < seconds:
        seconds, partner = t, FIRST_CUSHION - 2
    t = time_to_line(boundary.width - radius - path.y, path.vy, path.ay, lasts)
    if t < seconds:
        seconds, partner = t, FIRST_CUSHION - 3
    return seconds, partner


def time_to_cushions(boundary: Rectangle, path: Any, radius: float) -> tuple[float, int]:
    return time_to_rectangle(boundary, path, radius)


def nose_radius(boundary: Rectangle, cushion: int) -> float:
    return 0.0


def put_on_cushion(
    boundary: Rectangle, cushion: int, x: float, y: float, radius: float
) -> tuple[float, float]:
    if cushion == 0:
        return radius, y
    if cushion == 1:
        return boundary.length - radius, y
    if cushion == 2:
        return x, radius
    return x, boundary.width - radius


def is_pocket(boundary: Rectangle, partner: int) -> bool:
    return False


def pocket_of_partner(boundary: Rectangle, partner: int) -> int:
    return -1


def pocket_at(boundary: Rectangle, x: float, y: float) -> int:
    return -1


def pocket_centre(boundary: Rectangle, pocket: int) -> tuple[float, float]:
    return np.nan, np.nan


def distance_to_mouths(boundary: Rectangle, x: float, y: float) -> float:
    return np.inf
