"""A boundary of straight cushions in any direction, round noses and pockets.

Most of a table is its inner rectangle: whatever bounds it is beyond the lines on which a ball
touches the straight rails. While a ball stays there nothing else has to be looked at. The
functions are the implementations of those in `seam`; that of `time_to_cushions` has a module of
its own.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary.first_touch import time_to_cushions as time_to_cushions
from pool_sim_ros.physics.boundary.mouths import faces, height_above, is_cut_off
from pool_sim_ros.physics.boundary.seam import FIRST_CUSHION
from pool_sim_ros.physics.boundary.surroundings import (
    free_stretches,
    has_inner_rectangle,
    sides_of,
    surroundings,
)
from pool_sim_ros.physics.jit import inlined
from pool_sim_ros.physics.tolerances import TOUCHING


class PocketedBoundary(NamedTuple):
    """Cushions and pockets; the numbers of cushions are those of the segments, then the noses."""

    length: float  # of the rectangle on which the rails lie, m
    width: float
    segments: NDArray[np.float64]  # (k, 6): x0, y0, x1, y1, and the unit normal into the table
    noses: NDArray[np.float64]  # (p, 3): centre and radius, m
    pockets: NDArray[np.float64]  # (q, 3): centre and radius, m
    rails: NDArray[np.int64]  # (k,): the side of the rectangle on which a segment lies, or -1
    inner: float  # the balls' radius where they have an inner rectangle, m; inf where not
    stretches: NDArray[np.float64]  # as `free_stretches` has them
    around: NDArray[np.int64]  # as `surroundings` has them
    within: NDArray[np.float64]


def pocketed_boundary(
    size: tuple[float, float],
    segments: NDArray[np.float64],
    noses: NDArray[np.float64],
    pockets: NDArray[np.float64],
    radius: float,
) -> PocketedBoundary:
    """Return a boundary, ready for the kernels, for balls of one `radius`, m.

    The other arguments are as `PocketedBoundary` has them; `size` is length and width.
    """
    length, width = size
    rails = sides_of(size, segments)
    free = has_inner_rectangle(size, segments[rails < 0], noses, pockets, radius)
    return PocketedBoundary(
        length,
        width,
        segments,
        noses,
        pockets,
        rails,
        radius if free else np.inf,
        free_stretches(size, segments, rails, noses, radius),
        *surroundings(segments, noses, pockets, radius),
    )


def n_cushions(boundary: PocketedBoundary) -> int:
    return len(boundary.segments) + len(boundary.noses)


def cushion_gap(
    boundary: PocketedBoundary, cushion: int, x: float, y: float, radius: float
) -> float:
    k = len(boundary.segments)
    if cushion >= k:
        nose = boundary.noses[cushion - k]
        return np.hypot(x - nose[0], y - nose[1]) - nose[2] - radius
    segment = boundary.segments[cushion]
    height = height_above(segment, x, y)
    # What is far behind it is before another cushion.
    return height - radius if height > -radius and faces(segment, x, y) else np.inf


def cushion_normal(
    boundary: PocketedBoundary, cushion: int, x: float, y: float
) -> tuple[float, float]:
    k = len(boundary.segments)
    if cushion >= k:
        nose = boundary.noses[cushion - k]
        dx, dy = nose[0] - x, nose[1] - y
        distance = np.hypot(dx, dy)
        return dx / distance, dy / distance
    return 0.0 - boundary.segments[cushion, 4], 0.0 - boundary.segments[cushion, 5]


def nose_radius(boundary: PocketedBoundary, cushion: int) -> float:
    k = len(boundary.segments)
    return boundary.noses[cushion - k, 2] if cushion >= k else 0.0


def put_on_cushion(
    boundary: PocketedBoundary, cushion: int, x: float, y: float, radius: float
) -> tuple[float, float]:
    if cushion >= len(boundary.segments):
        return x, y
    segment = boundary.segments[cushion]
    # Along an axis exactly: a ball on a rail then stays on it.
    if segment[4] == 0.0:
        return x, segment[1] + segment[5] * radius
    if segment[5] == 0.0:
        return segment[0] + segment[4] * radius, y
    gap = height_above(segment, x, y) - radius
    return x - gap * segment[4], y - gap * segment[5]


@inlined
def pocket_number(boundary: Any, partner: int) -> int:
    """Return the number of the pocket that a partner names; negative for a cushion."""
    return FIRST_CUSHION - partner - len(boundary.segments) - len(boundary.noses)


def is_pocket(boundary: PocketedBoundary, partner: int) -> bool:
    return pocket_number(boundary, partner) >= 0


def pocket_of_partner(boundary: PocketedBoundary, partner: int) -> int:
    return pocket_number(boundary, partner)


@inlined
def pocket_around(boundary: Any, x: float, y: float) -> int:
    """Return the number of the pocket in whose circle (x, y) lies, -1 for none."""
    # Where most balls lie: no pocket's circle reaches farther in.
    least = boundary.inner + TOUCHING
    if least < x < boundary.length - least and least < y < boundary.width - least:
        return -1
    for k in range(len(boundary.pockets)):
        pocket = boundary.pockets[k]
        dx, dy = x - pocket[0], y - pocket[1]
        if dx * dx + dy * dy < pocket[2] * pocket[2]:
            return k
    return -1


def pocket_at(boundary: PocketedBoundary, x: float, y: float) -> int:
    return pocket_around(boundary, x, y)


def pocket_centre(boundary: PocketedBoundary, pocket: int) -> tuple[float, float]:
    return boundary.pockets[pocket, 0], boundary.pockets[pocket, 1]


def distance_to_mouths(boundary: PocketedBoundary, x: float, y: float) -> float:
    least = min(min(x, boundary.length - x), min(y, boundary.width - y))
    for k in range(len(boundary.pockets)):
        pocket = boundary.pockets[k]
        least = min(least, np.hypot(x - pocket[0], y - pocket[1]) - pocket[2])
    return least


def to_cushion_axes(
    boundary: PocketedBoundary, cushion: int, normal: tuple[float, float], v: tuple[float, float]
) -> tuple[float, float]:
    return v[0] * normal[0] + v[1] * normal[1], v[1] * normal[0] - v[0] * normal[1]


def from_cushion_axes(
    boundary: PocketedBoundary, cushion: int, normal: tuple[float, float], v: tuple[float, float]
) -> tuple[float, float]:
    return v[0] * normal[0] - v[1] * normal[1], v[0] * normal[1] + v[1] * normal[0]


def touches_cushion(boundary: PocketedBoundary, x: float, y: float, reach: float, but: int) -> bool:
    if (
        boundary.inner <= reach
        and reach < x < boundary.length - reach
        and reach < y < boundary.width - reach
    ):
        return False
    if boundary.inner <= reach <= boundary.inner + TOUCHING and 0 <= but < len(boundary.segments):
        stretch = boundary.stretches[but]
        if stretch[0] <= x <= stretch[1] and stretch[2] <= y <= stretch[3]:
            return False
    for k in range(len(boundary.segments)):
        segment = boundary.segments[k]
        if k != but and abs(height_above(segment, x, y)) <= reach and faces(segment, x, y):
            return True
    for k in range(len(boundary.noses)):
        nose = boundary.noses[k]
        near = reach + nose[2]
        dx, dy = x - nose[0], y - nose[1]
        if k + len(boundary.segments) != but and dx * dx + dy * dy <= near * near:
            return True
    return False


def is_outside(
    boundary: PocketedBoundary, x: float, y: float, radius: float, tolerance: float
) -> bool:
    # Where most balls of a layout lie: nothing but the rails is near.
    if (
        (boundary.inner == radius)
        & (radius <= x <= boundary.length - radius)
        & (radius <= y <= boundary.width - radius)
        & (tolerance >= TOUCHING)
    ):
        return False
    if pocket_around(boundary, x, y) >= 0:
        return False
    if not (abs(x) < np.inf and abs(y) < np.inf):
        return True
    least = radius - tolerance
    for k in range(len(boundary.segments)):
        segment = boundary.segments[k]
        if faces(segment, x, y) and abs(height_above(segment, x, y)) < least:
            return True
    for k in range(len(boundary.noses)):
        nose = boundary.noses[k]
        if np.hypot(x - nose[0], y - nose[1]) < nose[2] + least:
            return True
    if 0.0 <= x <= boundary.length and 0.0 <= y <= boundary.width:
        return False
    return is_cut_off(boundary, x, y, radius)
