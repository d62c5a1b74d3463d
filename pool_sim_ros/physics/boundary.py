"""What bounds the cloth, and what a ball may touch there.

A boundary is chosen by the type of its named tuple when the kernels are compiled. The report's is
a rectangle: four cushions parallel to the axes, which need a comparison where another needs a dot
product. Cushions have numbers, in a rectangle 0: x = 0, 1: x = length, 2: y = 0, 3: y = width.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pool_sim_ros.physics.jit import chosen_by, inlined, register

PHASE_END = -1
"""As the partner in a ball's next event: none, its phase of motion ends."""

FIRST_CUSHION = -2
"""As the partner in a ball's next event: cushion number 0; the others follow downwards."""


class Rectangle(NamedTuple):
    """Four cushions parallel to the axes, from (0, 0) to (length, width), m."""

    length: float
    width: float


@inlined
def partner_of_cushion(cushion: int) -> int:
    """Return how a ball's next event names a cushion, by its number."""
    return FIRST_CUSHION - cushion


@inlined
def cushion_of_partner(partner: int) -> int:
    """Return the number of a cushion that a ball's next event names."""
    return FIRST_CUSHION - partner


@chosen_by('boundary')
def n_cushions(boundary: Any) -> int:
    """Return how many cushions there are."""
    raise NotImplementedError


@chosen_by('boundary')
def cushion_gap(boundary: Any, cushion: int, x: float, y: float, radius: float) -> float:
    """Return the gap in m between a cushion and a ball at (x, y); negative where they overlap."""
    raise NotImplementedError


@chosen_by('boundary')
def cushion_normal(boundary: Any, cushion: int, x: float, y: float) -> tuple[float, float]:
    """Return the unit vector from a ball at (x, y) into a cushion."""
    raise NotImplementedError


@chosen_by('boundary')
def distance_to_cushions(
    boundary: Any, x: float, y: float, ux: float, uy: float, radius: float
) -> tuple[float, int]:
    """Return how far a ball goes straight along (ux, uy) to the first cushion, and which.

    Parameters
    ----------
    boundary : Rectangle
    x, y : float
        Where it is, m.
    ux, uy : float
        Unit direction.
    radius : float
        m.

    Returns
    -------
    distance : float
        m, not negative; inf where there is none.
    partner : int
        The cushion as `partner_of_cushion` has it; PHASE_END for none.
    """
    raise NotImplementedError


@chosen_by('boundary')
def to_cushion_axes(
    boundary: Any, cushion: int, normal: tuple[float, float], v: tuple[float, float]
) -> tuple[float, float]:
    """Return a vector's parts along the normal of a cushion and across it, each up to its sign."""
    raise NotImplementedError


@chosen_by('boundary')
def from_cushion_axes(
    boundary: Any, cushion: int, normal: tuple[float, float], v: tuple[float, float]
) -> tuple[float, float]:
    """Return the vector, (x, y), of which `to_cushion_axes` gives these parts."""
    raise NotImplementedError


@chosen_by('boundary')
def touches_cushion(boundary: Any, x: float, y: float, reach: float, but: int) -> bool:
    """Return whether any cushion but number `but` is within `reach` m of (x, y)."""
    raise NotImplementedError


@chosen_by('boundary')
def is_outside(boundary: Any, x: float, y: float, radius: float, tolerance: float) -> bool:
    """Return whether a ball at (x, y) overlaps a cushion by more than `tolerance` m, or is NaN."""
    raise NotImplementedError


def _rectangle_n(boundary: Rectangle) -> int:
    return 4


def _rectangle_gap(boundary: Rectangle, cushion: int, x: float, y: float, radius: float) -> float:
    if cushion == 0:
        return x - radius
    if cushion == 1:
        return boundary.length - radius - x
    if cushion == 2:
        return y - radius
    return boundary.width - radius - y


def _rectangle_normal(boundary: Rectangle, cushion: int, x: float, y: float) -> tuple[float, float]:
    if cushion == 0:
        return -1.0, 0.0
    if cushion == 1:
        return 1.0, 0.0
    if cushion == 2:
        return 0.0, -1.0
    return 0.0, 1.0


def _rectangle_distance(
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


def _rectangle_axes(
    boundary: Rectangle, cushion: int, normal: tuple[float, float], v: tuple[float, float]
) -> tuple[float, float]:
    # Both ways: the parts change places, or not.
    return (v[0], v[1]) if cushion < 2 else (v[1], v[0])


def _rectangle_touches(boundary: Rectangle, x: float, y: float, reach: float, but: int) -> bool:
    return (
        (x <= reach and but != 0)
        or (boundary.length - x <= reach and but != 1)
        or (y <= reach and but != 2)
        or (boundary.width - y <= reach and but != 3)
    )


def _rectangle_outside(
    boundary: Rectangle, x: float, y: float, radius: float, tolerance: float
) -> bool:
    least = radius - tolerance
    inside_x = (least <= x) & (x <= boundary.length - radius + tolerance)
    inside_y = (least <= y) & (y <= boundary.width - radius + tolerance)
    return not (inside_x & inside_y)


for _choice, _implementation in (
    (n_cushions, _rectangle_n),
    (cushion_gap, _rectangle_gap),
    (cushion_normal, _rectangle_normal),
    (distance_to_cushions, _rectangle_distance),
    (to_cushion_axes, _rectangle_axes),
    (from_cushion_axes, _rectangle_axes),
    (touches_cushion, _rectangle_touches),
    (is_outside, _rectangle_outside),
):
    register(_choice, Rectangle, _implementation)
