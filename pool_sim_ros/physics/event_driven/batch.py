"""Shots one after another, in a single call into compiled code."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_driven.engine import finish, run, strike
from pool_sim_ros.physics.event_driven.layout import place
from pool_sim_ros.physics.event_driven.state import Start, State, reset
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.log import FIRST_HIT, N_EVENTS
from pool_sim_ros.physics.motion import in_play, pocket_of
from pool_sim_ros.physics.outcomes import BAD_LAYOUT, BAD_VELOCITY, PLAYED, RUNS_AWAY, Ends
from pool_sim_ros.physics.tolerances import MAX_SPEED

FIRST_ROOM = 64
"""Events beyond one a ball for which a log has room at first; most shots have fewer."""


@kernel
def play_some(
    state: State,
    start: Start,
    shots: tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]],
    begun: tuple[int, int],
    limits: tuple[float, int],
    ends: tuple[Ends, NDArray[np.float64], NDArray[np.void]],
) -> tuple[int, int, bool]:
    """Play shots until one has more events than find room.

    Whoever plays one shot calls this too: to compile the engine twice takes seconds.

    Parameters
    ----------
    state, start
    shots : tuple of ndarray
        Velocities, (m, n or 1, 2); spins, (m, n, 1 or 0, 3); and layouts, (m, n or 0, 2): without
        any all begin at the start.
    begun : tuple of int
        How many were played before, and how many events are in the room already.
    limits : tuple
        End of the clock, s, and most events of a shot.
    ends : tuple
        Of the shots; room for the final velocities of one, (n, 2) in m/s; room for all events,
        none where they are not wanted.

    Returns
    -------
    done, filled : int
        As `begun`, afterwards.
    complete : bool
        Whether all balls rested at the end of the last shot.
    """
    velocities, spins, layouts = shots
    until, max_events = limits
    results, final_velocities, events = ends
    log = state.log
    first, filled = begun
    complete = False
    for shot in range(first, len(velocities)):
        # What was played last from this state may not be known: all is put back before the first.
        reset(state, start, shot == first)
        failed, duration, complete = PLAYED, np.nan, False
        if any_too_fast(velocities[shot]):
            failed = BAD_VELOCITY
        elif layouts.shape[1] > 0 and not place(state, start, layouts[shot]):
            failed = BAD_LAYOUT
        elif any_out_of_play(state, velocities[shot]) or any_out_of_play(state, spins[shot]):
            failed = BAD_LAYOUT
        else:
            most = strike(state, velocities[shot], spins[shot])
            failed = run(state, until, most, max_events)
            duration, complete, lost = finish(
                state, until, most, results.finals[shot], final_velocities
            )
            if failed == PLAYED and lost:
                failed = RUNS_AWAY
        count = log.counts[N_EVENTS]
        if len(events) > 0 and failed == PLAYED:
            if count > len(log.events) or filled + count > len(events):
                return shot, filled, complete
            for k in range(count):
                events[filled + k] = log.events[k]
            filled += count
        results.durations[shot] = duration
        results.event_counts[shot] = count
        results.first_hit[shot] = log.counts[FIRST_HIT]
        results.failed[shot] = failed
        for i in range(results.pocketed.shape[1]):
            results.pocketed[shot, i] = pocket_of(state.balls[i], state.table)
        if failed != PLAYED:
            mark(results, shot)
    return len(velocities), filled, complete


@inlined
def any_too_fast(velocities: NDArray[np.float64]) -> bool:
    """Return whether a component, of (k, 2) in m/s, is above MAX_SPEED or not a number."""
    for i in range(len(velocities)):
        # Written so that NaN is refused too.
        if not (abs(velocities[i, 0]) <= MAX_SPEED and abs(velocities[i, 1]) <= MAX_SPEED):
            return True
    return False


@inlined
def any_out_of_play(state: State, given: NDArray[np.float64]) -> bool:
    """Return whether a ball that gets a velocity or a spin, (k, 2 or 3), lies in a pocket."""
    for i in range(len(given)):
        if not in_play(state.balls[i], state.table):
            for k in range(given.shape[1]):
                if given[i, k] != 0.0:
                    return True
    return False


@kernel
def mark(ends: Ends, shot: int) -> None:
    """Leave NaN and -1 where a shot failed."""
    ends.durations[shot] = np.nan
    ends.event_counts[shot] = ends.first_hit[shot] = -1
    for i in range(ends.finals.shape[1]):
        ends.finals[shot, i, 0] = ends.finals[shot, i, 1] = np.nan
    for i in range(ends.pocketed.shape[1]):
        ends.pocketed[shot, i] = -1
