"""One line on a terminal, written over and over."""

from __future__ import annotations

import time
from typing import TextIO

PERIOD = 0.1
"""Seconds between two versions of the line; nobody reads faster."""


class ProgressLine:
    """A line that shows what goes on; nothing where there is no terminal.

    Parameters
    ----------
    stream : file or None
        None where standard output is closed.
    """

    def __init__(self, stream: TextIO | None) -> None:
        self.wanted = stream is not None and stream.isatty()
        """Whether anybody sees it."""
        self._stream = stream
        self._next = 0.0

    def show(self, text: str) -> None:
        """Replace the line, unless this was done a moment ago."""
        if self.wanted and time.monotonic() >= self._next:
            self._next = time.monotonic() + PERIOD
            self._write(text)

    def clear(self) -> None:
        """Remove the line, so that something else can be printed there."""
        if self.wanted:
            self._next = 0.0
            self._write('')

    def _write(self, text: str) -> None:
        assert self._stream is not None, 'somebody sees it'
        self._stream.write(f'\r\x1b[K{text}')
        self._stream.flush()
