"""Standard output that may be closed, full, or unable to show a character."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO, cast

NOBODY_READS = 141
"""Exit status where nobody reads the output any more, as shells have it for SIGPIPE."""


class BrokenOutputError(Exception):
    """Standard output takes nothing any more.

    Attributes
    ----------
    reason : str
    unread : bool
        Whether its reader has gone, as in ``| head``.
    """

    def __init__(self, error: OSError) -> None:
        super().__init__(error)
        self.reason = error.strerror
        self.unread = error.errno == errno.EPIPE


class _Output:
    """Standard output that raises BrokenOutputError, so that nobody takes it for another file."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        try:
            return self._stream.write(text)
        except OSError as error:
            raise BrokenOutputError(error) from error

    def flush(self) -> None:
        try:
            self._stream.flush()
        except OSError as error:
            raise BrokenOutputError(error) from error

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def guarded_output() -> Iterator[None]:
    """While this is open, standard output prints any text, and raises BrokenOutputError.

    All is written when it ends. After an error nothing is written any more: Python would try again
    what waits, and end with a traceback.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, 'reconfigure'):
            stream.reconfigure(errors='backslashreplace')  # for what the locale has not
    plain = sys.stdout
    if plain is None:  # it was closed before Python started
        yield
        return
    output = _Output(plain)
    sys.stdout = cast(TextIO, output)
    try:
        try:
            yield
        finally:
            output.flush()
    except BrokenOutputError:
        with suppress(OSError, ValueError):  # tests have streams without a descriptor
            null = os.open(os.devnull, os.O_WRONLY)
            os.dup2(null, plain.fileno())
            os.close(null)
        raise
    finally:
        sys.stdout = plain


def complain(line: str) -> None:
    """Write a line to standard error, if anybody reads it."""
    with suppress(OSError):
        print(line, file=sys.stderr, flush=True)
