"""Which phase goes with the velocity and the spin of a ball: does it slide, roll or rest?"""

from __future__ import annotations

from typing import Any

import numpy as np

from pool_sim_ros.physics.jit import Record, inlined
from pool_sim_ros.physics.motion.phase import RESTS, ROLLS, SLIDES
from pool_sim_ros.physics.solid_sphere import NO_SLIP_SHARE
from pool_sim_ros.physics.tolerances import SHORTEST_PHASE, SLIP_ROUNDING


@inlined
def spin_left(wz: float, table: Any, elapsed: float) -> float:
    """Return the spin about the vertical axis `elapsed` s later, rad/s."""
    left = max(abs(wz) - table.spin * elapsed, 0.0)
    return left if wz > 0.0 else -left


@inlined
def begin_phase(ball: Record, table: Any) -> None:
    """Choose the phase that goes with the velocity and the spin of a ball."""
    radius = table.radius
    slip_x, slip_y = ball.vx - radius * ball.wy, ball.vy + radius * ball.wx
    slip = np.sqrt(slip_x * slip_x + slip_y * slip_y)
    shortest = SHORTEST_PHASE * max(ball.since, 1.0)
    scale = abs(ball.vx) + abs(ball.vy) + radius * (abs(ball.wx) + abs(ball.wy))
    lasts = NO_SLIP_SHARE * slip / table.slide
    if slip > SLIP_ROUNDING * scale and lasts > shortest:
        ball.phase = SLIDES
        ball.ax, ball.ay = -table.slide * (slip_x / slip), -table.slide * (slip_y / slip)
        ball.phase_end = ball.since + lasts
        return
    begin_to_roll(ball, table)


@inlined
def begin_to_roll(ball: Record, table: Any) -> None:
    """Let a ball roll, whatever slip rounding has left; or rest, if it hardly moves."""
    speed = np.sqrt(ball.vx * ball.vx + ball.vy * ball.vy)
    if speed > table.roll * SHORTEST_PHASE * max(ball.since, 1.0) and speed > 0.0:
        ball.phase = ROLLS
        ball.ax, ball.ay = -table.roll * (ball.vx / speed), -table.roll * (ball.vy / speed)
        ball.wx, ball.wy = -ball.vy / table.radius, ball.vx / table.radius
        ball.phase_end = ball.since + speed / table.roll
        return
    ball.phase = RESTS
    ball.vx, ball.vy, ball.ax, ball.ay, ball.wx, ball.wy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    ball.phase_end = np.inf
