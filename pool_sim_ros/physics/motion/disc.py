"""The report's motion: a disc slides along a straight line and slows down until it rests.

Its speed falls at a constant rate, so its position is a parabola in time (report, Equation 10).
The functions are the implementations of those in `motion`, which say what each returns.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import PHASE_END, distance_to_cushions
from pool_sim_ros.physics.contact_time import RelativeMotion
from pool_sim_ros.physics.jit import Record, inlined
from pool_sim_ros.physics.log import STOP
from pool_sim_ros.physics.motion.disc_record import DiscTable
from pool_sim_ros.physics.motion.phase import MOVES, RESTS
from pool_sim_ros.physics.motion.straight_path import (
    StraightPath,
    distance_covered,
    distance_to_resting_ball,
    first_on_path,
    time_to_cover,
)


@inlined
def distance_gone(ball: Record, table: Any, t: float) -> float:
    """Return how far a disc has gone at `t`, m."""
    elapsed = t - ball.since
    return elapsed * (ball.speed - 0.5 * table.deceleration * elapsed)


@inlined
def velocity_now(ball: Record, table: Any, t: float) -> tuple[float, float]:
    """Return the velocity of a disc at `t`, m/s."""
    speed = max(ball.speed - table.deceleration * (t - ball.since), 0.0)
    return ball.ux * speed, ball.uy * speed


def position_at(ball: Record, table: DiscTable, t: float) -> tuple[float, float]:
    """Return where a disc is at `t`, m."""
    distance = distance_gone(ball, table, t)
    # At rest that is exactly where it is: its direction is zero.
    return ball.x + ball.ux * distance, ball.y + ball.uy * distance


def velocity_at(ball: Record, table: DiscTable, t: float) -> tuple[float, float]:
    """Return the velocity of a disc at `t`, m/s."""
    return velocity_now(ball, table, t)


def acceleration(ball: Record, table: DiscTable) -> tuple[float, float]:
    """Return its acceleration, against its motion, m/s^2."""
    # Not -0.0 at rest, where a file or a print would show it.
    return 0.0 - table.deceleration * ball.ux, 0.0 - table.deceleration * ball.uy


def set_off(ball: Record, table: DiscTable, vx: float, vy: float) -> None:
    """Begin a new motion at (vx, vy), m/s."""
    speed = np.sqrt(vx * vx + vy * vy)
    if speed == 0.0:
        ball.ux, ball.uy, ball.speed, ball.phase = 0.0, 0.0, 0.0, RESTS
    else:
        inverse = 1.0 / speed
        ball.ux, ball.uy, ball.speed, ball.phase = vx * inverse, vy * inverse, speed, MOVES
    ball.changes += 1


def phase_end_time(ball: Record, table: DiscTable) -> float:
    """Return when a moving disc comes to rest, s."""
    return ball.since + ball.speed / table.deceleration


def end_phase(ball: Record, table: DiscTable, now: float) -> int:
    """Bring a disc to rest."""
    distance = 0.5 * ball.speed * ball.speed / table.deceleration
    ball.x += ball.ux * distance
    ball.y += ball.uy * distance
    ball.since = now
    ball.ux, ball.uy, ball.speed, ball.phase = 0.0, 0.0, 0.0, RESTS
    ball.changes += 1
    return STOP


def runs_away(ball: Record, table: DiscTable, most: float) -> bool:
    """Return whether twice its energy at `since` is above `most`, J."""
    return ball.speed * ball.speed > most * ball.inverse_mass


def path_from(ball: Record, table: DiscTable, now: float) -> StraightPath:
    """Return the straight path from `now` on."""
    elapsed = now - ball.since
    distance = elapsed * (ball.speed - 0.5 * table.deceleration * elapsed)
    speed = max(ball.speed - table.deceleration * elapsed, 0.0)
    x, y = ball.x + ball.ux * distance, ball.y + ball.uy * distance
    return StraightPath(x, y, ball.ux, ball.uy, speed)


def time_to_boundary(path: StraightPath, table: DiscTable, ball: Record) -> tuple[float, int]:
    """Return the seconds to the first cushion within reach."""
    distance, partner = distance_to_cushions(
        table.boundary, path.x, path.y, path.ux, path.uy, ball.radius
    )
    if 2.0 * table.deceleration * distance < path.speed * path.speed:
        return time_to_cover(distance, path.speed, table.deceleration), partner
    return np.inf, PHASE_END


def time_to_cell_edge(
    path: StraightPath,
    table: DiscTable,
    x_low: float,
    x_high: float,
    y_low: float,
    y_high: float,
) -> tuple[float, int, int]:
    """Return the seconds to the edge of the cell, and the step over it."""
    to_x = to_y = np.inf
    step_x, step_y = 1, 1
    if path.ux > 0.0:
        to_x = (x_high - path.x) / path.ux
    elif path.ux < 0.0:
        to_x, step_x = (x_low - path.x) / path.ux, -1
    if path.uy > 0.0:
        to_y = (y_high - path.y) / path.uy
    elif path.uy < 0.0:
        to_y, step_y = (y_low - path.y) / path.uy, -1
    distance = max(min(to_x, to_y), 0.0)
    seconds = np.inf
    if 2.0 * table.deceleration * distance < path.speed * path.speed and distance < np.inf:
        seconds = time_to_cover(distance, path.speed, table.deceleration)
    if to_x <= to_y:
        return seconds, step_x, 0
    return seconds, 0, step_y


def first_resting_ball(
    path: StraightPath,
    table: DiscTable,
    radius: float,
    lasts: float,
    rows: NDArray[np.float64],
) -> tuple[float, int]:
    """Return the seconds to the first resting ball, and which, of few."""
    reach = distance_covered(lasts, path.speed, table.deceleration)
    distance, ball = first_on_path(path, radius, reach, rows)
    if ball < 0:
        return np.inf, ball
    return time_to_cover(distance, path.speed, table.deceleration), ball


def first_resting_of(
    path: StraightPath,
    table: DiscTable,
    radius: float,
    lasts: float,
    balls: NDArray[np.void],
    listed: NDArray[np.int64],
    count: int,
) -> tuple[float, int]:
    """Return the seconds to the first resting ball, and which, of those listed."""
    nearest, ball = distance_covered(lasts, path.speed, table.deceleration), -1
    for m in range(count):
        other = balls[listed[m]]
        dx, dy = other.x - path.x, other.y - path.y
        touch = radius + other.radius
        distance = distance_to_resting_ball(dx, dy, path.ux, path.uy, touch, nearest)
        if distance < nearest:
            nearest, ball = distance, listed[m]
    if ball < 0:
        return np.inf, ball
    return time_to_cover(nearest, path.speed, table.deceleration), ball


def time_to_resting_ball(
    path: StraightPath, table: DiscTable, dx: float, dy: float, touch: float
) -> float:
    """Return the seconds to a resting ball within reach."""
    a = table.deceleration
    reach = np.inf if a == 0.0 else 0.5 * path.speed * path.speed / a
    distance = distance_to_resting_ball(dx, dy, path.ux, path.uy, touch, reach)
    return time_to_cover(distance, path.speed, a) if distance < reach else np.inf


def relative_motion(path: StraightPath, table: DiscTable, other: StraightPath) -> RelativeMotion:
    """Return how the disc on path `other` moves relative to that on `path`."""
    a = table.deceleration
    return RelativeMotion(
        other.x - path.x,
        other.y - path.y,
        other.ux * other.speed - path.ux * path.speed,
        other.uy * other.speed - path.uy * path.speed,
        a * (path.ux - other.ux),
        a * (path.uy - other.uy),
    )


def advance(ball: Record, table: DiscTable, now: float) -> tuple[float, float]:
    """Bring a disc to where it is at `now`; its speed is left to `set_off`."""
    velocity = velocity_now(ball, table, now)
    distance = distance_gone(ball, table, now)
    ball.x += ball.ux * distance
    ball.y += ball.uy * distance
    ball.since = now
    return velocity


def has_phases(table: DiscTable) -> bool:
    """Return that a disc rests when its one phase ends."""
    return False


def keep_path(ball: Record, table: DiscTable, rows: NDArray[np.float64], i: int) -> None:
    """Note nothing: the way of a disc is looked at one by one."""


def sift(
    path: Any,
    table: DiscTable,
    radius: float,
    times: tuple[float, float],
    rows: NDArray[np.float64],
) -> bool:
    return False


def touched_in_rows(
    table: DiscTable,
    rows: NDArray[np.float64],
    place: tuple[float, float],
    near: float,
    pair: tuple[int, int],
    now: float,
) -> tuple[bool, bool]:
    return False, False


def rest_begins(ball: Record, table: DiscTable) -> float:
    """Return when a disc came to rest, s: it does not spin."""
    return ball.since


def give_spin(ball: Record, table: DiscTable, wx: float, wy: float, wz: float) -> None:
    """Leave a disc as it is."""


def log_spin(segment: Record, ball: Record, table: DiscTable) -> None:
    """Write nothing: a disc does not spin."""


def lie_at(ball: Record, table: DiscTable, x: float, y: float) -> None:
    """Put a disc at rest to (x, y), m."""
    ball.x, ball.y = x, y


def in_play(ball: Record, table: DiscTable) -> bool:
    """Return that a disc always is."""
    return True


def catch(ball: Record, table: DiscTable, pocket: int, now: float) -> None:
    """Leave a disc as it is: it meets no pocket."""


def pocket_of(ball: Record, table: DiscTable) -> int:
    """Return -1: discs fall into no pockets."""
    return -1


def shown_at(ball: Record, table: DiscTable) -> tuple[float, float]:
    """Return where a disc is when its motion begins, m."""
    return ball.x, ball.y
