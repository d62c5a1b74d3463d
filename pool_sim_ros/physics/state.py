"""What an integrator writes down: its events and the motions between them."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from pool_sim_ros.physics.jit import inlined


class EventKind(IntEnum):
    """What an event is."""

    BALL_BALL = 0
    CUSHION = 1
    STOP = 2


# Plain numbers, since numba compiles no enumeration.
BALL_BALL, CUSHION, STOPPED = (int(kind) for kind in EventKind)

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
        ('ux', 'f8'),
        ('uy', 'f8'),
        ('speed', 'f8'),
    ]
)
"""The motion of one ball from `t` on: place in m, unit direction, speed in m/s."""


class Log(NamedTuple):
    """Where the kernels write; `counts` holds how many events and segments there are."""

    events: np.ndarray
    segments: np.ndarray
    counts: np.ndarray
    wanted: bool


def new_log(events: int, segments: int, wanted: bool = True) -> Log:
    """Return an empty log with room for so many events and segments."""
    return Log(np.empty(events, EVENT), np.empty(segments, SEGMENT), np.zeros(2, np.int64), wanted)


def enlarged(log: Log) -> Log:
    """Return the log with twice the room."""
    events, segments, counts, wanted = log
    return Log(
        np.concatenate([events, np.empty_like(events)]),
        np.concatenate([segments, np.empty_like(segments)]),
        counts,
        wanted,
    )


@inlined
def has_room(log, events, segments):
    """Return whether so many more events and segments fit."""
    return not log.wanted or (
        log.counts[0] + events <= len(log.events) and log.counts[1] + segments <= len(log.segments)
    )


@inlined
def log_event(log, t, kind, a, b, x, y, nx, ny, speed):
    """Append one event; without `wanted`, only count it."""
    if log.wanted:
        event = log.events[log.counts[0]]
        event.t = t
        event.kind = kind
        event.a = a
        event.b = b
        event.x = x
        event.y = y
        event.nx = nx
        event.ny = ny
        event.speed = speed
    log.counts[0] += 1


@inlined
def log_segment(log, ball, t, x, y, ux, uy, speed):
    """Append the motion that `ball` begins at `t`."""
    if log.wanted:
        segment = log.segments[log.counts[1]]
        segment.ball = ball
        segment.t = t
        segment.x = x
        segment.y = y
        segment.ux = ux
        segment.uy = uy
        segment.speed = speed
        log.counts[1] += 1
