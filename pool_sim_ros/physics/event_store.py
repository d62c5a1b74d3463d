"""The events of many shots, joined in the order of the shots while threads still play."""

from __future__ import annotations

import threading

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.log import EVENT

GROWTH = 1.25
"""Part by which more room is made than what has come lets one expect."""


class EventStore:
    """Takes the events of parts of the shots, in any order.

    Threads play into rooms that are used again: fresh memory costs more than the events do.

    Parameters
    ----------
    shots : int
        All of them.
    """

    def __init__(self, shots: int) -> None:
        self._shots = shots
        self._lock = threading.Lock()
        self._waiting: dict[int, tuple[int, NDArray[np.void], int]] = {}
        self._rooms: list[NDArray[np.void]] = []
        self._next_shot = 0
        self._joined = np.empty(0, EVENT)
        self._filled = 0

    def room(self, least: int) -> NDArray[np.void]:
        """Return room for so many events at least; `put` gives it back."""
        with self._lock:
            room = self._rooms.pop() if self._rooms else np.empty(0, EVENT)
        return room if len(room) >= least else np.empty(least, EVENT)

    def put(self, first: int, end: int, room: NDArray[np.void], filled: int) -> None:
        """Take the events of shots `first` to `end`, the first `filled` of a room."""
        with self._lock:
            self._waiting[first] = end, room, filled
            while self._next_shot in self._waiting:
                end, room, filled = self._waiting.pop(self._next_shot)
                self._append(end, room[:filled])
                self._next_shot = end
                self._rooms.append(room)

    def joined(self) -> NDArray[np.void]:
        """Return all events, once all shots have come."""
        self._joined.resize(self._filled, refcheck=False)
        return self._joined

    def _append(self, end: int, events: NDArray[np.void]) -> None:
        start, self._filled = self._filled, self._filled + len(events)
        if self._filled > len(self._joined):
            expected = self._filled / end * self._shots
            larger = np.empty(int(GROWTH * expected) + 1, EVENT)
            larger.view(np.uint8)[: start * EVENT.itemsize] = self._joined.view(np.uint8)[
                : start * EVENT.itemsize
            ]
            self._joined = larger
        # As bytes: numpy copies records field by field, which takes longer.
        self._joined.view(np.uint8)[start * EVENT.itemsize : self._filled * EVENT.itemsize] = (
            events.view(np.uint8)
        )
