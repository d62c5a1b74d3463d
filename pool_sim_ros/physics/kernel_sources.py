"""The source files of the kernels, as this process found them when it began.

What is compiled depends on all of them: a kernel's machine code contains that of whatever it calls,
and the constants of other modules.
"""

from __future__ import annotations

import hashlib
import os
from functools import cache
from pathlib import Path

ROOM = Path(__file__).parent
"""The folder that has every kernel, and every constant that a kernel reads."""


def stamps() -> dict[str, tuple[int, int, int]]:
    """Return for each source file what tells an edit: modification time in ns, size, inode."""
    found = {}
    for folder, inner, names in os.walk(ROOM):
        inner[:] = [name for name in inner if name != '__pycache__']
        for name in names:
            # Editors leave hidden links and files beside the source.
            if name.endswith('.py') and not name.startswith('.'):
                path = os.path.join(folder, name)
                status = os.stat(path)
                found[path] = status.st_mtime_ns, status.st_size, status.st_ino
    return found


def source_hash() -> str:
    """Return a hash of all source files that this process loads.

    Raises
    ------
    OSError
        Where there are none, as in a zip archive, or one was edited after this process began: then
        nobody knows which of both it has loaded.
    """
    if not _at_start:
        raise OSError(f'{ROOM} has no source files')
    found = _hash()
    # After the reading, so that what was read is what was there at the start.
    if stamps() != _at_start:
        raise OSError(f'a source file in {ROOM} was edited after this process began')
    return found


@cache
def _hash() -> str:
    digest = hashlib.blake2b(digest_size=16)
    for path in sorted(_at_start):
        content = Path(path).read_bytes()
        name = os.fsencode(os.path.relpath(path, ROOM))
        digest.update(b'%b %d ' % (name, len(content)) + content)
    return digest.hexdigest()


try:
    _at_start = stamps()
except OSError:  # one was removed meanwhile
    _at_start = {}
