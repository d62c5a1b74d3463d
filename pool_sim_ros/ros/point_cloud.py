"""Point clouds as the bytes that ROS sends (CDR): rows of numbers to numpy and back, without ROS.

A message of sensor_msgs/PointCloud2 is read and written as a whole; numpy does the rows. To make
message objects instead costs several copies of what may be 12 MB.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.ros.cdr_reader import ENCAPSULATION, CdrReader

DATATYPES = {1: 'i1', 2: 'u1', 3: 'i2', 4: 'u2', 5: 'i4', 6: 'u4', 7: 'f4', 8: 'f8'}
"""Of sensor_msgs/PointField: its number -> numpy's name."""

NAMES = {
    **{'i1': 'INT8', 'u1': 'UINT8', 'i2': 'INT16', 'u2': 'UINT16'},
    **{'i4': 'INT32', 'u4': 'UINT32', 'f4': 'FLOAT32', 'f8': 'FLOAT64'},
}
"""numpy's name -> that of sensor_msgs/PointField."""

LITTLE_ENDIAN = b'\0\1\0\0'
DENSE = (b'\0', b'\1')

MOST_FIELDS = 100_000
"""Fields that are read: three for each of 33,000 balls."""

Stamp = tuple[int, int]
"""Seconds, -2**31 to 2**31 - 1, and nanoseconds, 0 to 2**32 - 1, of a message."""


class Field(NamedTuple):
    """A column of a cloud, as sensor_msgs/PointField has it; its count is `numbers` here."""

    name: str
    offset: int
    datatype: int
    numbers: int


class Cloud(NamedTuple):
    """A point cloud as it came: nothing is checked but that it is one.

    Attributes
    ----------
    stamp : (int, int)
    frame_id : str
    height, width : int
    fields : tuple of Field
    is_bigendian : bool
    point_step, row_step : int
        Bytes of a point, and of a row of them.
    data : memoryview
        Of the message.
    """

    stamp: Stamp
    frame_id: str
    height: int
    width: int
    fields: tuple[Field, ...]
    is_bigendian: bool
    point_step: int
    row_step: int
    data: memoryview


def read_stamp(message: bytes) -> Stamp:
    """Return the stamp with which a message begins; (0, 0) where it is too short for one."""
    try:
        seconds, nanoseconds = CdrReader(message).numbers('iI')
    except struct.error:
        return 0, 0
    return seconds, nanoseconds


def read_cloud(message: bytes) -> Cloud:
    """Read a message of sensor_msgs/PointCloud2.

    Parameters
    ----------
    message : bytes
        As ROS sends it.

    Returns
    -------
    Cloud
        Its data are a view of the message.

    Raises
    ------
    ValueError
        Where the bytes are no such message.
    """
    reader = CdrReader(message)
    try:
        seconds, nanoseconds = reader.numbers('iI')
        frame_id = reader.text()
        height, width, count = reader.numbers('III')
        if count > MOST_FIELDS:
            raise ValueError
        fields = _read_fields(reader, message, count)
        (is_bigendian,) = reader.numbers('?')
        point_step, row_step, length = reader.numbers('III')
        data = reader.rest(length)
    except (struct.error, ValueError):
        raise ValueError(
            f'a message of {len(message)} bytes is no sensor_msgs/msg/PointCloud2'
        ) from None
    return Cloud(
        (seconds, nanoseconds),
        frame_id,
        height,
        width,
        fields,
        is_bigendian,
        point_step,
        row_step,
        data,
    )


class _Fields(NamedTuple):
    """The fields of a message, and its bytes that say so."""

    aligned: tuple[int, int]
    data: bytes
    fields: tuple[Field, ...]


_latest = [_Fields((0, 0), b'', ())]


def _read_fields(reader: CdrReader, message: bytes, count: int) -> tuple[Field, ...]:
    """Read so many fields: one sender has the same in each message, and to read them takes time."""
    (latest,) = _latest
    start = reader.at
    aligned = message[1], start % 4
    if (aligned, count) == (latest.aligned, len(latest.fields)) and reader.skip(latest.data):
        return latest.fields
    fields = tuple(Field(reader.text(), *reader.numbers('IBI')) for _ in range(count))
    _latest[0] = _Fields(aligned, message[start : reader.at], fields)
    return fields


def rows_of(cloud: Cloud) -> NDArray[Any]:
    """Return the points of a cloud, (height * width,), with its fields; a view of its data.

    Raises
    ------
    ValueError
        Where its sizes contradict each other, or a field is none; says which.
    """
    check_sizes(cloud)
    names, formats, offsets = [], [], []
    for field in cloud.fields:
        kind = DATATYPES.get(field.datatype)
        if kind is None:
            raise ValueError(f'fields: {field.name!r:.40}: there is no datatype {field.datatype}')
        if field.name in names:
            raise ValueError(f'fields: {field.name!r:.40} is there twice')
        size = int(kind[1]) * field.numbers
        if field.offset + size > cloud.point_step:
            raise ValueError(
                f'fields: {field.name!r:.40} ends at byte {field.offset + size} of a point, '
                f'which has point_step {cloud.point_step}'
            )
        order = '>' if cloud.is_bigendian else '<'
        names.append(field.name)
        formats.append(
            f'{order}{kind}' if field.numbers == 1 else f'({field.numbers},){order}{kind}'
        )
        offsets.append(field.offset)
    if not names or cloud.point_step == 0:
        raise ValueError('fields: there are none')
    layout = np.dtype(
        {'names': names, 'formats': formats, 'offsets': offsets, 'itemsize': cloud.point_step}
    )
    return np.frombuffer(cloud.data, layout, cloud.height * cloud.width)


def check_sizes(cloud: Cloud) -> None:
    """Raise ValueError where the sizes of a cloud contradict each other."""
    if cloud.row_step != cloud.width * cloud.point_step:
        raise ValueError(
            f'row_step: {cloud.row_step} must be width * point_step, '
            f'{cloud.width} * {cloud.point_step}'
        )
    if len(cloud.data) != cloud.height * cloud.row_step:
        raise ValueError(
            f'data: {len(cloud.data)} bytes must be height * row_step, '
            f'{cloud.height} * {cloud.row_step}'
        )


def fields_of(rows: NDArray[Any]) -> tuple[Field, ...]:
    """Return the columns of a structured array of numbers, one for each number of a point."""
    layout, found = rows.dtype.fields, []
    assert layout is not None, 'the array has fields'
    kinds = {name: number for number, name in DATATYPES.items()}
    for name in rows.dtype.names or ():
        kind, offset = layout[name][:2]
        found.append(Field(name, offset, kinds[kind.str[1:]], 1))
    return tuple(found)


def cloud_bytes(
    stamp: Stamp,
    frame_id: str,
    rows: NDArray[Any],
    fields: Sequence[Field] | None = None,
    dense: bool = True,
) -> bytes:
    """Return a message of sensor_msgs/PointCloud2 of height 1, little-endian.

    Parameters
    ----------
    stamp : (int, int)
    frame_id : str
    rows : structured ndarray of shape (m,)
        The points; their bytes are sent as they are.
    fields : sequence of Field, optional
        What their numbers are called; by default as the array calls them.
    dense : bool, optional
        Whether no number is missing (NaN).
    """
    columns = fields_of(rows) if fields is None else tuple(fields)
    step, data = rows.dtype.itemsize, np.ascontiguousarray(rows)
    return cloud_of_parts(stamp, frame_id, columns, (len(rows), step), [data], dense)


def cloud_of_parts(
    stamp: Stamp,
    frame_id: str,
    fields: tuple[Field, ...],
    size: tuple[int, int],
    parts: Iterable[NDArray[Any]],
    dense: bool = True,
) -> bytes:
    """Return such a message, whose points come part by part.

    Parameters
    ----------
    stamp, frame_id, fields, dense
        As in `cloud_bytes`.
    size : (int, int)
        How many points there are, and bytes of a point.
    parts : iterable of ndarray
        Contiguous rows. Each is copied before the next one is asked for.
    """
    count, step = size
    template, width_at = _head(frame_id, fields)
    head = bytearray(template)
    struct.pack_into('<iI', head, ENCAPSULATION, *stamp)
    struct.pack_into('<I', head, width_at, count)
    head += struct.pack('<III', step, step * count, step * count)
    message = io.BytesIO()
    message.seek(len(head) + step * count)
    message.write(DENSE[dense])  # makes room for all of it
    message.seek(0)
    message.write(head)
    for part in parts:
        message.write(part.view(np.uint8).data)
    return message.getvalue()  # no copy


@lru_cache(64)
def _head(frame_id: str, fields: tuple[Field, ...]) -> tuple[bytes, int]:
    """Return a message up to its point_step, and where its width is."""
    head = bytearray(LITTLE_ENDIAN + bytes(8))
    _add_text(head, frame_id)
    _add(head, 'I', 1)
    _add(head, 'I', 0)
    width_at = len(head) - 4
    _add(head, 'I', len(fields))
    for field in fields:
        _add_text(head, field.name)
        for kind, number in zip('IBI', field[1:], strict=True):
            _add(head, kind, number)
    _add(head, '?', False)
    head += bytes(-(len(head) - ENCAPSULATION) % 4)
    return bytes(head), width_at


def _add(message: bytearray, kind: str, number: int) -> None:
    message += bytes(-(len(message) - ENCAPSULATION) % struct.calcsize(kind))
    message += struct.pack(f'<{kind}', number)


def _add_text(message: bytearray, text: str) -> None:
    data = text.encode() + b'\0'
    _add(message, 'I', len(data))
    message += data
