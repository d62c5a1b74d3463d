"""How one ball moves as seen from another."""

from __future__ import annotations

from typing import NamedTuple

from pool_sim_ros.physics.jit import inlined


class RelativeMotion(NamedTuple):
    """Position in m, velocity in m/s and constant acceleration in m/s^2 of a second ball.

    All are relative to a first one.
    """

    dx: float
    dy: float
    wx: float
    wy: float
    gx: float
    gy: float


@inlined
def after(motion: RelativeMotion, t: float) -> RelativeMotion:
    """Return the same motion `t` s later."""
    dx, dy, wx, wy, gx, gy = motion
    return RelativeMotion(
        dx + t * (wx + 0.5 * t * gx),
        dy + t * (wy + 0.5 * t * gy),
        wx + t * gx,
        wy + t * gy,
        gx,
        gy,
    )
