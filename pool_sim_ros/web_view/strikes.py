"""The latest strike, computed anew: so the pages can show it at any time, at any speed."""

from __future__ import annotations

import asyncio
import threading
import time
from collections import deque
from collections.abc import Awaitable, Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import REPORT_TIME_SLICE, ShotCancelled, Table, simulate
from pool_sim_ros.web_view.exact import exact_fields
from pool_sim_ros.web_view.motion import LONGEST, event_rows, motion_fields

Layout = NDArray[np.float64]

STILL = 0.1
"""Seconds without a new frame after which the balls rest where the last one showed them: a paused
simulator sends one."""

RECENT = 8
"""Frames that are kept, to find the one from which a shot really began."""


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
        self._seen: deque[tuple[float, Layout]] = deque(maxlen=RECENT)
        self._since = 0.0
        self._before: list[tuple[float, Layout]] = []
        self._cancelled = threading.Event()
        self._id: str | None = None
        self._fields: dict[str, Any] | None = None
        self._done: dict[str, Any] | None = None
        self._response: dict[str, Any] | None = None

    @property
    def start(self) -> Layout | None:
        """Where the balls lay before the latest strike, (n, 2) in m; None if it is not known."""
        return None if self._fields is None else np.array(self._fields['start'])

    def saw(self, stamp: float, positions: Layout) -> None:
        """Note where the balls are, (n, 2) in m, at a sim time in s."""
        if not self._seen or not np.array_equal(self._seen[-1][1], positions):
            self._seen.append((stamp, positions))
            self._since = time.monotonic()
        else:
            self._layout = positions

    def _resting(self) -> Layout | None:
        """Return where the balls rest: they were seen there twice, or nothing came since."""
        if self._seen and time.monotonic() - self._since > STILL:
            return self._seen[-1][1]
        return self._layout if self._layout is not None or not self._seen else self._seen[-1][1]

    def forget(self) -> None:
        """Withdraw the latest strike."""
        self._cancelled.set()
        if self._fields is not None:
            self._tell(None)
        self._id = self._fields = self._done = None

    async def accepted(self, table: Table, response: dict[str, Any]) -> None:
        """Compute the shot of an accepted request, and tell it."""
        self.forget()
        start = self._resting() if response['shot'] is None else table.positions
        self._before = list(self._seen) if response['shot'] is None else []
        self._response = response
        if start is not None and len(start) == len(table.balls):
            await self._show(table, response, start)

    async def done(self, table: Table, response: dict[str, Any]) -> None:
        """Compare with where the balls really ended."""
        if response['id'] == self._id:
            self._done = response
            if self._fields is not None and not self._is_played(table):
                await self._mend(table, response)

    async def _show(self, table: Table, response: dict[str, Any], start: Layout) -> None:
        """Compute a shot from where the balls started, and tell it."""
        request_id = self._id = response['id']
        cancelled = self._cancelled = threading.Event()
        time_slice = REPORT_TIME_SLICE
        if response['integrator'] == 'time_slice' and not response['as_printed']:
            time_slice = await self._time_slice()
        fields = await asyncio.to_thread(_play, table, start, response, time_slice, cancelled)
        if fields is None or self._id != request_id:
            return
        self._fields = fields
        self._tell(fields)
        if self._done is not None and not self._is_played(table):
            await self._mend(table, self._done)

    async def _mend(self, table: Table, done: dict[str, Any]) -> None:
        """Withdraw a shot that ended elsewhere; show the one from the frame before it, if any."""
        before = [place for stamp, place in self._before if stamp <= done['t_start']]
        accepted = self._response
        self.forget()
        self._before = []
        if accepted is not None and before and len(before[-1]) == len(table.balls):
            self._done = done
            await self._show(table, accepted, before[-1])

    def _is_played(self, table: Table) -> bool:
        """Return whether the balls ended as computed."""
        assert self._fields is not None and self._done is not None, 'it was computed, and is over'
        ends = dict(zip(table.labels, self._fields['ends'], strict=True))
        return bool(self._done['final_positions'] == ends)


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


def places_to_undo(table: Table, start: np.ndarray, now: np.ndarray) -> dict[str, list[float]]:
    """Return where the balls that moved lay before, by label, given (n, 2) positions in m."""
    return {
        label: before.tolist()
        for label, before, place in zip(table.labels, start, now, strict=True)
        if not np.array_equal(before, place)
    }
