"""Messages as the bytes that ROS sends (CDR), with the numbers written in place by numpy.

Making message objects anew costs some 30 times as much as publishing such bytes. And the bytes
that ROS itself makes are not the same each time: between the fields it leaves gaps unwritten. Here
they are zero, so that two runs with the same inputs send the same bytes.
"""

from __future__ import annotations

import struct
from collections import OrderedDict
from collections.abc import Sequence

import numpy as np

LITTLE_ENDIAN = b'\0\1\0\0'
"""What precedes every message; numbers are aligned to what follows it."""

DOUBLE = 8
POSE = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
"""x, y, z and the quaternion that turns nothing."""

SHAPES_KEPT = 64
"""Numbers of rows whose layout is kept: more collisions than that in one frame are rare."""

SECOND_NS = 1_000_000_000

_STAMP = struct.Struct('<iI')


class PosesWriter:
    """Writes what `conversions.to_poses` makes.

    Parameters
    ----------
    frame_id : str
    radii : sequence of n floats
        m.
    """

    def __init__(self, frame_id: str, radii: Sequence[float]) -> None:
        poses = np.tile(POSE, (len(radii), 1))
        poses[:, 2] = radii
        self._buffer = bytearray(LITTLE_ENDIAN)
        self._buffer += _STAMP.pack(0, 0)
        _add_string(self._buffer, frame_id)
        self._places = _add_rows(self._buffer, len(poses), poses)[:, :2]

    def write(self, stamp: int, positions: np.ndarray) -> bytes:
        """Return the message for a sim time in ns and (n, 2) positions in m."""
        _STAMP.pack_into(self._buffer, len(LITTLE_ENDIAN), *divmod(stamp, SECOND_NS))
        self._places[...] = positions
        return bytes(self._buffer)


class RowsWriter:
    """Writes what `conversions.to_velocities` and `to_collisions` make.

    Parameters
    ----------
    name : str
        What a row is.
    columns : sequence of str
        What its numbers are.
    """

    def __init__(self, name: str, columns: Sequence[str]) -> None:
        self._name = name
        self._columns = columns
        self._layouts: OrderedDict[int, tuple[bytearray, np.ndarray]] = OrderedDict()

    def write(self, rows: np.ndarray) -> bytes:
        """Return the message for (k, columns) rows, k at least 1."""
        buffer, numbers = self._layouts.get(len(rows)) or self._lay_out(len(rows))
        numbers[...] = rows
        return bytes(buffer)

    def _lay_out(self, count: int) -> tuple[bytearray, np.ndarray]:
        width = len(self._columns)
        buffer = bytearray(LITTLE_ENDIAN)
        dimensions = ((self._name, count, count * width), (','.join(self._columns), width, width))
        _add_uint32(buffer, len(dimensions))
        for label, size, stride in dimensions:
            _add_string(buffer, label)
            _add_uint32(buffer, size)
            _add_uint32(buffer, stride)
        _add_uint32(buffer, 0)  # data_offset
        numbers = _add_rows(buffer, count * width, np.zeros((count, width)))
        if len(self._layouts) == SHAPES_KEPT:
            self._layouts.popitem(last=False)
        self._layouts[count] = buffer, numbers
        return self._layouts[count]


def clock_bytes(stamp: int) -> bytes:
    """Return what `conversions.to_clock` makes of a sim time in ns."""
    return LITTLE_ENDIAN + _STAMP.pack(*divmod(stamp, SECOND_NS))


def _align(buffer: bytearray, size: int) -> None:
    buffer += bytes(-(len(buffer) - len(LITTLE_ENDIAN)) % size)


def _add_uint32(buffer: bytearray, number: int) -> None:
    _align(buffer, 4)
    buffer += struct.pack('<I', number)


def _add_string(buffer: bytearray, text: str) -> None:
    data = text.encode() + b'\0'
    _add_uint32(buffer, len(data))
    buffer += data


def _add_rows(buffer: bytearray, length: int, rows: np.ndarray) -> np.ndarray:
    """Add a sequence of this length that consists of doubles; return a view of these."""
    _add_uint32(buffer, length)
    _align(buffer, DOUBLE)
    start = len(buffer)
    buffer += rows.astype('<f8').tobytes()
    return np.frombuffer(buffer, '<f8', offset=start).reshape(rows.shape)
