"""Many shots, part by part, in one of several threads."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_driven.batch import FIRST_ROOM, play_some
from pool_sim_ros.physics.event_driven.false_sharing import own_lines
from pool_sim_ros.physics.event_driven.state import new_state, start_of, types_of
from pool_sim_ros.physics.event_driven.work_area import NO_EVENTS, work_area
from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.jit import call_directly
from pool_sim_ros.physics.log import EVENT, N_EVENTS, new_log
from pool_sim_ros.physics.outcomes import Ends
from pool_sim_ros.physics.table import Table

EVENTS_A_SHOT = 32
"""Events a shot for which there is room at first; what is not used costs no memory."""


def play_parts(
    table: Table,
    at_rest: NDArray[np.void],
    shots: tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]],
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
        Velocities, spins and layouts, as `play_some` takes them.
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
    if store is None and at_rest is table.balls_at_rest:
        area = work_area(table)
        state, start = area.silent, area.start
    else:
        log = new_log(0 if store is None else FIRST_ROOM + n, 0, table.segment_type)
        state = new_state(table.for_kernels, at_rest, log)
        start = start_of(state)
        if shared:
            state = own_lines(state)
    final_velocities = np.empty((n, 2))
    for part in parts:
        velocities, spins, layouts = (array[part] for array in shots)
        own = ends.part(part)
        count, done, filled = len(velocities), 0, 0
        room = NO_EVENTS if store is None else store.room(EVENTS_A_SHOT * count)
        while done < count:
            done, filled, _ = call_directly(
                play_some,
                types_of(state),
                state,
                start,
                (velocities, spins, layouts),
                (done, filled),
                limits,
                (own, final_velocities, room),
            )
            if done < count:
                needed = int(state.log.counts[N_EVENTS])
                if needed > len(state.log.events):
                    state = state._replace(log=new_log(2 * needed, 0, table.segment_type))
                else:
                    room = np.concatenate([room[:filled], np.empty(len(room) + needed, EVENT)])
        if store is not None:
            store.put(part.start, part.stop, room, filled)
        tell(count)
