"""Messages as the bytes that ROS sends (CDR); numpy writes the numbers in place.

To make message objects costs some 30 times as much as to publish such bytes. Also, ROS itself does
not make the same bytes each time: it leaves the gaps between the fields unwritten. Here they are
zero, so that two runs with the same inputs send the same bytes.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from pool_sim_ros.simulator import SECOND_NS

LITTLE_ENDIAN = b'\0\1\0\0'
"""Bytes before every message; numbers are aligned to what follows them."""

DOUBLE = 8
STAMP = 8
"""Bytes; each message with a stamp begins with it."""

POSE = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
"""x, y, z, and the quaternion of no rotation."""

SHAPES_KEPT = 64
"""Numbers of rows whose layout is kept; a frame with more collisions than that is rare."""


class PosesWriter:
    """Writes `~/ball_poses`: the balls' centres, each as high as its radius.

    A ball in a pocket is as far below the cloth.

    Parameters
    ----------
    frame_id : str
    radii : sequence of n floats
        m.
    """

    def __init__(self, frame_id: str, radii: Sequence[float]) -> None:
        self._shape = len(radii), len(POSE)
        self._radii = np.array(radii, dtype=float)
        poses = np.tile(POSE, (len(radii), 1))
        poses[:, 2] = radii
        message = bytearray(LITTLE_ENDIAN + bytes(STAMP))
        _add_string(message, frame_id)
        _add_doubles(message, len(poses), poses)
        self._message = bytes(message)

    def write(
        self,
        stamps: Sequence[int],
        positions: np.ndarray,
        orientations: np.ndarray | None = None,
        pocketed: Sequence[Sequence[int]] = (),
    ) -> list[bytes]:
        """Return the messages of some ticks.

        Parameters
        ----------
        stamps : sequence of m ints
            Sim times, ns.
        positions : ndarray of shape (m, n, 2)
            m.
        orientations : ndarray of shape (m, n, 4), optional
            Quaternions x, y, z, w; by default no ball is turned.
        pocketed : sequence of m sequences of int, optional
            The balls in pockets at each tick.
        """
        copies = _copies(self._message, len(stamps))
        _put_stamps(copies, stamps)
        poses = _doubles(copies, self._shape)
        poses[:, :, :2] = positions
        if orientations is not None:
            poses[:, :, 3:] = orientations
        for tick, balls in enumerate(pocketed):
            if balls:
                poses[tick, list(balls), 2] = -self._radii[list(balls)]
        return _each(copies)


class RowsWriter:
    """Writes rows of numbers: `~/ball_velocities` and `~/collisions`.

    Parameters
    ----------
    name : str
        What a row is.
    columns : sequence of str
        What its numbers are.
    """

    def __init__(self, name: str, columns: Sequence[str]) -> None:
        self._name = name
        self._columns = tuple(columns)

    def write(self, rows: np.ndarray) -> list[bytes]:
        """Return the messages for (m, k, columns) numbers, k at least 1."""
        count, *shape = rows.shape
        copies = _copies(_rows_message(self._name, self._columns, shape[0]), count)
        _doubles(copies, shape)[...] = rows
        return _each(copies)


def clock_bytes(stamps: Sequence[int]) -> list[bytes]:
    """Return the messages of `/clock` for sim times in ns."""
    copies = _copies(LITTLE_ENDIAN + bytes(STAMP), len(stamps))
    _put_stamps(copies, stamps)
    return _each(copies)


@lru_cache(SHAPES_KEPT)
def _rows_message(name: str, columns: tuple[str, ...], count: int) -> bytes:
    width = len(columns)
    message = bytearray(LITTLE_ENDIAN)
    dimensions = ((name, count, count * width), (','.join(columns), width, width))
    _add_uint32(message, len(dimensions))
    for label, size, stride in dimensions:
        _add_string(message, label)
        _add_uint32(message, size)
        _add_uint32(message, stride)
    _add_uint32(message, 0)  # data_offset
    _add_doubles(message, count * width, np.zeros((count, width)))
    return bytes(message)


def _add_uint32(message: bytearray, number: int) -> None:
    _align(message, 4)
    message += struct.pack('<I', number)


def _add_string(message: bytearray, text: str) -> None:
    data = text.encode() + b'\0'
    _add_uint32(message, len(data))
    message += data


def _add_doubles(message: bytearray, length: int, numbers: np.ndarray) -> None:
    """Add the last field of a message: a sequence of this length, made of doubles."""
    _add_uint32(message, length)
    _align(message, DOUBLE)
    message += numbers.astype('<f8').tobytes()


def _align(message: bytearray, size: int) -> None:
    message += bytes(-(len(message) - len(LITTLE_ENDIAN)) % size)


def _copies(message: bytes, count: int) -> np.ndarray:
    """Return an array of bytes, (count, size); each row is the message."""
    copies = np.empty((count, len(message)), np.uint8)
    copies[...] = np.frombuffer(message, np.uint8)
    return copies


def _put_stamps(copies: np.ndarray, stamps: Sequence[int]) -> None:
    start = len(LITTLE_ENDIAN)
    fields = copies[:, start : start + STAMP].view('<i4')
    fields[:, 0], fields[:, 1] = np.divmod(stamps, SECOND_NS)


def _doubles(copies: np.ndarray, shape: Sequence[int]) -> np.ndarray:
    """Return a view of the last field of each message, (count, *shape)."""
    start = copies.shape[1] - DOUBLE * shape[0] * shape[1]
    return copies[:, start:].view('<f8').reshape(len(copies), *shape)


def _each(copies: np.ndarray) -> list[bytes]:
    size = copies.shape[1]
    data = copies.tobytes()
    return [data[start : start + size] for start in range(0, len(data), size)]
