"""A background thread that runs one task after another."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable


class Worker:
    """Runs tasks in the order of their submission.

    Its thread is a daemon: nothing can interrupt a compiled kernel, and it must not keep the
    process from ending.

    Parameters
    ----------
    name : str
        Of the thread.
    """

    def __init__(self, name: str) -> None:
        self._tasks: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._stopping = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def submit(self, task: Callable[[], None]) -> None:
        """Run `task` after all that were submitted before; it must handle its own errors."""
        self._tasks.put(task)

    def stop(self, timeout: float) -> bool:
        """Start no further task; return whether the running one ended within `timeout` s."""
        self._stopping = True
        self._tasks.put(None)
        self._thread.join(timeout)
        return not self._thread.is_alive()

    def _run(self) -> None:
        while (task := self._tasks.get()) is not None and not self._stopping:
            task()
