"""Files of a cache that may lie in several folders, of which some may be read-only or damaged."""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import uuid
from collections.abc import Sequence
from pathlib import Path

PREFIX = 'kernels-'
"""What the name of a folder of this cache begins with; its key follows."""

KEPT = 5
"""Folders that stay, the last used: some versions of the source, of Python or of numba in turn."""

DIGEST = 16
"""Bytes of the checksum before the content of a file."""


class KernelFiles:
    """Files of a cache.

    Each has a checksum, so that one that was emptied, cut or overwritten counts as missing. Each is
    written elsewhere and then renamed: other processes see it whole, or not at all.

    Parameters
    ----------
    folders : sequence of Path
        All are read; the first that can be written to is.
    key : str
        Names the folder in them: files of another key are never seen.
    """

    def __init__(self, folders: Sequence[Path], key: str) -> None:
        self._folders = [folder / f'{PREFIX}{key}' for folder in folders]
        self._used: set[Path] = set()

    @property
    def folder(self) -> str | None:
        """The folder where files are looked for first."""
        return str(self._folders[0]) if self._folders else None

    def read(self, name: str) -> bytes | None:
        """Return the content of a file; None where no folder has it whole."""
        for folder in self._folders:
            try:
                data = (folder / name).read_bytes()
            except OSError:
                continue
            if data[:DIGEST] == _checksum(data[DIGEST:]):
                self._note_use(folder)
                return data[DIGEST:]
        return None

    def write(self, name: str, content: bytes) -> None:
        """Write a file to the first folder where that is possible.

        Raises
        ------
        OSError
            Where it is possible nowhere; says why, folder by folder.
        """
        reasons = []
        for folder in self._folders:
            try:
                _make(folder)
                _replace(folder / name, _checksum(content) + content)
                return
            except OSError as error:
                reasons.append(f'{folder.parent}: {error.strerror or error}')
        raise OSError('; '.join(reasons) or 'there is no folder for it')

    def _note_use(self, folder: Path) -> None:
        """Let the folder's own time tell when it was used, once in each process."""
        if folder not in self._used:
            self._used.add(folder)
            with contextlib.suppress(OSError):
                os.utime(folder)


def _checksum(content: bytes) -> bytes:
    return hashlib.blake2b(content, digest_size=DIGEST).digest()


def _make(folder: Path) -> None:
    """Make a folder where it is missing; then remove the longest unused beside it."""
    if folder.is_dir():
        return
    folder.mkdir(parents=True, exist_ok=True)
    others = [path for path in folder.parent.glob(f'{PREFIX}*') if path != folder]
    for path in sorted(others, key=_last_used, reverse=True)[KEPT - 1 :]:
        # A process that still uses it has loaded what it needs, or compiles that anew.
        shutil.rmtree(path, ignore_errors=True)


def _last_used(folder: Path) -> float:
    try:
        return folder.stat().st_mtime
    except OSError:  # another process has removed it
        return 0.0


def _replace(path: Path, data: bytes) -> None:
    """Write a file that other processes see whole or not at all."""
    # With the usual permissions, unlike those of tempfile: others may read what root has compiled.
    unfinished = path.with_name(f'{uuid.uuid4().hex}.tmp')
    try:
        unfinished.write_bytes(data)
        os.replace(unfinished, path)
    except BaseException:
        with contextlib.suppress(OSError):
            unfinished.unlink()
        raise
