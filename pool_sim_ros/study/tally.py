"""How far a sweep has come: a bar with the time left."""

from __future__ import annotations

import sys
from types import TracebackType
from typing import Any

from pool_sim_ros.extras import needs

LOG_PERIOD = 30.0
"""Seconds between two lines where no terminal shows the bar, such as the log of a cluster."""


class Tally:
    """Counts shots, and shows them by tqdm if that is wanted; a context manager.

    Parameters
    ----------
    total, done : int
        How many shots there are, and how many of them an earlier run has played.
    shown : bool
    """

    def __init__(self, total: int, done: int, shown: bool) -> None:
        self._bar: Any = None
        if shown:
            with needs('the progress of a sweep', 'study'):
                from tqdm.auto import tqdm
            period = 0.1 if sys.stderr is not None and sys.stderr.isatty() else LOG_PERIOD
            self._bar = tqdm(
                total=total, initial=done, unit=' shots', unit_scale=True, mininterval=period
            )

    def add(self, shots: int) -> None:
        """Count shots that were played."""
        if self._bar is not None:
            self._bar.update(shots)

    def say(self, line: str) -> None:
        """Show a line above the bar."""
        if self._bar is not None:
            self._bar.write(line, file=sys.stderr)

    def __enter__(self) -> Tally:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.close()
