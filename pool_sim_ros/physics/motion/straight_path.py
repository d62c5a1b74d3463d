"""A straight path along which a ball loses speed at a constant rate, and what lies on it.

What is first is found by distance along the path, so that only one time has to be computed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import inlined


class StraightPath(NamedTuple):
    """From (x, y) in m along the unit vector (ux, uy), at first at `speed` m/s."""

    x: float
    y: float
    ux: float
    uy: float
    speed: float


@inlined
def time_to_cover(distance: float, speed: float, deceleration: float) -> float:
    """Return the time in s to go `distance` m, which must be within reach.

    The smaller root of ``distance = speed t - deceleration t^2 / 2``, without cancellation.
    """
    root = np.sqrt(max(speed * speed - 2.0 * deceleration * distance, 0.0))
    return 2.0 * distance / (speed + root)


@inlined
def distance_covered(lasts: float, speed: float, deceleration: float) -> float:
    """Return how far a ball goes in `lasts` s, m; inf for ever is inf."""
    return lasts * (speed - 0.5 * deceleration * lasts) if lasts < np.inf else np.inf


@inlined
def distance_to_resting_ball(
    dx: float, dy: float, ux: float, uy: float, touch: float, reach: float
) -> float:
    """Return the distance in m along (ux, uy) to a ball at rest at (dx, dy); inf for a miss.

    `touch` is the sum of the radii. A graze is a miss: it exchanges nothing. So, here, is what
    is farther than `reach`.
    """
    along = dx * ux + dy * uy
    aside = dx * uy - dy * ux
    half_chord_squared = touch * touch - aside * aside
    # One test, nearly always false: each of the three would be guessed wrong half the time.
    if (along > 0.0) & (along - touch < reach) & (half_chord_squared > 0.0):
        return max(along - np.sqrt(half_chord_squared), 0.0)
    return np.inf


@inlined
def first_on_path(
    path: StraightPath, radius: float, reach: float, rows: NDArray[np.float64]
) -> tuple[float, int]:
    """Return the distance in m to the first of many resting balls, and which that is.

    As `distance_to_resting_ball`, for all at once. It is `reach`, and -1, where none is nearer.

    Parameters
    ----------
    path : StraightPath
        Of a ball with this `radius`, m.
    reach : float
        m.
    rows : ndarray of shape (4, n)
        Where the others rest, x and y, NaN for those that do not; their radii; room for the
        distances, m.
    """
    x, y, radii, distances = rows[0], rows[1], rows[2], rows[3]
    n = len(x)
    for k in range(n):
        dx, dy = x[k] - path.x, y[k] - path.y
        touch = radius + radii[k]
        along = dx * path.ux + dy * path.uy
        aside = dx * path.uy - dy * path.ux
        half_chord_squared = touch * touch - aside * aside
        distance = max(along - np.sqrt(max(half_chord_squared, 0.0)), 0.0)
        meets = (along > 0.0) & (half_chord_squared > 0.0)
        distances[k] = distance if meets else np.inf
    nearest, ball = reach, -1
    for k in range(n):
        if distances[k] < nearest:
            nearest, ball = distances[k], k
    return nearest, ball
