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
from pool_sim_ros.physics.boundary.surroundings import STRETCH, rows_of
from pool_sim_ros.physics.jit import inlined
from pool_sim_ros.physics.tolerances import TOUCHING


class PocketedBoundary(NamedTuple):
    """Cushions and pockets.

    They are the rows of one array, since each array costs nine arguments wherever a kernel calls
    another: first the segments, then the noses, then the pockets, then what `surroundings` lists.
    The number of a cushion is that of its row.
    """

    length: float  # of the rectangle on which the rails lie, m
    width: float
    inner: float  # the balls' radius where they have an inner rectangle, m; inf where not
    n_segments: int
    n_cushions: int  # segments and noses
    n_parts: int  # with the pockets
    # A segment: x0, y0, x1, y1, and the unit normal into the table; a circle: centre and radius, m;
    # then what `surroundings` has names for.
    rows: NDArray[np.float64]

    @property
    def segments(self) -> NDArray[np.float64]:
        """Ends and normals of the straight cushions, (k, 6)."""
        return self.rows[: self.n_segments, :STRETCH]

    @property
    def noses(self) -> NDArray[np.float64]:
        """Centres and radii of the round noses, (p, 3), m."""
        return self.rows[self.n_segments : self.n_cushions, :3]

    @property
    def pockets(self) -> NDArray[np.float64]:
        """Centres and radii of the pockets, (q, 3), m."""
        return self.rows[self.n_cushions : self.n_parts, :3]


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
    rows, free = rows_of(size, segments, noses, pockets, radius)
    n, m = len(segments), len(segments) + len(noses)
    return PocketedBoundary(*size, radius if free else np.inf, n, m, m + len(pockets), rows)


def n_cushions(boundary: PocketedBoundary) -> int:
    return boundary.n_cushions


def cushion_gap(
    boundary: PocketedBoundary, cushion: int, x: float, y: float, radius: float
) -> float:
    part = boundary.rows[cushion]
    if cushion >= boundary.n_segments:
        return np.hypot(x - part[0], y - part[1]) - part[2] - radius
    height = height_above(part, x, y)
    # What is far behind it is before another cushion.
    return height - radius if height > -radius and faces(part, x, y) else np.inf


def cushion_normal(
    boundary: PocketedBoundary, cushion: int, x: float, y: float
) -> tuple[float, float]:
    part = boundary.rows[cushion]
    if cushion >= boundary.n_segments:
        dx, dy = part[0] - x, part[1] - y
        distance = np.hypot(dx, dy)
        return dx / distance, dy / distance
    return 0.0 - part[4], 0.0 - part[5]


def nose_radius(boundary: PocketedBoundary, cushion: int) -> float:
    return boundary.rows[cushion, 2] if cushion >= boundary.n_segments else 0.0


def put_on_cushion(
    boundary: PocketedBoundary, cushion: int, x: float, y: float, radius: float
) -> tuple[float, float]:
    if cushion >= boundary.n_segments:
        return x, y
    segment = boundary.rows[cushion]
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
    return FIRST_CUSHION - partner - boundary.n_cushions


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
    for k in range(boundary.n_cushions, boundary.n_parts):
        pocket = boundary.rows[k]
        dx, dy = x - pocket[0], y - pocket[1]
        if dx * dx + dy * dy < pocket[2] * pocket[2]:
            return k - boundary.n_cushions
    return -1


def pocket_at(boundary: PocketedBoundary, x: float, y: float) -> int:
    return pocket_around(boundary, x, y)


def pocket_centre(boundary: PocketedBoundary, pocket: int) -> tuple[float, float]:
    part = boundary.rows[boundary.n_cushions + pocket]
    return part[0], part[1]


def distance_to_mouths(boundary: PocketedBoundary, x: float, y: float) -> float:
    least = min(min(x, boundary.length - x), min(y, boundary.width - y))
    for k in range(boundary.n_cushions, boundary.n_parts):
        pocket = boundary.rows[k]
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
    if boundary.inner <= reach <= boundary.inner + TOUCHING and 0 <= but < boundary.n_segments:
        stretch = boundary.rows[but, STRETCH:]
        if stretch[0] <= x <= stretch[1] and stretch[2] <= y <= stretch[3]:
            return False
    for k in range(boundary.n_segments):
        segment = boundary.rows[k]
        if k != but and abs(height_above(segment, x, y)) <= reach and faces(segment, x, y):
            return True
    for k in range(boundary.n_segments, boundary.n_cushions):
        nose = boundary.rows[k]
        near = reach + nose[2]
        dx, dy = x - nose[0], y - nose[1]
        if k != but and dx * dx + dy * dy <= near * near:
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
    for k in range(boundary.n_segments):
        segment = boundary.rows[k]
        if faces(segment, x, y) and abs(height_above(segment, x, y)) < least:
            return True
    for k in range(boundary.n_segments, boundary.n_cushions):
        nose = boundary.rows[k]
        if np.hypot(x - nose[0], y - nose[1]) < nose[2] + least:
            return True
    if 0.0 <= x <= boundary.length and 0.0 <= y <= boundary.width:
        return False
    return is_cut_off(boundary, x, y, radius)
