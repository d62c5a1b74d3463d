"""How far a long call has come."""

from __future__ import annotations

import threading
from collections.abc import Callable

Progress = bool | Callable[[int, int], None] | None


class Counter:
    """Counts what several threads have done, and tells it.

    Parameters
    ----------
    progress : bool or callable or None
        True: a bar by tqdm, where that is installed. A callable is called with what is done and
        the total, by one thread at a time; an exception of it ends the call.
    total : int
    """

    def __init__(self, progress: Progress, total: int) -> None:
        self._lock = threading.Lock()
        self._done = 0
        self._total = total
        self._bar = _bar(total) if progress is True else None
        self._tell = progress if callable(progress) else None

    def add(self, count: int) -> None:
        """Count what has been done."""
        if self._bar is None and self._tell is None:
            return
        with self._lock:
            self._done += count
            if self._bar is not None:
                self._bar.update(count)
            if self._tell is not None:
                self._tell(self._done, self._total)

    def close(self) -> None:
        """End the bar."""
        if self._bar is not None:
            self._bar.close()


def _bar(total: int):  # type: ignore[no-untyped-def]
    try:
        from tqdm.auto import tqdm
    except ModuleNotFoundError:
        return None
    return tqdm(total=total, unit=' shots', unit_scale=True)
