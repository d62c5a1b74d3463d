"""A background thread that runs the latest task."""

from __future__ import annotations

import threading
from collections.abc import Callable


class Worker:
    """Runs a first task, and then the latest that was submitted, one at a time.

    Its thread is a daemon: a kernel cannot be interrupted while it runs, and it must not keep the
    process from ending.

    Parameters
    ----------
    name : str
        Of the thread.
    first : callable
        The first task; no other one replaces it.
    """

    def __init__(self, name: str, first: Callable[[], None]) -> None:
        self._changed = threading.Condition()
        self._first = first
        self._next: Callable[[], None] | None = None
        self._stopping = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def submit(self, task: Callable[[], None]) -> None:
        """Run `task` next, and never what was submitted before and has not begun.

        It must handle its own errors.
        """
        with self._changed:
            self._next = task
            self._changed.notify()

    def stop(self, timeout: float) -> bool:
        """Start no further task; return whether the running one ended within `timeout` s."""
        with self._changed:
            self._stopping = True
            self._changed.notify()
        self._thread.join(timeout)
        return not self._thread.is_alive()

    def _run(self) -> None:
        if not self._stopping:
            self._first()
        while (task := self._take()) is not None:
            task()

    def _take(self) -> Callable[[], None] | None:
        """Wait for a task and return it; None where there is none any more."""
        with self._changed:
            self._changed.wait_for(lambda: self._stopping or self._next is not None)
            task, self._next = self._next, None
            return None if self._stopping else task
