"""What an integrator writes down: its events, and the motions between them."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import inlined


class EventKind(IntEnum):
    """What an event is."""

    BALL_BALL = 0
    CUSHION = 1
    STOP = 2
    POCKETED = 3
    ROLL = 4


# Plain numbers: numba compiles no enumeration of this sort.
BALL_BALL = int(EventKind.BALL_BALL)
CUSHION = int(EventKind.CUSHION)
STOP = int(EventKind.STOP)
POCKETED = int(EventKind.POCKETED)
ROLL = int(EventKind.ROLL)

EVENT = np.dtype(
    [
        ('t', 'f8'),
        ('kind', 'i8'),
        ('a', 'i8'),
        ('b', 'i8'),
        ('x', 'f8'),
        ('y', 'f8'),
        ('nx', 'f8'),
        ('ny', 'f8'),
        ('speed', 'f8'),
    ]
)
"""One contact or stop: see `Trajectory.events`."""

SEGMENT = np.dtype(
    [
        ('ball', 'i8'),
        ('t', 'f8'),
        ('x', 'f8'),
        ('y', 'f8'),
        ('vx', 'f8'),
        ('vy', 'f8'),
        ('ax', 'f8'),
        ('ay', 'f8'),
    ]
)
"""The motion of one ball from `t` on: position in m, velocity in m/s, acceleration in m/s^2."""

SPIN_SEGMENT = np.dtype(
    [
        *((name, SEGMENT[name]) for name in SEGMENT.names or ()),
        ('wx', 'f8'),
        ('wy', 'f8'),
        ('wz', 'f8'),
        ('turn_x', 'f8'),
        ('turn_y', 'f8'),
    ]
)
"""The same, with the spin in rad/s and its change in rad/s^2; that of wz is the table's."""

N_EVENTS, N_SEGMENTS, FIRST_HIT = 0, 1, 2
"""Places in `Log.counts`."""


class Log(NamedTuple):
    """Where the kernels write.

    What finds no room is only counted. Whoever needs it makes room for as much, and plays again.
    Segments are not even counted where there is room for none.
    """

    events: NDArray[np.void]  # of EVENT
    segments: NDArray[np.void]  # of SEGMENT
    counts: NDArray[np.int64]  # events, segments, and the ball that the cue ball hit first


def new_log(events: int, segments: int, of: np.dtype[np.void] = SEGMENT) -> Log:
    """Return a log with room for so many events and segments, `of` this type."""
    log = Log(np.empty(events, EVENT), np.empty(segments, of), np.empty(3, np.int64))
    log.counts[:] = 0, 0, -1
    return log


@inlined
def clear(log: Log) -> None:
    """Forget what is in the log."""
    log.counts[N_EVENTS] = 0
    log.counts[N_SEGMENTS] = 0
    log.counts[FIRST_HIT] = -1


@inlined
def log_event(
    log: Log,
    t: float,
    kind: int,
    sides: tuple[int, int],
    point: tuple[float, float],
    normal: tuple[float, float],
    speed: float,
) -> None:
    """Append one event, in s, m and m/s; `sides` are a and b of EVENT."""
    count = log.counts[N_EVENTS]
    if count < len(log.events):
        event = log.events[count]
        event.t = t
        event.kind = kind
        event.a, event.b = sides
        event.x, event.y = point
        event.nx, event.ny = normal
        event.speed = speed
    log.counts[N_EVENTS] = count + 1


@inlined
def log_segment(
    log: Log,
    ball: int,
    t: float,
    position: tuple[float, float],
    velocity: tuple[float, float],
    acceleration: tuple[float, float],
) -> int:
    """Append the motion that `ball` begins at `t`, in s, m, m/s and m/s^2.

    Returns its number, -1 where there was no room for it.
    """
    if len(log.segments) == 0:
        return -1
    count = log.counts[N_SEGMENTS]
    if count < len(log.segments):
        segment = log.segments[count]
        segment.ball = ball
        segment.t = t
        segment.x, segment.y = position
        segment.vx, segment.vy = velocity
        segment.ax, segment.ay = acceleration
    log.counts[N_SEGMENTS] = count + 1
    return count if count < len(log.segments) else -1


@inlined
def log_hit(log: Log, a: int, b: int, cue_ball: int) -> None:
    """Note which ball the cue ball hits first, where balls `a` and `b` touch."""
    if log.counts[FIRST_HIT] < 0:
        if a == cue_ball:
            log.counts[FIRST_HIT] = b
        elif b == cue_ball:
            log.counts[FIRST_HIT] = a
