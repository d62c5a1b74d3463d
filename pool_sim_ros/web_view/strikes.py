"""The latest strike, computed anew: so the pages can show it at any time, at any speed."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Awaitable, Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import REPORT_TIME_SLICE, ShotCancelled, Table, simulate
from pool_sim_ros.web_view.exact import exact_fields
from pool_sim_ros.web_view.motion import LONGEST, event_rows, motion_fields

Layout = NDArray[np.float64]


class Strikes:
    """Computes what was struck, by whomever, and withdraws what the simulator did not play.

    Parameters
    ----------
    tell : callable
        Called with the fields of the latest strike, or with None where there is none.
    time_slice : callable
        Returns the simulator's slice in s.
    """

    def __init__(
        self,
        tell: Callable[[dict[str, Any] | None], None],
        time_slice: Callable[[], Awaitable[float]],
    ) -> None:
        self._tell = tell
        self._time_slice = time_slice
        self._layout: Layout | None = None
        self._cancelled = threading.Event()
        self._id: str | None = None
        self._fields: dict[str, Any] | None = None
        self._ends: dict[str, list[float]] | None = None

    @property
    def start(self) -> Layout | None:
        """Where the balls lay before the latest strike, (n, 2) in m; None if it is not known."""
        return None if self._fields is None else np.array(self._fields['start'])

    def resting(self, positions: Layout) -> None:
        """Note where the balls rest, (n, 2) in m."""
        self._layout = positions

    def forget(self) -> None:
        """Withdraw the latest strike."""
        self._cancelled.set()
        if self._fields is not None:
            self._tell(None)
        self._id = self._fields = self._ends = None

    async def accepted(self, table: Table, response: dict[str, Any]) -> None:
        """Compute the shot of an accepted request, and tell it."""
        self.forget()
        start = self._layout if response['shot'] is None else table.positions
        if start is None or len(start) != len(table.balls):
            return
        request_id, self._id = response['id'], response['id']
        cancelled = self._cancelled = threading.Event()
        time_slice = REPORT_TIME_SLICE
        if response['integrator'] == 'time_slice' and not response['as_printed']:
            time_slice = await self._time_slice()
        fields = await asyncio.to_thread(_play, table, start, response, time_slice, cancelled)
        if fields is not None and self._id == request_id:
            self._fields = fields
            if self._is_played(table):
                self._tell(fields)
            else:
                self.forget()

    def done(self, table: Table, response: dict[str, Any]) -> None:
        """Compare with where the balls really ended."""
        if response['id'] == self._id:
            self._ends = response['final_positions']
            if self._fields is not None and not self._is_played(table):
                self.forget()

    def _is_played(self, table: Table) -> bool:
        """Return whether the balls ended as computed, as far as their ends are known."""
        assert self._fields is not None, 'it was computed'
        if self._ends is None:
            return True
        return self._ends == dict(zip(table.labels, self._fields['ends'], strict=True))


def _play(
    table: Table,
    start: Layout,
    response: dict[str, Any],
    time_slice: float,
    cancelled: threading.Event,
) -> dict[str, Any] | None:
    """Return the fields of a strike; None if it is not to be computed."""
    velocity, spin, integrator = response['velocity'], response.get('spin'), response['integrator']
    try:
        shot = simulate(
            table,
            velocity,
            spins=spin,
            positions=start,
            integrator=integrator,
            time_slice=time_slice,
            until=LONGEST,
            cancelled=cancelled.is_set,
        )
    except (ShotCancelled, ValueError):  # a simulator never accepts what raises a ValueError
        return None
    if not shot.complete:
        return None
    exact = exact_fields(table, response['shot'], shot) if response['as_printed'] else None
    return {
        'id': response['id'],
        'shot': response['shot'],
        'velocity': velocity,
        'spin': spin,
        'integrator': integrator,
        'events': event_rows(shot),
        'exact': exact,
        **motion_fields(shot, start),
    }
