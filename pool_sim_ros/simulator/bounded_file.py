"""Files that anybody may have written: they are read in bounded time and memory."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO


class FileError(Exception):
    """A file that cannot be read; the message says why, without its name."""


def open_bounded(path: str | Path, most: int) -> BinaryIO:
    """Open a file.

    Parameters
    ----------
    path : str or Path
    most : int
        Most bytes that it may have.

    Raises
    ------
    FileError
        If it cannot be opened, has more bytes, or is something else, as a pipe or a device is: it
        would have no end, or be waited for.
    """
    try:
        # Not blocking: to open a pipe waits until somebody writes to it.
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except (OSError, ValueError) as error:
        raise FileError(getattr(error, 'strerror', None) or str(error)) from None
    status = os.fstat(descriptor)
    reason = None
    if stat.S_ISDIR(status.st_mode):
        reason = 'Is a directory'
    elif not stat.S_ISREG(status.st_mode):
        reason = 'it is not a regular file'
    elif status.st_size > most:
        reason = f'it has {status.st_size} bytes; at most {most} are read'
    if reason is not None:
        os.close(descriptor)
        raise FileError(reason)
    return os.fdopen(descriptor, 'rb')


def read_text(path: str | Path, most: int) -> str:
    """Return the text of a file; see `open_bounded`.

    Raises
    ------
    FileError
        As `open_bounded` raises it, and where it is no UTF-8 text.
    """
    with open_bounded(path, most) as file:
        try:
            return file.read(most).decode('utf-8-sig')  # some editors put a mark at the start
        except UnicodeDecodeError:
            raise FileError('it is not UTF-8 text') from None
        except OSError as error:
            raise FileError(error.strerror or str(error)) from None


def read_lines(file: BinaryIO, longest: int) -> Iterator[tuple[str, bool]]:
    """Yield each line as text, and whether it has its end.

    Parameters
    ----------
    file : file
        From `open_bounded`.
    longest : int
        Most bytes of a line.

    Raises
    ------
    ValueError
        Where a line is longer, or is no UTF-8 text.
    """
    encoding = 'utf-8-sig'
    while line := file.readline(longest + 1):
        whole = line.endswith(b'\n')
        if len(line) > longest and not whole:
            raise ValueError(f'the line has more than {longest} bytes')
        try:
            text = line.decode(encoding)
        except UnicodeDecodeError:
            raise ValueError('this cannot be read as UTF-8 text') from None
        yield text, whole
        encoding = 'utf-8'
