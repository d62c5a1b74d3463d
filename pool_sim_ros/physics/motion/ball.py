"""A ball that slides, rolls and spins.

It slides while the point that touches the cloth moves over it, then rolls, then rests; in each
phase its acceleration is constant. The spin about the vertical axis fades by itself in all of them
and in place. The functions are the implementations of those in `motion`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import pocket_at, pocket_centre, time_to_cushions
from pool_sim_ros.physics.contact_time import RelativeMotion
from pool_sim_ros.physics.jit import Record
from pool_sim_ros.physics.log import ROLL, STOP
from pool_sim_ros.physics.motion.ball_phases import begin_phase, begin_to_roll, spin_left
from pool_sim_ros.physics.motion.ball_record import BallTable
from pool_sim_ros.physics.motion.curved_path import (
    CurvedPath,
    first_in_rows,
    first_of_listed,
    straight,
    time_over,
    time_to_place,
)
from pool_sim_ros.physics.motion.moving_balls import keep_in_rows, mark_those_near
from pool_sim_ros.physics.motion.moving_balls import touched_in_rows as touched_in_rows
from pool_sim_ros.physics.motion.phase import RESTS, ROLLS, SLIDES
from pool_sim_ros.physics.motion.straight_path import (
    distance_covered,
    distance_to_resting_ball,
    first_on_path,
    time_to_cover,
)
from pool_sim_ros.physics.solid_sphere import NO_SLIP_SHARE, SPIN_PER_PUSH
from pool_sim_ros.physics.tolerances import LONGEST


def position_at(ball: Record, table: BallTable, t: float) -> tuple[float, float]:
    """Return where a ball is at `t`, m."""
    elapsed = t - ball.since
    return (
        ball.x + elapsed * (ball.vx + 0.5 * elapsed * ball.ax),
        ball.y + elapsed * (ball.vy + 0.5 * elapsed * ball.ay),
    )


def velocity_at(ball: Record, table: BallTable, t: float) -> tuple[float, float]:
    """Return the velocity of a ball at `t`, m/s."""
    elapsed = t - ball.since
    return ball.vx + elapsed * ball.ax, ball.vy + elapsed * ball.ay


def acceleration(ball: Record, table: BallTable) -> tuple[float, float]:
    """Return its acceleration, m/s^2."""
    return ball.ax, ball.ay


def shown_at(ball: Record, table: BallTable) -> tuple[float, float]:
    """Return where a ball is at `since`; in a pocket that is the pocket's centre."""
    if ball.pocket >= 0:
        return pocket_centre(table.boundary, ball.pocket)
    return ball.x, ball.y


def advance(ball: Record, table: BallTable, now: float) -> tuple[float, float]:
    """Begin the motion anew at `now`, with the spin that is left."""
    elapsed = now - ball.since
    ball.x += elapsed * (ball.vx + 0.5 * elapsed * ball.ax)
    ball.y += elapsed * (ball.vy + 0.5 * elapsed * ball.ay)
    ball.vx += elapsed * ball.ax
    ball.vy += elapsed * ball.ay
    if ball.phase == SLIDES:
        turn = SPIN_PER_PUSH / table.radius * elapsed
        ball.wx += turn * ball.ay
        ball.wy -= turn * ball.ax
    elif ball.phase == ROLLS:
        ball.wx, ball.wy = -ball.vy / table.radius, ball.vx / table.radius
    ball.wz = spin_left(ball.wz, table, elapsed)
    ball.since = now
    return ball.vx, ball.vy


def set_off(ball: Record, table: BallTable, vx: float, vy: float) -> None:
    """Begin a new motion at (vx, vy), m/s, with the spin that the ball has."""
    ball.vx, ball.vy = vx, vy
    ball.changes += 1
    begin_phase(ball, table)


def phase_end_time(ball: Record, table: BallTable) -> float:
    """Return when a moving ball stops to slide or to roll, s."""
    return ball.phase_end


def end_phase(ball: Record, table: BallTable, now: float) -> int:
    """Let a ball that slides roll, one that rolls rest; nobody else need know of the first."""
    elapsed = ball.phase_end - ball.since
    slides = ball.phase == SLIDES
    ball.x += elapsed * (ball.vx + 0.5 * elapsed * ball.ax)
    ball.y += elapsed * (ball.vy + 0.5 * elapsed * ball.ay)
    ball.wz = spin_left(ball.wz, table, elapsed)
    ball.since = now
    if slides:
        # v - 2/7 of the slip, so written that it is exactly 0 where backspin eats up all of it.
        radius = table.radius
        ball.vx, ball.vy = (
            NO_SLIP_SHARE * (SPIN_PER_PUSH * ball.vx + radius * ball.wy),
            NO_SLIP_SHARE * (SPIN_PER_PUSH * ball.vy - radius * ball.wx),
        )
        begin_to_roll(ball, table)
        if ball.phase == ROLLS:
            return ROLL
    else:
        ball.vx, ball.vy, ball.ax, ball.ay, ball.wx, ball.wy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        ball.phase = RESTS
        ball.phase_end = np.inf
    ball.changes += 1
    return STOP


def has_phases(table: BallTable) -> bool:
    """Return that a ball rolls when it has stopped to slide."""
    return True


def keep_path(ball: Record, table: BallTable, rows: NDArray[np.float64], i: int) -> None:
    """Note how a ball moves from `since` on."""
    keep_in_rows(ball, rows, i)


def sift(
    path: CurvedPath,
    table: BallTable,
    radius: float,
    times: tuple[float, float],
    rows: NDArray[np.float64],
) -> bool:
    """Mark those near; True."""
    mark_those_near(path, radius, times[0], times[1], rows)
    return True


def rest_begins(ball: Record, table: BallTable) -> float:
    """Return when a ball that does not move stops to spin too, s."""
    if ball.wz == 0.0:
        return ball.since
    return ball.since + abs(ball.wz) / table.spin


def runs_away(ball: Record, table: BallTable, most: float) -> bool:
    """Return that no ball does: friction here takes energy."""
    return False


def path_from(ball: Record, table: BallTable, now: float) -> CurvedPath:
    """Return the path from `now` on."""
    elapsed = now - ball.since
    return CurvedPath(
        ball.x + elapsed * (ball.vx + 0.5 * elapsed * ball.ax),
        ball.y + elapsed * (ball.vy + 0.5 * elapsed * ball.ay),
        ball.vx + elapsed * ball.ax,
        ball.vy + elapsed * ball.ay,
        ball.ax,
        ball.ay,
        min(ball.phase_end - now, LONGEST),
        ball.phase == ROLLS,
    )


def time_to_boundary(path: CurvedPath, table: BallTable, ball: Record) -> tuple[float, int]:
    """Return the seconds to the first cushion or pocket while the phase lasts."""
    return time_to_cushions(table.boundary, path, table.radius)


def time_to_cell_edge(
    path: CurvedPath,
    table: BallTable,
    x_low: float,
    x_high: float,
    y_low: float,
    y_high: float,
) -> tuple[float, int, int]:
    """Return the seconds to the edge of the cell, and the step over it."""
    seconds, step_x, step_y = path.lasts, 1, 0
    t = time_over(x_high - path.x, path.vx, path.ax)
    if t < seconds:
        seconds = t
    t = time_over(path.x - x_low, -path.vx, -path.ax)
    if t < seconds:
        seconds, step_x = t, -1
    t = time_over(y_high - path.y, path.vy, path.ay)
    if t < seconds:
        seconds, step_x, step_y = t, 0, 1
    t = time_over(path.y - y_low, -path.vy, -path.ay)
    if t < seconds:
        seconds, step_x, step_y = t, 0, -1
    return (seconds if seconds < path.lasts else np.inf), step_x, step_y


def first_resting_ball(
    path: CurvedPath,
    table: BallTable,
    radius: float,
    lasts: float,
    rows: NDArray[np.float64],
) -> tuple[float, int]:
    """Return the seconds to the first resting ball, and which, of few."""
    if not path.rolls:
        return first_in_rows(path, radius, lasts, rows)
    line = straight(path)
    reach = distance_covered(min(lasts, path.lasts), line.speed, table.roll)
    distance, ball = first_on_path(line, radius, reach, rows)
    if ball < 0:
        return np.inf, ball
    return time_to_cover(distance, line.speed, table.roll), ball


def first_resting_of(
    path: CurvedPath,
    table: BallTable,
    radius: float,
    lasts: float,
    balls: NDArray[np.void],
    listed: NDArray[np.int64],
    count: int,
) -> tuple[float, int]:
    """Return the seconds to the first resting ball, and which, of those listed."""
    return first_of_listed(path, radius, min(lasts, path.lasts), balls, listed, count)


def time_to_resting_ball(
    path: CurvedPath, table: BallTable, dx: float, dy: float, touch: float
) -> float:
    """Return the seconds to a resting ball while the phase lasts."""
    if path.rolls:
        line = straight(path)
        reach = distance_covered(path.lasts, line.speed, table.roll)
        distance = distance_to_resting_ball(dx, dy, line.ux, line.uy, touch, reach)
        return time_to_cover(distance, line.speed, table.roll) if distance < reach else np.inf
    return time_to_place(path, dx, dy, touch, path.lasts)


def relative_motion(path: CurvedPath, table: BallTable, other: CurvedPath) -> RelativeMotion:
    """Return how the ball on path `other` moves relative to that on `path`."""
    return RelativeMotion(
        other.x - path.x,
        other.y - path.y,
        other.vx - path.vx,
        other.vy - path.vy,
        other.ax - path.ax,
        other.ay - path.ay,
    )


def lie_at(ball: Record, table: BallTable, x: float, y: float) -> None:
    """Put a ball at rest to (x, y), m; in a pocket's circle it is out of play."""
    ball.pocket = pocket_at(table.boundary, x, y)
    caught = ball.pocket >= 0
    ball.x, ball.y = (np.inf, np.inf) if caught else (x, y)


def in_play(ball: Record, table: BallTable) -> bool:
    """Return whether a ball is on the cloth."""
    return ball.pocket < 0


def pocket_of(ball: Record, table: BallTable) -> int:
    """Return the number of the pocket in which a ball is, -1 for none."""
    return ball.pocket


def catch(ball: Record, table: BallTable, pocket: int, now: float) -> None:
    """Take a ball out of the play: it is nowhere, so that nothing can touch it."""
    ball.pocket = pocket
    ball.x, ball.y, ball.since = np.inf, np.inf, now
    ball.vx, ball.vy, ball.ax, ball.ay = 0.0, 0.0, 0.0, 0.0
    ball.wx, ball.wy, ball.wz = 0.0, 0.0, 0.0
    ball.phase, ball.phase_end = RESTS, np.inf
    ball.changes += 1


def give_spin(ball: Record, table: BallTable, wx: float, wy: float, wz: float) -> None:
    """Give a ball at rest its spin, rad/s."""
    ball.wx, ball.wy, ball.wz = wx, wy, wz


def log_spin(segment: Record, ball: Record, table: BallTable) -> None:
    """Write down the spin at the start of a segment, and how it changes."""
    segment.wx, segment.wy, segment.wz = ball.wx, ball.wy, ball.wz
    if ball.phase == SLIDES:
        turn = SPIN_PER_PUSH / table.radius
        segment.turn_x, segment.turn_y = turn * ball.ay, -turn * ball.ax
    elif ball.phase == ROLLS:
        segment.turn_x, segment.turn_y = -ball.ay / table.radius, ball.ax / table.radius
    else:
        segment.turn_x, segment.turn_y = 0.0, 0.0
