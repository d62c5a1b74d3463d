"""Arrays that threads write to, kept apart in memory.

Small arrays of two threads may lie in one cache line. Each write then takes the line from the
other core, which costs two threads a tenth of their speed.
"""

from __future__ import annotations

from typing import TypeVar, cast

import numpy as np

LINE = 128
"""Bytes that a core takes at a time: two cache lines of 64, as processors fetch them."""

Arrays = TypeVar('Arrays')


def own_lines(arrays: Arrays) -> Arrays:
    """Return a copy that shares no cache line with anything else.

    Parameters
    ----------
    arrays : ndarray or (named) tuple of such, at any depth
        Whatever else is in a tuple is kept as it is.
    """
    if isinstance(arrays, np.ndarray):
        room = np.empty(arrays.nbytes + 3 * LINE, np.uint8)
        start = LINE - room.ctypes.data % LINE + LINE
        own = room[start : start + arrays.nbytes].view(arrays.dtype).reshape(arrays.shape)
        own[...] = arrays
        return cast(Arrays, own)
    if not isinstance(arrays, tuple):
        return arrays
    parts = [own_lines(part) for part in arrays]
    joined = type(arrays)(*parts) if hasattr(arrays, '_fields') else tuple(parts)
    return cast(Arrays, joined)
