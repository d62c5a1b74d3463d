"""A boundary of straight cushions in any direction, round noses and pockets.

Most of a table is its inner rectangle: whatever bounds it is beyond the lines on which a ball
touches the straight rails. While a ball stays there nothing else has to be looked at. The
functions are the implementations of those in `seam`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary.mouths import crosses, faces, height_above, is_cut_off
from pool_sim_ros.physics.boundary.rectangle import time_to_rectangle
from pool_sim_ros.physics.boundary.seam import FIRST_CUSHION, PHASE_END
from pool_sim_ros.physics.capsule import Capsule, capsule_of, room_beside
from pool_sim_ros.physics.contact_time import RelativeMotion, time_to_line, time_to_moving_ball
from pool_sim_ros.physics.jit import inlined, kernel
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
    rails = np.full(len(segments), -1)
    sides = ((0, 0.0, 1.0), (0, length, -1.0), (1, 0.0, 1.0), (1, width, -1.0))
    for side, (axis, at, inward) in enumerate(sides):
        on = (segments[:, axis] == at) & (segments[:, 2 + axis] == at)
        rails[on & (segments[:, 4 + axis] == inward)] = side
    # Does a ball in the inner rectangle touch anything but a rail?
    low, high = np.full(2, radius), np.array([length, width]) - radius
    circles = [(x, y, r + radius) for x, y, r in noses] + [tuple(pocket) for pocket in pockets]
    jaws = segments[rails < 0]
    circles += [(x, y, radius) for x, y in np.concatenate([jaws[:, :2], jaws[:, 2:4]])]
    free = all(
        np.hypot(*(np.clip((x, y), low, high) - (x, y))) >= reach - TOUCHING
        for x, y, reach in circles
    ) and not crosses(jaws, low - radius, high + radius)
    return PocketedBoundary(
        length, width, segments, noses, pockets, rails, radius if free else np.inf
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


@inlined
def rail_at(boundary: Any, partner: int, x: float, y: float) -> int:
    """Return the partner that is the rail before (x, y) on a rectangle's side; PHASE_END: none."""
    side = FIRST_CUSHION - partner
    for k in range(len(boundary.rails)):
        if boundary.rails[k] == side and faces(boundary.segments[k], x, y):
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


def time_to_cushions(boundary: PocketedBoundary, path: Any, radius: float) -> tuple[float, int]:
    if is_inner(boundary, path.x, path.y, radius):
        seconds, partner = time_to_rectangle(boundary, path, radius)
        if partner == PHASE_END:
            return seconds, partner
        x = path.x + seconds * (path.vx + 0.5 * seconds * path.ax)
        y = path.y + seconds * (path.vy + 0.5 * seconds * path.ay)
        rail = rail_at(boundary, partner, x, y)
        if rail != PHASE_END:
            return seconds, rail
    return time_to_anything(boundary, path, radius)


@kernel
def time_to_anything(boundary: Any, path: Any, radius: float) -> tuple[float, int]:
    """Return as `time_to_cushions`, from a look at every cushion and pocket."""
    segments, noses, pockets = boundary.segments, boundary.noses, boundary.pockets
    best, partner = path.lasts, PHASE_END
    for k in range(len(segments)):
        nx, ny = segments[k, 4], segments[k, 5]
        gap = height_above(segments[k], path.x, path.y) - radius
        closing, pressing = -(path.vx * nx + path.vy * ny), -(path.ax * nx + path.ay * ny)
        t = time_to_line(gap, closing, pressing, best)
        if t < best:
            x = path.x + t * (path.vx + 0.5 * t * path.ax)
            y = path.y + t * (path.vy + 0.5 * t * path.ay)
            if faces(segments[k], x, y):
                best, partner = t, FIRST_CUSHION - k
    capsule = capsule_of(path, best)
    for k in range(len(noses)):
        t = time_to_circle(path, capsule, noses[k], radius, best)
        if t < best:
            best, partner = t, FIRST_CUSHION - len(segments) - k
    for k in range(len(pockets)):
        t = time_to_circle(path, capsule, pockets[k], 0.0, best)
        if t < best:
            best, partner = t, FIRST_CUSHION - len(segments) - len(noses) - k
    return (best if partner != PHASE_END else np.inf), partner


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
    if pocket_around(boundary, x, y) >= 0:
        return False
    if not (abs(x) < np.inf and abs(y) < np.inf):
        return True
    # Where most balls of a layout lie: nothing but the rails is near.
    if (
        (boundary.inner == radius)
        & (radius <= x <= boundary.length - radius)
        & (radius <= y <= boundary.width - radius)
        & (tolerance >= TOUCHING)
    ):
        return False
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
