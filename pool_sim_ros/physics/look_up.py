"""Where balls are, how fast, and how they spin at any time: the segments of a trajectory, by time.

Ball i has the segments ``order[first[i]:first[i + 1]]``, in order of time.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import inlined, kernel


@kernel
def look_up(
    segments: NDArray[np.void],
    first: NDArray[np.int64],
    order: NDArray[np.int64],
    times: NDArray[np.float64],
    what: int,
    found: NDArray[np.float64],
) -> None:
    """Fill `found`, (k, n, 2), with positions (`what` 0) or velocities (1) at `times`, (k,).

    Ball i has the segments ``order[first[i]:first[i + 1]]``, in order of time.
    """
    for i in range(len(first) - 1):
        for k in range(len(times)):
            segment = segments[segment_at(segments, first, order, i, times[k])]
            elapsed = times[k] - segment.t
            if what == 1:
                found[k, i, 0] = segment.vx + segment.ax * elapsed
                found[k, i, 1] = segment.vy + segment.ay * elapsed
            elif segment.ax == 0.0 and segment.ay == 0.0 and segment.vx == 0.0 == segment.vy:
                # At rest, for ever: infinity times nothing is no number.
                found[k, i, 0], found[k, i, 1] = segment.x, segment.y
            else:
                found[k, i, 0] = segment.x + elapsed * (segment.vx + 0.5 * segment.ax * elapsed)
                found[k, i, 1] = segment.y + elapsed * (segment.vy + 0.5 * segment.ay * elapsed)


@kernel
def look_up_spins(
    segments: NDArray[np.void],
    first: NDArray[np.int64],
    order: NDArray[np.int64],
    times: NDArray[np.float64],
    fades: float,
    found: NDArray[np.float64],
) -> None:
    """Fill `found`, (k, n, 3), with spins in rad/s; as `look_up`.

    The spin about the vertical axis falls by `fades` rad/s^2.
    """
    for i in range(len(first) - 1):
        for k in range(len(times)):
            segment = segments[segment_at(segments, first, order, i, times[k])]
            elapsed = times[k] - segment.t
            left = max(abs(segment.wz) - fades * elapsed, 0.0)
            found[k, i, 0] = segment.wx + segment.turn_x * elapsed
            found[k, i, 1] = segment.wy + segment.turn_y * elapsed
            found[k, i, 2] = left if segment.wz > 0.0 else -left


@inlined
def segment_at(
    segments: NDArray[np.void],
    first: NDArray[np.int64],
    order: NDArray[np.int64],
    i: int,
    t: float,
) -> int:
    """Return the number of the segment of ball `i` at `t`, s."""
    low, high = first[i], first[i + 1]
    while high - low > 1:
        middle = (low + high) // 2
        if segments[order[middle]].t <= t:
            low = middle
        else:
            high = middle
    return order[low]
