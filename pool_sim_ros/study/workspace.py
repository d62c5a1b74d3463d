"""Memory that is used again: the system takes longer to give new pages than numpy to fill them."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

PIECE = 8192
"""Rows that are computed together: few calls, and what lies between them stays in the cache."""


class Workspace(threading.local):
    """Arrays by name; each thread has its own."""

    def __init__(self) -> None:
        self._arrays: dict[str, NDArray[Any]] = {}

    def room(
        self, name: str, count: int, row: tuple[int, ...] = (), dtype: DTypeLike = np.float64
    ) -> NDArray[Any]:
        """Return an array of shape (count, *row), with anything in it: the same as last time.

        Whoever asks for a name again gives the same `row` and `dtype`.
        """
        kept = self._arrays.get(name)
        if kept is None or len(kept) < count:
            kept = self._arrays[name] = np.empty((count, *row), dtype)
        return kept[:count]


def pieces(count: int) -> Iterator[slice]:
    """Go through so many rows, `PIECE` at a time."""
    for first in range(0, count, PIECE):
        yield slice(first, min(first + PIECE, count))
