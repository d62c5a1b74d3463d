"""One shot, or many one after another, in a single call into compiled code."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_driven.engine import finish, run, strike
from pool_sim_ros.physics.event_driven.false_sharing import own_lines
from pool_sim_ros.physics.event_driven.layout import place
from pool_sim_ros.physics.event_driven.state import (
    Start,
    State,
    copied,
    new_state,
    reset,
    start_of,
)
from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.jit import call_directly, inlined, kernel
from pool_sim_ros.physics.log import EVENT, FIRST_HIT, N_EVENTS, N_SEGMENTS, new_log
from pool_sim_ros.physics.outcomes import BAD_LAYOUT, BAD_VELOCITY, PLAYED, RUNS_AWAY, Ends, Shot
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import MAX_SPEED

FIRST_ROOM = 64
"""Events beyond one a ball for which a log has room at first; most shots have fewer."""

KEPT_BALLS = 1000
"""Balls up to which the working area of `play_one` is kept for the next shot: about 0.5 MB."""

EVENTS_A_SHOT = 32
"""Events a shot for which there is room at first; what is not used costs no memory."""

NO_EVENTS = np.empty(0, EVENT)


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


class WorkArea:
    """What is needed to play shots on one table, kept from shot to shot; for one thread.

    Parameters
    ----------
    table : Table
    """

    def __init__(self, table: Table) -> None:
        self.table = table
        n = len(table.balls)
        log = new_log(FIRST_ROOM + n, FIRST_ROOM + 2 * n)
        self.state = new_state(table.for_kernels, table.balls_at_rest, log)
        self.start = start_of(self.state)
        self._own_layout = np.array(table.positions)

    def play(
        self,
        velocities: NDArray[np.float64],
        layout: NDArray[np.float64] | None,
        limits: tuple[float, int],
    ) -> Shot:
        """Play one shot and keep all of it.

        Parameters
        ----------
        velocities : ndarray of shape (n or 1, 2)
            m/s.
        layout : ndarray of shape (n, 2)
            m; None for the balls' own places.
        limits : tuple of float and int
            End of the clock, s, and most events.
        """
        # Always a layout: `reset` leaves balls where they are that nothing has moved.
        layout = self._own_layout if layout is None else layout
        ends = np.empty((2, len(self.table.balls), 2))
        while True:
            failed, duration, complete, n_events, n_segments = call_directly(
                play_one,
                type(self.state.table),
                self.state,
                self.start,
                velocities,
                layout,
                limits,
                ends,
            )
            log = self.state.log
            if n_events <= len(log.events) and n_segments <= len(log.segments):
                break
            self.state = self.state._replace(log=new_log(2 * n_events, 2 * n_segments))
        events, segments = copied(log.events[:n_events]), copied(log.segments[:n_segments])
        first_hit = int(log.counts[FIRST_HIT])
        return Shot(
            failed, duration, complete, ends[0], ends[1], events, segments, n_events, first_hit
        )


def work_area(table: Table) -> WorkArea:
    """Return the calling thread's work area for a table, kept for the next shot on it."""
    kept = getattr(_kept, 'area', None)
    if kept is not None and kept.table is table:
        return kept
    area = WorkArea(table)
    _kept.area = area if len(table.balls) <= KEPT_BALLS else None
    return area


_kept = threading.local()


def play_parts(
    table: Table,
    at_rest: NDArray[np.void],
    shots: tuple[NDArray[np.float64], NDArray[np.float64]],
    limits: tuple[float, int],
    ends: Ends,
    parts: Iterator[slice],
    shared: bool,
    store: EventStore | None,
    tell: Callable[[int], None],
) -> None:
    """Play those of many shots that are in `parts`, and fill in their ends.

    Parameters
    ----------
    table : Table
    at_rest : ndarray
        The kernels' records of the balls where they start.
    shots : tuple of ndarray
        Velocities and layouts, as `play_some` takes them.
    limits : tuple
        End of the clock, s, and most events.
    ends : Ends
        Of all shots.
    parts : iterator of slice
        May be `shared` with other threads, each of which takes parts too.
    store : EventStore or None
        Where to put the events of each part, where they are wanted.
    tell : callable
        Called with the number of shots of each part that was played.
    """
    n = len(table.balls)
    log = new_log(0 if store is None else FIRST_ROOM + n, 0)
    if shared or at_rest is not table.balls_at_rest:
        state = new_state(table.for_kernels, at_rest, log)
        start = start_of(state)
    else:
        area = work_area(table)
        state, start = area.state._replace(log=log), area.start
    if shared:
        state = own_lines(state)
    final_velocities = np.empty((n, 2))
    for part in parts:
        velocities, layouts = (array[part] for array in shots)
        own = ends.part(part)
        count, done, filled = len(velocities), 0, 0
        room = NO_EVENTS if store is None else store.room(EVENTS_A_SHOT * count)
        while done < count:
            done, filled = call_directly(
                play_some,
                type(state.table),
                state,
                start,
                (velocities, layouts),
                (done, filled),
                limits,
                (own, final_velocities, room),
            )
            if done < count:
                needed = int(state.log.counts[N_EVENTS])
                if needed > len(state.log.events):
                    state = state._replace(log=new_log(2 * needed, 0))
                else:
                    room = np.concatenate([room[:filled], np.empty(len(room) + needed, EVENT)])
        if store is not None:
            store.put(part.start, part.stop, room, filled)
        tell(count)
