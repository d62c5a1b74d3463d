"""How balls that spin are turned: unit quaternions, integrated over the spins of a trajectory."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.tolerances import MAX_TURN_STEPS, SMALL_TURN, TURN_ERROR, UNIT_QUATERNION
from pool_sim_ros.physics.validation import array

Quaternion = tuple[float, float, float, float]
Vector = tuple[float, float, float]

SINE_SERIES = 1.0 / 48.0
"""The next term of ``sin(a / 2) / a = 1/2 - a^2 / 48 + ...``."""

MAGNUS_TWIST = 1.0 / 12.0
"""What the second term of Magnus's series has beside ``h^3 change x w``."""

MAGNUS_ERROR = 1.0 / 720.0
"""What the error of a step is at most, beside ``h^5 |change|^2 |w|``: the next terms of Magnus's
series for a spin that changes evenly (Blanes et al., Physics Reports 470, 2009)."""


def unit_quaternions(given: ArrayLike | None, n: int) -> NDArray[np.float64]:
    """Return (n, 4) unit quaternions; raise ValueError where they are none."""
    if given is None:
        return np.tile((0.0, 0.0, 0.0, 1.0), (n, 1))
    start = array('orientations0', given)
    if start.shape != (n, 4):
        raise ValueError(f'orientations0: shape {start.shape} must be ({n}, 4)')
    lengths = np.linalg.norm(start, axis=1)
    wrong = ~(np.abs(lengths - 1.0) <= UNIT_QUATERNION)
    if wrong.any():
        k = int(wrong.argmax())
        raise ValueError(
            f'orientations0[{k}]: {start[k].tolist()} must be a unit quaternion x, y, z, w'
        )
    return start / lengths[:, np.newaxis]


@inlined
def times(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the product of two quaternions x, y, z, w: first `b` turns, then `a`."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


@inlined
def turn_by(q: Quaternion, x: float, y: float, z: float) -> Quaternion:
    """Return a quaternion turned about (x, y, z) by its length, rad."""
    squared = x * x + y * y + z * z
    angle = math.sqrt(squared)
    half = 0.5 * angle
    # sin(a/2) / a, by its series where that is nothing divided by nothing.
    part = math.sin(half) / angle if angle > SMALL_TURN else 0.5 - SINE_SERIES * squared
    px, py, pz, pw = times((part * x, part * y, part * z, math.cos(half)), q)
    inverse = 1.0 / math.sqrt(px * px + py * py + pz * pz + pw * pw)
    return px * inverse, py * inverse, pz * inverse, pw * inverse


@inlined
def turn_evenly(q: Quaternion, w: Vector, change: Vector, lasts: float) -> Quaternion:
    """Return a quaternion after `lasts` s at a spin `w`, rad/s, that changes evenly, rad/s^2.

    Steps of Magnus's series of the fourth order. Where spin and change are parallel, as in rolling
    without side, one step is exact.
    """
    wx, wy, wz = w
    ax, ay, az = change
    cx, cy, cz = ay * wz - az * wy, az * wx - ax * wz, ax * wy - ay * wx
    across = math.sqrt(cx * cx + cy * cy + cz * cz)
    steps = 1
    if across > 0.0:
        size = math.sqrt(ax * ax + ay * ay + az * az)
        fifth = MAGNUS_ERROR * lasts**4 * lasts * size * across
        steps = min(1 + int(math.sqrt(math.sqrt(fifth / TURN_ERROR))), MAX_TURN_STEPS)
    h = lasts / steps
    twist = MAGNUS_TWIST * h * h * h
    for step in range(steps):
        middle = (step + 0.5) * h
        # change x w is the same at every time.
        q = turn_by(
            q,
            h * (wx + middle * ax) + twist * cx,
            h * (wy + middle * ay) + twist * cy,
            h * (wz + middle * az) + twist * cz,
        )
    return q


@inlined
def turn_on(
    q: Quaternion, w: Vector, change: tuple[float, float], fades: float, since: float, until: float
) -> Quaternion:
    """Return a quaternion after the part of a segment from `since` to `until`, s of its own time.

    `w` is the spin at the start of the segment; that about the vertical axis falls by `fades` until
    it is 0.
    """
    wx, wy, wz = w
    ends = abs(wz) / fades if wz != 0.0 else 0.0
    falls = -fades if wz > 0.0 else fades
    x, y = wx + since * change[0], wy + since * change[1]
    if since < ends:
        lasts = min(until, ends) - since
        q = turn_evenly(q, (x, y, wz + falls * since), (change[0], change[1], falls), lasts)
        since += lasts
        x, y = wx + since * change[0], wy + since * change[1]
    if since < until:
        q = turn_evenly(q, (x, y, 0.0), (change[0], change[1], 0.0), until - since)
    return q


@kernel
def look_up_orientations(
    segments: NDArray[np.void],
    first: NDArray[np.int64],
    order: NDArray[np.int64],
    times: NDArray[np.float64],
    fades: float,
    found: NDArray[np.float64],
) -> None:
    """Fill `found`, (k + 1, n, 4), with orientations at `times`, (k,) in s and in order.

    ``found[0]`` has those at the strike. The next one is always on the same side, so that no sign
    changes from one to the next. Other arguments are as those of `look_up.look_up_spins`.
    """
    for i in range(len(first) - 1):
        q = found[0, i, 0], found[0, i, 1], found[0, i, 2], found[0, i, 3]
        at = first[i]
        segment = segments[order[at]]
        gone = 0.0
        for k in range(len(times)):
            while at + 1 < first[i + 1] and segments[order[at + 1]].t <= times[k]:
                lasts = segments[order[at + 1]].t - segment.t
                spin = segment.wx, segment.wy, segment.wz
                change = segment.turn_x, segment.turn_y
                q = turn_on(q, spin, change, fades, gone, lasts)
                at += 1
                segment = segments[order[at]]
                gone = 0.0
            elapsed = times[k] - segment.t
            if elapsed > gone:
                spin = segment.wx, segment.wy, segment.wz
                q = turn_on(q, spin, (segment.turn_x, segment.turn_y), fades, gone, elapsed)
                gone = elapsed
            found[k + 1, i, 0], found[k + 1, i, 1] = q[0], q[1]
            found[k + 1, i, 2], found[k + 1, i, 3] = q[2], q[3]
