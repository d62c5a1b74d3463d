"""When the next frame is due by the wall."""

from __future__ import annotations

import time
from collections.abc import Callable

MAX_LAG = 0.1
"""Seconds of lateness that are caught up. Past that, time slips: a machine that was asleep or
stopped does not answer with a flood of frames."""


class Pacer:
    """Says how long to wait, by the wall, for the next frame.

    No frame is ever left out: lateness only delays frames.

    Parameters
    ----------
    rate : float
        Frames per second of sim time.
    real_time_factor : float, optional
        Sim seconds per wall second; 0 = as fast as possible, and real time while nothing moves.
    clock : callable, optional
        Returns the wall time, s, from any origin; it should never be set back.
    """

    def __init__(
        self,
        rate: float,
        real_time_factor: float = 1.0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._rate = rate
        self._clock = clock
        self._hurrying = False
        self.slips = 0
        """How often the lateness was too much to catch up, so that time slipped."""
        self.lateness = 0.0
        """How late the latest frame was, s; 0 while as fast as possible."""
        self.real_time_factor = real_time_factor

    @property
    def real_time_factor(self) -> float:
        """Sim seconds per wall second that are aimed at; a new value makes a frame due now."""
        return self._factor

    @real_time_factor.setter
    def real_time_factor(self, factor: float) -> None:
        self._factor = factor
        self._period = 1.0 / (self._rate * (factor or 1.0))
        self.restart()

    def restart(self) -> None:
        """Count from now: the next frame is due at once."""
        self._anchor = self._clock()
        self._shown = 0

    def wait(self, moving: bool) -> float:
        """Return the seconds until the next frame is due; at most 0 when it is.

        Parameters
        ----------
        moving : bool
            Whether the balls move.
        """
        hurrying = moving and self._factor == 0
        if hurrying != self._hurrying:
            self._hurrying = hurrying
            self.restart()
        if hurrying:
            return 0.0
        wait = self._due() - self._clock()
        if -MAX_LAG <= wait <= 1.001 * self._period:
            return wait
        # Too late to catch up, or the clock was set back.
        self.slips += 1
        self.restart()
        return 0.0

    def shown(self) -> None:
        """Note that the frame that was due was shown."""
        self.lateness = 0.0 if self._hurrying else max(self._clock() - self._due(), 0.0)
        self._shown += 1

    @property
    def ticks_behind(self) -> int:
        """Frames that are due and not yet shown; 0 while as fast as possible."""
        if self._hurrying:
            return 0
        return max(int((self._clock() - self._due()) / self._period), 0)

    def _due(self) -> float:
        return self._anchor + self._shown * self._period
