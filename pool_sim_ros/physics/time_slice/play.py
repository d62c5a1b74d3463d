"""The loop over the slices (Listing 2), and the shots that are played with it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import cast

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.jit import kernel
from pool_sim_ros.physics.log import (
    N_EVENTS,
    STOP,
    Log,
    log_event,
    new_log,
)
from pool_sim_ros.physics.motion import DiscTable
from pool_sim_ros.physics.outcomes import (
    BAD_LAYOUT,
    NO_POCKETED,
    PLAYED,
    RUNS_AWAY,
    TOO_MANY_EVENTS,
    Ends,
    Shot,
    ShotCancelled,
)
from pool_sim_ros.physics.runaway import most_energy
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.time_slice.listing import meet_balls, meet_cushions, move
from pool_sim_ros.physics.time_slice.slices import Slices, log_motion, log_start
from pool_sim_ros.physics.validation import is_bad

FIRST_ROOM = 1024
"""Events for which a log has room at first."""

SLICES_A_CALL = 200_000_000
"""Slices, times the balls squared and 100, between two looks at whether a shot is cancelled: about
0.1 s, where a call takes 0.2 ms."""

FEWEST_SLICES_A_CALL = 100
"""The same at the least: on a table of many balls a call must not cost more than its slices."""


def play(
    table: Table,
    layout: NDArray[np.float64] | None,
    velocities: NDArray[np.float64],
    step: float,
    limits: tuple[float, int],
    cancelled: Callable[[], bool] | None = None,
) -> Shot:
    """Play one shot in slices of `step` s; see `simulate`, which checks what it is given."""
    log = new_log(FIRST_ROOM, FIRST_ROOM)
    return _play(table, layout, table.positions, velocities, step, limits, log, cancelled)


def play_parts(
    table: Table,
    at_rest: NDArray[np.void],
    shots: tuple[NDArray[np.float64], NDArray[np.float64]],
    step: float,
    limits: tuple[float, int],
    ends: Ends,
    parts: Iterator[slice],
    store: EventStore | None,
    tell: Callable[[int], None],
) -> None:
    """Play the shots in `parts` and fill in their ends; see `event_driven.play_parts`."""
    start = np.column_stack([at_rest['x'], at_rest['y']])
    for part in parts:
        for i in range(part.start, part.stop):
            log = new_log(0, 0) if store is None else new_log(FIRST_ROOM, FIRST_ROOM)
            shot = _play(table, shots[1][i], start, shots[0][i], step, limits, log)
            played = shot.failed == PLAYED
            ends.finals[i] = shot.final_positions if played else np.nan
            ends.durations[i] = shot.duration
            ends.event_counts[i] = shot.n_events if played else -1
            ends.first_hit[i] = shot.first_hit if played else -1
            ends.failed[i] = shot.failed
            if store is not None:
                store.put(i, i + 1, shot.events, len(shot.events) if played else 0)
            tell(1)


def _play(
    table: Table,
    layout: NDArray[np.float64] | None,
    at_rest: NDArray[np.float64],
    velocities: NDArray[np.float64],
    step: float,
    limits: tuple[float, int],
    log: Log,
    cancelled: Callable[[], bool] | None = None,
) -> Shot:
    """Play one shot, and again where the log had too little room, unless it has none."""
    start = at_rest if layout is None or not len(layout) else layout
    if start is layout and is_bad(table, layout):
        nowhere = np.full(start.shape, np.nan)
        nothing = log.events[:0], log.segments[:0]
        return Shot(BAD_LAYOUT, math.nan, False, nowhere, nowhere, *nothing, NO_POCKETED, 0, -1)
    until, max_events = limits
    while True:
        state = new_state(table, start, velocities, step, log)
        failed = run_unless(cancelled, state, last_slice(until, step), max_events)
        events, segments, first_hit = log.counts.tolist()
        if len(log.events) == 0 or (events <= len(log.events) and segments <= len(log.segments)):
            break
        log = new_log(2 * events, 2 * segments)
    complete = not state.v.any()
    duration = float(state.clock[0] * step) if complete else until
    if failed:
        duration = math.nan
    found = log.segments[:segments]
    return Shot(
        failed,
        duration,
        complete,
        state.x,
        state.v,
        log.events[:events],
        # A ball rests within the slice in which it stops: maybe before what is written above it.
        found[np.argsort(found['t'], kind='stable')],
        NO_POCKETED,
        events,
        first_hit,
    )


def last_slice(until: float, step: float) -> int:
    """Return the slice nearest to `until`."""
    return round(min(until / step, 1e18))


def new_state(
    table: Table,
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64],
    step: float,
    log: Log,
) -> Slices:
    """Return the loop before its first slice, in which every ball and every pair is looked at."""
    n = len(positions)
    pairs = n * (n - 1) // 2
    v = np.zeros((n, 2))
    v[: len(velocities)] = velocities
    log.counts[:] = 0, 0, -1
    state = Slices(
        # `shot_inputs` lets no other tables through.
        table=cast(DiscTable, table.for_kernels),
        balls=table.balls_at_rest,
        mass=table.masses,
        x=np.array(positions),
        v=v,
        colliding=np.zeros(pairs, np.bool_),
        due=np.ones(pairs, np.int64),
        moving=np.ones(n, np.bool_),
        changed=np.zeros(n, np.bool_),
        rest=np.zeros((n, 3)),
        clock=np.array([0, 1], np.int64),
        step=step,
        loss=step * table.mu_ball_surface * table.gravity,
        most=most_energy(table.balls_at_rest, table.for_kernels, velocities),
        log=log,
    )
    log_start(state)
    return state


def run_unless(
    cancelled: Callable[[], bool] | None, state: Slices, last: int, max_events: int
) -> int:
    """Do as `run`, part by part where somebody may cancel the shot; raise ShotCancelled then."""
    if cancelled is None:
        return run(state, last, max_events)
    part = max(SLICES_A_CALL // (len(state.balls) ** 2 + 100), FEWEST_SLICES_A_CALL)
    while not cancelled():
        end = min(int(state.clock[0]) + part, last)
        failed: int = run(state, end, max_events)
        if failed or end == last or not state.v.any():
            return failed
    raise ShotCancelled('the shot was cancelled')


@kernel
def run(state: Slices, last: int, max_events: int) -> int:
    """Take slices until all rest or `last` is done; return how it ended, as `Outcomes.failed`."""
    n = len(state.balls)
    log = state.log
    while state.clock[0] < last and anything_moves(state):
        if log.counts[N_EVENTS] > max_events:
            return TOO_MANY_EVENTS
        state.clock[0] += 1
        now = state.clock[0] * state.step
        for i in range(n):
            if state.moving[i]:
                was_moving = state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0
                move(state, i)
                if was_moving and state.v[i, 0] == 0.0 and state.v[i, 1] == 0.0:
                    state.changed[i] = True
                    position = state.x[i, 0], state.x[i, 1]
                    log_event(log, now, STOP, (i, -1), position, (0.0, 0.0), 0.0)
        for i in range(n):
            if state.moving[i]:
                meet_cushions(state, i, now)
        if state.clock[1] <= state.clock[0]:
            meet_balls(state, now)
        lost = False
        for i in range(n):
            if state.changed[i]:
                state.changed[i] = False
                speed = math.sqrt(state.v[i, 0] * state.v[i, 0] + state.v[i, 1] * state.v[i, 1])
                lost |= speed * speed > state.most * state.balls[i].inverse_mass
                log_motion(state, i, now)
            state.moving[i] = state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0
        if lost:
            return RUNS_AWAY
    return TOO_MANY_EVENTS if log.counts[N_EVENTS] > max_events else PLAYED


@kernel
def anything_moves(state: Slices) -> bool:
    """Return whether any ball has a velocity."""
    for i in range(len(state.v)):
        if state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0:
            return True
    return False
