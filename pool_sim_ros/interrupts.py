"""Ctrl-C before a command is ready for it; this imports as little as can be."""

from __future__ import annotations

import sys
from types import TracebackType


def quiet_interrupts() -> None:
    """Print nothing for an interrupt that nobody catches, from now on.

    The rooms with commands call this first of all: Ctrl-C may come while they import the rest.
    """
    before = sys.excepthook

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if not issubclass(kind, KeyboardInterrupt):
            before(kind, error, trace)

    sys.excepthook = hook
