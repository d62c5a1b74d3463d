"""Where a place lies beside straight cushions, and whether it is in the mouth of a pocket."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import inlined, kernel


@inlined
def faces(segment: NDArray[np.float64], x: float, y: float) -> bool:
    """Return whether the foot of the perpendicular from (x, y) lies on a segment."""
    dx, dy = segment[2] - segment[0], segment[3] - segment[1]
    along = (x - segment[0]) * dx + (y - segment[1]) * dy
    return 0.0 <= along <= dx * dx + dy * dy


@inlined
def height_above(segment: NDArray[np.float64], x: float, y: float) -> float:
    """Return the distance of (x, y) from a segment's line, m; negative behind it."""
    return (x - segment[0]) * segment[4] + (y - segment[1]) * segment[5]


@inlined
def distance_from_way(
    x: float, y: float, end_x: float, end_y: float, px: float, py: float
) -> float:
    """Return the distance in m of (px, py) from the straight way from (x, y) to its end."""
    dx, dy = end_x - x, end_y - y
    squared = dx * dx + dy * dy
    share = ((px - x) * dx + (py - y) * dy) / squared if squared > 0.0 else 0.0
    share = min(max(share, 0.0), 1.0)
    return np.hypot(x + share * dx - px, y + share * dy - py)


@kernel
def is_cut_off(boundary: Any, x: float, y: float, radius: float) -> bool:
    """Return whether anything is between (x, y), beyond the rails, and the rectangle.

    A ball in the mouth of a pocket has a free way there; one behind a cushion has not.
    """
    end_x = min(max(x, radius), boundary.length - radius)
    end_y = min(max(y, radius), boundary.width - radius)
    for k in range(boundary.n_segments):
        segment = boundary.rows[k]
        here, there = height_above(segment, x, y), height_above(segment, end_x, end_y)
        if here * there < 0.0:
            share = here / (here - there)
            if faces(segment, x + share * (end_x - x), y + share * (end_y - y)):
                return True
    for k in range(boundary.n_segments, boundary.n_cushions):
        nose = boundary.rows[k]
        if distance_from_way(x, y, end_x, end_y, nose[0], nose[1]) < nose[2]:
            return True
    for k in range(boundary.n_cushions, boundary.n_parts):
        pocket = boundary.rows[k]
        if distance_from_way(x, y, end_x, end_y, pocket[0], pocket[1]) < pocket[2]:
            return True
    return False


def crosses(
    segments: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]
) -> bool:
    """Return whether any segment has a point within a rectangle, from a look at many of each."""
    parts = np.linspace(0.0, 1.0, 1001)[:, np.newaxis, np.newaxis]
    points = (1.0 - parts) * segments[:, :2] + parts * segments[:, 2:4]
    return bool(np.all((low < points) & (points < high), axis=-1).any())
