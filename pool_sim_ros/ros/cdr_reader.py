"""Reads messages as the bytes that ROS sends (CDR), field by field."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

ENCAPSULATION = 4
"""Bytes before every message; numbers are aligned to what follows them."""

POSE = 7
"""Numbers of a pose: x, y, z, and a quaternion."""


class CdrReader:
    """Reads a message from its beginning on; raises struct.error or ValueError where it ends.

    Parameters
    ----------
    message : bytes
        In either byte order.
    """

    def __init__(self, message: bytes) -> None:
        self._message, self._at = message, ENCAPSULATION
        self._order = '<' if message[1:2] == b'\1' else '>'

    @property
    def at(self) -> int:
        """Where in the message it reads next."""
        return self._at

    def skip(self, data: bytes) -> bool:
        """Return whether these bytes come next, and go past them if so."""
        found = self._message.startswith(data, self._at)
        self._at += len(data) if found else 0
        return found

    def numbers(self, kinds: str) -> Any:
        """Return numbers of kinds that `struct` knows, each aligned to its own size."""
        found: list[Any] = []
        for kind in kinds:
            size = struct.calcsize(kind)
            self._at += -(self._at - ENCAPSULATION) % size
            found += struct.unpack_from(f'{self._order}{kind}', self._message, self._at)
            self._at += size
        return found

    def text(self) -> str:
        """Return a text."""
        (length,) = self.numbers('I')
        data = self.some(length)
        if not length or data[-1] != 0:
            raise ValueError
        return str(data[:-1], 'utf-8')

    def some(self, length: int) -> memoryview:
        """Return so many bytes."""
        start, self._at = self._at, self._at + length
        if self._at > len(self._message):
            raise ValueError
        return memoryview(self._message)[start : self._at]

    def doubles(self, count: int) -> NDArray[np.float64]:
        """Return so many numbers, aligned to theirs."""
        self._at += -(self._at - ENCAPSULATION) % 8 if count else 0
        return np.frombuffer(self.some(8 * count), f'{self._order}f8')

    def rest(self, length: int) -> memoryview:
        """Return so many bytes, which only one more follows, and perhaps padding."""
        data = self.some(length)
        self.some(1)
        if len(self._message) - self._at > 3:
            raise ValueError
        return data


def read_poses(message: bytes) -> tuple[int, str, NDArray[np.float64]]:
    """Return of a geometry_msgs/PoseArray its stamp in ns, frame, and positions, (n, 2) in m.

    Raises
    ------
    ValueError
        Where the bytes are no such message, or a position is not finite.
    """
    reader = CdrReader(message)
    try:
        seconds, nanoseconds = reader.numbers('iI')
        frame_id = reader.text()
        (count,) = reader.numbers('I')
        poses = reader.doubles(count * POSE).reshape(count, POSE)[:, :2]
    except (struct.error, ValueError):
        raise ValueError(f'{len(message)} bytes are no geometry_msgs/msg/PoseArray') from None
    if not np.isfinite(poses).all():
        raise ValueError('ball_poses: a position is not finite')
    return seconds * 1_000_000_000 + nanoseconds, frame_id, poses.astype(float)
