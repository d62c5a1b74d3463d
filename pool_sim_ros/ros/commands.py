"""Commands as bytes: their length is looked at before anything is made of them."""

from __future__ import annotations

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


def layout_bytes(balls: int) -> int:
    """Return how many bytes the poses of so many balls have at the most."""
    return HEAD_BYTES + POSE_BYTES * balls


def reader(
    kind: Any, most: int, take: Callable[[Any], None], refuse: Callable[[str], None]
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
    """
    name = '/'.join((kind.__module__.split('.')[0], 'msg', kind.__name__))

    def read(data: bytes) -> None:
        if len(data) > most:
            refuse(f'the message has {len(data)} bytes; at most {most} are read')
            return
        try:
            message = deserialize_message(data, kind)
        except Exception:
            refuse(f'a message of {len(data)} bytes is no {name}')
            return
        take(message)

    return read
