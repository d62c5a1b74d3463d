"""Commands as bytes: their length is looked at before anything is made of them."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

from rclpy.serialization import deserialize_message

from pool_sim_ros.simulator import MAX_REQUEST_LENGTH

HEAD_BYTES = 4096
"""Bytes of a command beside its numbers: none is near it, unless it has a very long frame_id."""

TWIST_BYTES = HEAD_BYTES + 6 * 8
"""Bytes of a twist: six numbers."""

REQUEST_BYTES = HEAD_BYTES + 4 * MAX_REQUEST_LENGTH
"""Bytes of a request: a character has at most four in UTF-8."""

POSE_BYTES = 7 * 8
"""Bytes of a pose: seven numbers."""


_HEADER = 4
"""Bytes before every message; numbers are aligned to what follows them."""

_FRAME_ID = _HEADER + 8
"""Where the frame_id of a message with a header begins: after its stamp."""


def layout_bytes(balls: int) -> int:
    """Return how many bytes the poses of so many balls have at the most."""
    return HEAD_BYTES + POSE_BYTES * balls


def count_poses(data: bytes) -> int | None:
    """Return how many poses the bytes of a pose array hold; None where they are no pose array."""
    order = '<' if data[1:2] == b'\1' else '>'
    try:
        (frame_id,) = struct.unpack_from(f'{order}I', data, _FRAME_ID)
        start = _FRAME_ID + 4 + frame_id
        start += -start % 4
        (count,) = struct.unpack_from(f'{order}I', data, start)
    except struct.error:
        return None
    start += 4
    start += -(start - _HEADER) % 8
    return count if start + POSE_BYTES * count == len(data) else None


def reader(
    kind: Any,
    most: int,
    take: Callable[[Any], None],
    refuse: Callable[[str], None],
    too_long: Callable[[bytes], str | None] = lambda data: None,
) -> Callable[[bytes], None]:
    """Return the callback of a subscription with ``raw=True``.

    To make a message of 3,000,000 poses from its bytes takes seconds and 2 GB; of their number a
    look at the length is enough.

    Parameters
    ----------
    kind : type
        Of the message.
    most : int
        Length in bytes above which no message is made.
    take : callable
        Called with each message.
    refuse : callable
        Called instead, in words, where the bytes are too many or are no message.
    too_long : callable, optional
        Says of bytes that are too many what is wrong; None: that they are too many.
    """
    name = '/'.join((kind.__module__.split('.')[0], 'msg', kind.__name__))

    def read(data: bytes) -> None:
        if len(data) > most:
            reason = f'the message has {len(data)} bytes; at most {most} are read'
            refuse(too_long(data) or reason)
            return
        try:
            message = deserialize_message(data, kind)
        except Exception:
            refuse(f'a message of {len(data)} bytes is no {name}')
            return
        take(message)

    return read
