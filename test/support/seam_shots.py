"""Shots that are played through the engine's own kernels, on tables that only a test knows."""

import math
from typing import NamedTuple

import numba
import numpy as np
from one_shot import play_one

from pool_sim_ros.physics.event_driven.state import new_state, start_of
from pool_sim_ros.physics.log import N_EVENTS, N_SEGMENTS, new_log
from pool_sim_ros.physics.outcomes import PLAYED


class PlayedShot(NamedTuple):
    """As `Trajectory` has it."""

    final_positions: np.ndarray
    final_velocities: np.ndarray
    duration: float
    complete: bool
    events: np.ndarray
    segments: np.ndarray


def play_on(table, records, velocities, until=math.inf, room=5000):
    """Play a shot on the kernels' table, of balls at rest that get velocities, (n or 1, 2) m/s."""
    records = as_records(records)
    state = as_records(new_state(table, records, new_log(room, room)))
    layout = np.column_stack([records['x'], records['y']])
    ends = np.empty((2, len(records), 2))
    velocities = np.array(velocities, dtype=float).reshape(-1, 2)
    failed, duration, complete, *_ = play_one(
        state, start_of(state), velocities, layout, (until, room), ends
    )
    assert failed == PLAYED
    log = state.log
    return PlayedShot(
        *ends,
        duration,
        complete,
        log.events[: log.counts[N_EVENTS]],
        log.segments[: log.counts[N_SEGMENTS]],
    )


def as_records(arrays):
    """Return arrays whose records have their fields as attributes, where nothing is compiled."""
    if isinstance(arrays, tuple):
        return type(arrays)(*map(as_records, arrays))
    if numba.config.DISABLE_JIT and isinstance(arrays, np.ndarray) and arrays.dtype.names:
        return arrays.view(np.recarray)
    return arrays
