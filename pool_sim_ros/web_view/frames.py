"""What the topics show on its way to the page: ball poses, bytes to bytes, 60 times a second."""

from __future__ import annotations

import struct

import numpy as np

from pool_sim_ros.physics import EventKind
from pool_sim_ros.simulator import COLLISION_COLUMNS

_HEAD = 4
"""Bytes before the message itself (CDR encapsulation); alignment counts from its end."""

_POSE = 7
"""Numbers in a pose: position x, y, z and orientation x, y, z, w."""


def page_frame(message: bytes, *, whole: bool = False) -> bytes:
    """Return what a page is sent for one message of `~/ball_poses`.

    Parameters
    ----------
    message : bytes
        A serialised geometry_msgs/PoseArray (CDR, either byte order).
    whole : bool, optional
        Whether balls turn and fall into pockets.

    Returns
    -------
    bytes
        Little-endian float64: the stamp in s, then of each ball x, y in m or, if it is `whole`,
        x, y, z in m and its orientation x, y, z, w.

    Raises
    ------
    ValueError
        If these are not the bytes of a PoseArray, or a ball is nowhere.
    """
    try:
        order = '<' if message[1] & 1 else '>'
        seconds, nanoseconds, length = struct.unpack_from(f'{order}iII', message, _HEAD)
        place = _aligned(_HEAD + 12 + length, 4)
        (count,) = struct.unpack_from(f'{order}I', message, place)
        place = _aligned(place + 4, 8) if count else place
        numbers = np.frombuffer(message, f'{order}f8', count * _POSE, place)
    except (IndexError, struct.error, ValueError) as error:
        raise ValueError(f'these are not the bytes of a PoseArray: {error}') from error
    columns = _POSE if whole else 2
    frame = np.empty(1 + columns * count, dtype='<f8')
    frame[0] = seconds + nanoseconds * 1e-9
    frame[1:].reshape(count, columns)[:] = numbers.reshape(count, _POSE)[:, :columns]
    if not np.isfinite(frame).all():
        raise ValueError('ball_poses: a position is not finite')
    return frame.tobytes()


def frame_positions(frame: bytes, *, whole: bool = False) -> np.ndarray:
    """Return the (n, 2) positions in m of a frame that `page_frame` made."""
    return np.frombuffer(frame, '<f8', offset=8).reshape(-1, _POSE if whole else 2)[:, :2]


def check_count(frame: bytes, balls: int, *, whole: bool = False) -> None:
    """Raise ValueError where a frame that `page_frame` made has another number of balls."""
    count = len(frame_positions(frame, whole=whole))
    if count != balls:
        raise ValueError(f'ball_poses: {count} balls, where the table has {balls}')


def are_collisions(rows: np.ndarray, balls: int) -> bool:
    """Return whether rows of numbers are collisions on a table with so many balls."""
    if rows.shape[1] != len(COLLISION_COLUMNS) or not np.isfinite(rows).all():
        return False
    kinds, first, second = rows[:, 2], rows[:, 3], rows[:, 4]
    ends = np.where(kinds == EventKind.BALL_BALL, balls, np.inf)  # or a cushion
    return bool((_is_index(first, balls) & _is_index(second, ends)).all())


def _is_index(numbers: np.ndarray, end: np.ndarray | int) -> np.ndarray:
    good: np.ndarray = (numbers == np.floor(numbers)) & (numbers >= 0) & (numbers < end)
    return good


def _aligned(place: int, size: int) -> int:
    return place + (_HEAD - place) % size
