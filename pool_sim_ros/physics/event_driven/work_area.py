"""What is needed to play shots on one table, kept from shot to shot."""

from __future__ import annotations

import threading
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_driven.batch import FIRST_ROOM, play_some
from pool_sim_ros.physics.event_driven.false_sharing import own_lines
from pool_sim_ros.physics.event_driven.state import (
    State,
    copied,
    new_state,
    start_of,
    types_of,
)
from pool_sim_ros.physics.jit import call_directly
from pool_sim_ros.physics.log import EVENT, new_log
from pool_sim_ros.physics.outcomes import NO_POCKETED, Ends, Shot
from pool_sim_ros.physics.table import Table

NO_EVENTS = np.empty(0, EVENT)
NO_LAYOUT = np.empty((1, 0, 2))
NONE_PLAYED = (0, 0)

KEPT_BALLS = 1000
"""Balls up to which a work area is kept for the next shot: about 0.5 MB."""


class WorkArea:
    """What is needed to play shots on one table, kept from shot to shot; for one thread.

    Parameters
    ----------
    table : Table
    layout : ndarray of shape (n, 2), optional
        Where the balls rest instead of their own places, m; a valid one.
    """

    def __init__(self, table: Table, layout: NDArray[np.float64] | None = None) -> None:
        self.table = table
        self._layout = None if layout is None else layout.tobytes()
        at_rest = table.balls_at_rest if layout is None else table.records_at(layout)
        n = len(table.balls)
        log = new_log(FIRST_ROOM + n, FIRST_ROOM + 2 * n, table.segment_type)
        self.state = new_state(table.for_kernels, at_rest, log)
        self.start = start_of(self.state)
        self._duration, self._failed = np.empty(1), np.empty(1, np.int8)
        self._numbers = np.empty(1, np.int64), np.empty(1, np.int64)
        self._types = types_of(self.state)
        self._pockets = len(table.pockets) > 0
        self._segment_type = table.segment_type

    def is_for(self, table: Table, layout: NDArray[np.float64] | None) -> bool:
        """Return whether it is one for this table, with the balls there."""
        if self.table is not table:
            return False
        return self._layout == (None if layout is None else layout.tobytes())

    @cached_property
    def silent(self) -> State:
        """The state for shots of which nothing is logged; no other thread writes near it.

        The arrays of many balls are not copied for that: hardly any of their lines are shared.
        """
        silent = self.state._replace(log=new_log(0, 0, self._segment_type))
        return own_lines(silent) if len(self.table.balls) <= KEPT_BALLS else silent

    def logging(self, events: int) -> State:
        """Return the same with room for so many events."""
        return self.silent._replace(log=own_lines(new_log(events, 0, self._segment_type)))

    def play(
        self,
        velocities: NDArray[np.float64],
        spins: NDArray[np.float64],
        layout: NDArray[np.float64] | None,
        limits: tuple[float, int],
    ) -> Shot:
        """Play one shot and keep all of it.

        Parameters
        ----------
        velocities : ndarray of shape (n or 1, 2)
            m/s.
        spins : ndarray of shape (n, 1 or 0, 3)
            rad/s.
        layout : ndarray of shape (n, 2)
            m; None for the balls' own places.
        limits : tuple of float and int
            End of the clock, s, and most events.
        """
        layouts = NO_LAYOUT if layout is None else layout[np.newaxis]
        n = len(self.table.balls)
        finals, final_velocities = np.empty((1, n, 2)), np.empty((n, 2))
        pocketed = np.empty((1, n), np.int64) if self._pockets else NO_POCKETED
        event_counts, first_hits = self._numbers
        ends = Ends(finals, self._duration, event_counts, pocketed, first_hits, self._failed)
        shots, room = (
            (velocities[np.newaxis], spins[np.newaxis], layouts),
            (ends, final_velocities, NO_EVENTS),
        )
        while True:
            _, _, complete = call_directly(
                play_some, self._types, self.state, self.start, shots, NONE_PLAYED, limits, room
            )
            log = self.state.log
            n_events, n_segments, first_hit = log.counts.tolist()
            if n_events <= len(log.events) and n_segments <= len(log.segments):
                break
            self.state = self.state._replace(
                log=new_log(2 * n_events, 2 * n_segments, self._segment_type)
            )
        return Shot(
            self._failed.item(),
            self._duration.item(),
            complete,
            finals[0],
            final_velocities,
            copied(log.events[:n_events]),
            copied(log.segments[:n_segments]),
            pocketed[0] if self._pockets else NO_POCKETED,
            n_events,
            first_hit,
        )


def work_area(table: Table, layout: NDArray[np.float64] | None = None) -> WorkArea:
    """Return the calling thread's work area for a table, kept for the next shot on it.

    One is kept for the balls' own places, and one for the latest other `layout`.
    """
    name = 'own' if layout is None else 'other'
    kept: WorkArea | None = getattr(_kept, name, None)
    if kept is not None and kept.is_for(table, layout):
        return kept
    area = WorkArea(table, layout)
    setattr(_kept, name, area if len(table.balls) <= KEPT_BALLS else None)
    return area


_kept = threading.local()
