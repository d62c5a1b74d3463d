"""Many shots, part by part, in one of several threads."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_driven.batch import FIRST_ROOM, play_some
from pool_sim_ros.physics.event_driven.state import types_of
from pool_sim_ros.physics.event_driven.work_area import NO_EVENTS, work_area
from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.jit import call_directly
from pool_sim_ros.physics.log import EVENT, N_EVENTS
from pool_sim_ros.physics.outcomes import Ends
from pool_sim_ros.physics.table import Table

EVENTS_A_SHOT = 32
"""Events a shot for which there is room at first; what is not used costs no memory."""


def play_parts(
    table: Table,
    layout: NDArray[np.float64] | None,
    shots: tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]],
    limits: tuple[float, int],
    ends: Ends,
    parts: Iterator[slice],
    store: EventStore | None,
    tell: Callable[[int], None],
) -> None:
    """Play those of many shots that are in `parts`, and fill in their ends.

    Parameters
    ----------
    table : Table
    layout : ndarray of shape (n, 2) or None
        Where the balls start in all shots instead of their own places, m.
    shots : tuple of ndarray
        Velocities, spins and layouts, as `play_some` takes them.
    limits : tuple
        End of the clock, s, and most events.
    ends : Ends
        Of all shots.
    parts : iterator of slice
        Other threads may take from it too.
    store : EventStore or None
        Where to put the events of each part, where they are wanted.
    tell : callable
        Called with the number of shots of each part that was played.
    """
    n = len(table.balls)
    area = work_area(table, layout)
    state = area.silent if store is None else area.logging(FIRST_ROOM + n)
    final_velocities = np.empty((n, 2))
    for part in parts:
        count, done, filled = part.stop - part.start, 0, 0
        given, own = shots, ends
        if count < len(shots[0]):
            given, own = (shots[0][part], shots[1][part], shots[2][part]), ends.part(part)
        room = NO_EVENTS if store is None else store.room(EVENTS_A_SHOT * count)
        while done < count:
            done, filled, _ = call_directly(
                play_some,
                types_of(state),
                state,
                area.start,
                given,
                (done, filled),
                limits,
                (own, final_velocities, room),
            )
            if done < count:
                needed = int(state.log.counts[N_EVENTS])
                if needed > len(state.log.events):
                    state = area.logging(2 * needed)
                else:
                    room = np.concatenate([room[:filled], np.empty(len(room) + needed, EVENT)])
        if store is not None:
            store.put(part.start, part.stop, room, filled)
        tell(count)
