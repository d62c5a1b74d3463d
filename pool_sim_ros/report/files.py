"""Files that appear under their names only when they are complete."""

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
    """Give a temporary name to write to; rename the file when the block ends without an error.

    Missing folders are created. If the block raises, the temporary file is removed, and an older
    file of that name stays as it was.

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
        If the folder or the file cannot be written.
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
    """Write a text file, UTF-8 with line feeds; raises as `whole_file`.

    A half of a surrogate pair, which UTF-8 has not, becomes an escape.
    """
    with whole_file(path) as part:
        part.write_bytes(text.encode(errors='backslashreplace'))
