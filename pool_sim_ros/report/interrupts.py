"""Ctrl-C and SIGTERM, noticed between two steps of the work."""

from __future__ import annotations

import signal

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Interrupts:
    """While this context is open, an interrupt waits for the next `check`.

    Python raises KeyboardInterrupt at once, possibly within the callback of a weak reference,
    where it is printed and forgotten. Drawing a picture runs thousands of those.
    """

    def __init__(self) -> None:
        self._seen = False

    def check(self) -> None:
        """Raise KeyboardInterrupt if one has arrived."""
        if self._seen:
            raise KeyboardInterrupt

    def __enter__(self) -> Interrupts:
        self._before = [signal.signal(number, self._note) for number in SIGNALS]
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in zip(SIGNALS, self._before, strict=True):
            signal.signal(number, handler)

    def _note(self, *_: object) -> None:
        self._seen = True
