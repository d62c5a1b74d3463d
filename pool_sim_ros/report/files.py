"""Files that appear under their name only when they are whole."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from pool_sim_ros.report.errors import ReportError


class OutputError(ReportError):
    """A file could not be written."""


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Give a name to write to; the file gets its own name when the block has ended well.

    Folders on the way are made. Where the block ends with an exception, nothing is left of what
    it wrote, and a file that had the name before is still there.

    Parameters
    ----------
    path : Path
        The final name.

    Yields
    ------
    Path
        A name in the same folder.

    Raises
    ------
    OutputError
        Where the folder or the file cannot be written.
    """
    part = path.with_name(f'.{path.name}.{os.getpid()}.part')
    try:
        _make_folder(path.parent)
        yield part
        os.replace(part, path)
    except OSError as error:
        raise OutputError(f'cannot write {path}: {error.strerror or error}') from error
    finally:
        with suppress(OSError):
            part.unlink()


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError as error:
        raise NotADirectoryError(errno.ENOTDIR, f'{folder} is not a folder') from error


def write_text(path: Path, text: str) -> None:
    """Write a text file, UTF-8 with line feeds; raises as `whole_file`."""
    with whole_file(path) as part:
        part.write_bytes(text.encode())
