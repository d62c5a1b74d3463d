"""One shot, or many one after another, in a single call into compiled code."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_driven.engine import finish, run, strike
from pool_sim_ros.physics.event_driven.layout import place
from pool_sim_ros.physics.event_driven.state import (
    Start,
    State,
    reset,
)
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.log import FIRST_HIT, N_EVENTS, N_SEGMENTS
from pool_sim_ros.physics.outcomes import BAD_LAYOUT, BAD_VELOCITY, PLAYED, RUNS_AWAY, Ends
from pool_sim_ros.physics.tolerances import MAX_SPEED

FIRST_ROOM = 64
"""Events beyond one a ball for which a log has room at first; most shots have fewer."""


@inlined
def play(
    state: State,
    start: Start,
    velocities: NDArray[np.float64],
    layout: NDArray[np.float64],
    whole: bool,
    limits: tuple[float, int],
    ends: tuple[NDArray[np.float64], NDArray[np.float64]],
) -> tuple[int, float, bool]:
    """Play one shot from a layout, (n, 2) in m; from the start, where the layout has no rows.

    The start must be made `whole` where the state is not known to have been played from it last.

    `limits` are the end of the clock in s and the most events, `ends` the final positions and
    velocities. Returns how it ended, the duration in s and whether all balls rest.
    """
    until, max_events = limits
    reset(state, start, whole)
    if len(layout) > 0 and not place(state, start, layout):
        return BAD_LAYOUT, np.nan, False
    most = strike(state, velocities)
    failed = run(state, until, most, max_events)
    duration, complete, lost = finish(state, until, most, ends[0], ends[1])
    if failed == PLAYED and lost:
        failed = RUNS_AWAY
    return failed, duration, complete


@kernel
def play_one(
    state: State,
    start: Start,
    velocities: NDArray[np.float64],
    layout: NDArray[np.float64],
    limits: tuple[float, int],
    ends: NDArray[np.float64],
) -> tuple[int, float, bool, int, int]:
    """Play one shot as `play` does; `ends` is (2, n, 2).

    Returns how it ended, the duration in s, whether all balls rest, and how many events and
    segments it has.
    """
    for i in range(len(velocities)):
        # Written so that NaN is refused too.
        if not (abs(velocities[i, 0]) <= MAX_SPEED and abs(velocities[i, 1]) <= MAX_SPEED):
            return BAD_VELOCITY, np.nan, False, 0, 0
    failed, duration, complete = play(
        state, start, velocities, layout, False, limits, (ends[0], ends[1])
    )
    counts = state.log.counts
    return failed, duration, complete, counts[N_EVENTS], counts[N_SEGMENTS]


@kernel
def play_some(
    state: State,
    start: Start,
    shots: tuple[NDArray[np.float64], NDArray[np.float64]],
    begun: tuple[int, int],
    limits: tuple[float, int],
    ends: tuple[Ends, NDArray[np.float64], NDArray[np.void]],
) -> tuple[int, int]:
    """Play shots until one has more events than find room.

    Parameters
    ----------
    state, start
    shots : tuple of ndarray
        Velocities, (m, n or 1, 2), and layouts, (m, n, 2); with (m, 0, 2) all begin at the start.
    begun : tuple of int
        How many were played before, and how many events are in the room already.
    limits : tuple
        As in `play`.
    ends : tuple
        Of the shots; room for final velocities, (n, 2); room for all events.

    Returns
    -------
    done, filled : int
        The same afterwards.
    """
    velocities, layouts = shots
    until, max_events = limits
    results, final_velocities, events = ends
    log = state.log
    wanted = len(log.events) > 0
    first, filled = begun
    for shot in range(first, len(velocities)):
        failed, duration, _ = play(
            state,
            start,
            velocities[shot],
            layouts[shot],
            shot == first,
            limits,
            (results.finals[shot], final_velocities),
        )
        count = log.counts[N_EVENTS]
        if wanted and failed == PLAYED:
            if count > len(log.events) or filled + count > len(events):
                return shot, filled
            for k in range(count):
                events[filled + k] = log.events[k]
            filled += count
        results.durations[shot] = duration
        results.event_counts[shot] = count
        results.first_hit[shot] = log.counts[FIRST_HIT]
        results.failed[shot] = failed
        if failed != PLAYED:
            mark(results, shot)
    return len(velocities), filled


@kernel
def mark(ends: Ends, shot: int) -> None:
    """Leave NaN and -1 where a shot failed."""
    ends.durations[shot] = np.nan
    ends.event_counts[shot] = ends.first_hit[shot] = -1
    for i in range(ends.finals.shape[1]):
        ends.finals[shot, i, 0] = ends.finals[shot, i, 1] = np.nan
