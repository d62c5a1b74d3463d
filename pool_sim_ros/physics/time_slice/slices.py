"""The state of the loop over the slices, and what it writes down of the motions."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import kernel
from pool_sim_ros.physics.log import (
    Log,
    log_segment,
)
from pool_sim_ros.physics.motion import DiscTable


class Slices(NamedTuple):
    """The state of the loop: what the listing has, and when each pair must be looked at next."""

    table: DiscTable
    balls: NDArray[np.void]  # (n,) of DISC: radii, inverse masses, which is the cue ball
    mass: NDArray[np.float64]  # (n,), kg
    x: NDArray[np.float64]  # (n, 2), m
    v: NDArray[np.float64]  # (n, 2), m/s
    colliding: NDArray[np.bool_]  # by pair: in contact, and resolved
    due: NDArray[np.int64]  # by pair: the slice in which it could touch at the earliest
    moving: NDArray[np.bool_]  # by ball: at the start of this slice
    changed: NDArray[np.bool_]  # by ball: whether more than the cloth changed its motion
    rest: NDArray[np.float64]  # (n, 3): when and where its last motion written down ends, s, m
    clock: NDArray[np.int64]  # the slice now, and the earliest of `due`
    step: float  # s
    loss: float  # speed that a ball loses in a slice, m/s
    most: float  # with more energy than this a ball runs away, see `most_energy`
    log: Log


@kernel
def log_motion(state: Slices, i: int, now: float) -> None:
    """Write down how ball `i` moves from now on, until it rests or meets something."""
    vx, vy = state.v[i, 0], state.v[i, 1]
    speed = math.sqrt(vx * vx + vy * vy)
    deceleration = state.table.deceleration
    position = state.x[i, 0], state.x[i, 1]
    rest = state.rest[i]
    if speed > 0.0:
        slowing = deceleration / speed
        log_segment(state.log, i, now, position, (vx, vy), (-slowing * vx, -slowing * vy))
        lasts = speed / deceleration if deceleration > 0.0 else np.inf
        rest[0] = now + lasts
        rest[1], rest[2] = position[0] + 0.5 * vx * lasts, position[1] + 0.5 * vy * lasts
        return
    if rest[0] < now:
        # The parabola ends within the slice: beyond its end it would turn back.
        log_segment(state.log, i, rest[0], (rest[1], rest[2]), (0.0, 0.0), (0.0, 0.0))
    log_segment(state.log, i, now, position, (0.0, 0.0), (0.0, 0.0))
    rest[0] = np.inf


@kernel
def log_start(state: Slices) -> None:
    """Write down the first motion of every ball."""
    for i in range(len(state.moving)):
        log_motion(state, i, 0.0)
