"""Ctrl-C and SIGTERM, seen between two steps of the work."""

from __future__ import annotations

import signal

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Interrupts:
    """While this context is open, an interrupt waits for the next `check`.

    Raised at once, as Python does it, KeyboardInterrupt may fall into a weak reference's callback,
    where it is printed and forgotten; a picture being drawn runs thousands of those.
    """

    def __init__(self) -> None:
        self._seen = False

    def check(self) -> None:
        """Raise KeyboardInterrupt where one was asked for."""
        if self._seen:
            raise KeyboardInterrupt

    def __enter__(self) -> Interrupts:
        self._before = [signal.signal(number, self._note) for number in SIGNALS]
        return self

    def __exit__(self, *_) -> None:
        for number, handler in zip(SIGNALS, self._before, strict=True):
            signal.signal(number, handler)

    def _note(self, *_) -> None:
        self._seen = True
