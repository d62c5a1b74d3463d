"""Ctrl-C where Python loses it or prints it; this imports as little as can be."""

from __future__ import annotations

import _thread
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType

PAUSE = 0.01
"""Seconds after which an interrupt comes again: what could not raise it has ended by then."""


def quiet_interrupts() -> None:
    """Print nothing for an interrupt that nobody catches, from now on.

    The rooms with commands call this first of all: Ctrl-C may come while they import the rest.
    """
    before = sys.excepthook

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if not issubclass(kind, KeyboardInterrupt):
            before(kind, error, trace)

    sys.excepthook = hook


@contextmanager
def kept_interrupts() -> Iterator[None]:
    """While this is open, an interrupt that cannot be raised where it arrives comes again.

    Python prints and forgets what is raised in a `__del__` or in the callback of a weak reference,
    and the command would go on. Those of rclpy run with every message.
    """
    before = sys.unraisablehook
    waiting: list[None] = []

    def interrupt_again() -> None:
        time.sleep(PAUSE)
        if waiting:
            waiting.clear()
            _thread.interrupt_main()

    def hook(lost: sys.UnraisableHookArgs) -> None:
        if not issubclass(lost.exc_type, KeyboardInterrupt):
            before(lost)
        elif not waiting:
            waiting.append(None)
            _thread.start_new_thread(interrupt_again, ())

    sys.unraisablehook = hook
    try:
        yield
    finally:
        waiting.clear()
        if sys.unraisablehook is hook:
            sys.unraisablehook = before
