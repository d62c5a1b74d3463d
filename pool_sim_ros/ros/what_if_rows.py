"""Candidates and what comes of them as the rows of point clouds: pure, without ROS."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.ros.oracle_error import OracleCode, OracleError
from pool_sim_ros.ros.point_cloud import (
    NAMES,
    Cloud,
    Field,
    Stamp,
    check_sizes,
    cloud_bytes,
    cloud_of_parts,
    read_cloud,
    rows_of,
)

if TYPE_CHECKING:  # they load numba
    from pool_sim_ros.physics import Outcomes, Table

MOST_CANDIDATES = 50_000
"""Of one request: what they answer is 12 MB where there are 11 balls."""

ROOM_BYTES = 64
"""Bytes of a candidate that are read: its five numbers, and what a sender adds to align them."""

REQUEST_BYTES = 4096 + ROOM_BYTES * MOST_CANDIDATES
"""Bytes of a request that are read, with its head."""

BLOCK = 512
"""Rows that are packed or unpacked together: they stay in the cache from column to column."""

VELOCITY, SPIN = ('vx', 'vy'), ('wx', 'wy', 'wz')
"""Fields of a candidate, m/s and rad/s."""


class WhatIf(NamedTuple):
    """What would come of m candidates with n balls, as `simulate_many` has it, bit for bit.

    Attributes
    ----------
    labels : tuple of n str
    finals : ndarray of shape (m, n, 2)
        Where the balls end, m; NaN where a shot cannot be played to its end.
    durations : ndarray of shape (m,)
        Time until the last ball rests, s.
    event_counts : ndarray of shape (m,)
    first_hit : ndarray of shape (m,)
        The ball that the cue ball touches first, -1 for none.
    pocketed : ndarray of shape (m, n)
        Number of the pocket in which a ball is, -1 for none.
    """

    labels: tuple[str, ...]
    finals: NDArray[np.float64]
    durations: NDArray[np.float64]
    event_counts: NDArray[np.int32]
    first_hit: NDArray[np.int32]
    pocketed: NDArray[np.int32]


def request_bytes(stamp: Stamp, frame_id: str, candidates: ArrayLike) -> bytes:
    """Return the message that asks what comes of candidates.

    Parameters
    ----------
    stamp : (int, int)
        The client's own random number.
    frame_id : str
        Frame of the table.
    candidates : array_like of shape (m, 2) or (m, 5)
        vx, vy in m/s; where balls spin also wx, wy, wz in rad/s.

    Raises
    ------
    ValueError
        For another shape, none, or too many.
    """
    try:
        given = np.ascontiguousarray(candidates, dtype='<f8')
    except (TypeError, ValueError):
        raise ValueError('candidates: they are not an array of numbers') from None
    if given.ndim != 2 or given.shape[1] not in (2, 5):
        raise ValueError(f'candidates: shape {given.shape} must be (m, 2) or (m, 5)')
    if not 1 <= len(given) <= MOST_CANDIDATES:
        raise ValueError(f'candidates: {len(given)} must be 1 to {MOST_CANDIDATES}')
    names = (VELOCITY + SPIN)[: given.shape[1]]
    return cloud_bytes(stamp, frame_id, given.view([(name, '<f8') for name in names])[:, 0])


def candidates_from(message: bytes, frame_id: str) -> NDArray[np.float64]:
    """Return the candidates that a message asks for in a frame, (m, 2) or (m, 5).

    Raises
    ------
    OracleError
        Where it is no such request; says what is wrong.
    """
    if len(message) > REQUEST_BYTES:
        raise OracleError(
            OracleCode.TOO_MANY,
            f'the message has {len(message)} bytes; at most {REQUEST_BYTES} are read, '
            f'{MOST_CANDIDATES} candidates of {ROOM_BYTES} bytes',
        )
    try:
        cloud = read_cloud(message)
    except ValueError as error:
        raise OracleError(OracleCode.BAD_REQUEST, str(error)) from None
    if cloud.frame_id != frame_id:
        reason = f'frame_id: {cloud.frame_id!r:.60} must be {frame_id!r}'
        raise OracleError(OracleCode.BAD_FRAME, reason)
    _check_size(cloud)
    try:
        rows = rows_of(cloud)
        names = _checked_names(cloud, rows.dtype)
    except ValueError as error:
        raise OracleError(OracleCode.BAD_FIELDS, str(error)) from None
    candidates = np.empty((len(rows), len(names)))
    for column, name in enumerate(names):
        candidates[:, column] = rows[name]
    return candidates


def _check_size(cloud: Cloud) -> None:
    if cloud.height != 1:
        reason = f'height: {cloud.height} must be 1, with one candidate a column'
        raise OracleError(OracleCode.BAD_FIELDS, reason)
    if cloud.width == 0:
        raise OracleError(OracleCode.BAD_REQUEST, 'width: 0, there are no candidates')
    if cloud.width > MOST_CANDIDATES:
        reason = f'width: {cloud.width} candidates; at most {MOST_CANDIDATES} are taken at once'
        raise OracleError(OracleCode.TOO_MANY, reason)
    if cloud.is_bigendian:
        raise OracleError(OracleCode.BAD_FIELDS, 'is_bigendian: must be false')


def _checked_names(cloud: Cloud, layout: np.dtype[Any]) -> tuple[str, ...]:
    given = {field.name: field for field in cloud.fields}
    names = VELOCITY + SPIN if any(name in given for name in SPIN) else VELOCITY
    if set(given) != set(names):
        shown = ', '.join(given)
        raise ValueError(
            f'fields: {shown:.200} must be {", ".join(VELOCITY)}, and where balls spin also '
            f'{", ".join(SPIN)}'
        )
    for name in names:
        kind = NAMES[layout[name].base.str[1:]]
        if kind != 'FLOAT64':
            raise ValueError(f'fields: {name} is {kind} and must be FLOAT64')
        if given[name].numbers != 1:
            raise ValueError(f'fields: {name} has count {given[name].numbers}, which must be 1')
    return names


def answer_bytes(stamp: Stamp, frame_id: str, table: Table, outcomes: Outcomes) -> bytes:
    """Return the message that says what comes of candidates.

    Parameters
    ----------
    stamp : (int, int)
        Of the request.
    frame_id : str
    table : Table
    outcomes : Outcomes
        Of m candidates, at least one.
    """
    layout, fields = _answer_layout(table.labels)
    count, radius = len(outcomes.durations), table.balls[0].radius
    block = np.zeros(min(BLOCK, count), layout)

    def parts() -> Iterator[NDArray[Any]]:
        for first in range(0, count, BLOCK):
            part = slice(first, min(first + BLOCK, count))
            rows = block[: part.stop - first]
            finals, pocketed = outcomes.finals[part], outcomes.pocketed[part]
            rows['x'], rows['y'] = finals[:, 0, 0], finals[:, 0, 1]
            height = np.where(pocketed[:, 0] < 0, radius, -radius)
            rows['z'] = np.where(outcomes.failed[part] == 0, height, np.nan)
            rows['duration'] = outcomes.durations[part]
            rows['finals'] = finals
            rows['events'] = outcomes.event_counts[part]
            rows['first_hit'] = outcomes.first_hit[part]
            rows['pocketed'] = pocketed
            yield rows

    dense, size = not outcomes.failed.any(), (count, layout.itemsize)
    return cloud_of_parts(stamp, frame_id, fields, size, parts(), dense)


def no_answer_bytes(stamp: Stamp, frame_id: str) -> bytes:
    """Return the message that goes with a rejection: a cloud without points."""
    return cloud_bytes(stamp, frame_id, np.zeros(0, [('x', '<f4'), ('y', '<f4'), ('z', '<f4')]))


@lru_cache(64)
def _answer_layout(labels: tuple[str, ...]) -> tuple[np.dtype[Any], tuple[Field, ...]]:
    """Return the type of a row, and what its numbers are called."""
    count = len(labels)
    layout = np.dtype(
        [
            *[(name, '<f4') for name in 'xyz'],
            ('duration', '<f8'),
            ('finals', '<f8', (count, 2)),
            ('events', '<i4'),
            ('first_hit', '<i4'),
            ('pocketed', '<i4', (count,)),
        ],
        align=True,
    )
    flat = {'finals': [f'{axis}_{label}' for label in labels for axis in 'xy']}
    flat['pocketed'] = [f'pocketed_{label}' for label in labels]
    types = {'<f4': 7, '<f8': 8, '<i4': 5}
    fields: list[Field] = []
    assert layout.fields is not None
    for name, (kind, offset, *_) in layout.fields.items():
        size = kind.base.itemsize
        fields += (
            Field(column, offset + size * k, types[kind.base.str], 1)
            for k, column in enumerate(flat.get(name, [name]))
        )
    return layout, tuple(fields)


def answer_from(message: bytes) -> tuple[Stamp, WhatIf | None]:
    """Return what a message says came of candidates; None where it has no points.

    Raises
    ------
    ValueError
        Where it is no such message.
    """
    cloud = read_cloud(message)
    if cloud.width == 0:
        return cloud.stamp, None
    labels = tuple(f.name[2:] for f in cloud.fields if f.name.startswith('x_'))
    layout, fields = _answer_layout(labels)
    if (cloud.fields, cloud.point_step) != (fields, layout.itemsize) or cloud.is_bigendian:
        raise ValueError('a point cloud that is no answer of an oracle')
    check_sizes(cloud)
    rows = np.frombuffer(cloud.data, layout)
    columns = [rows[name] for name in ('finals', 'duration', 'events', 'first_hit', 'pocketed')]
    found = [np.empty(column.shape, column.dtype) for column in columns]
    for first in range(0, len(rows), BLOCK):
        for column, copy in zip(columns, found, strict=True):
            copy[first : first + BLOCK] = column[first : first + BLOCK]
    return cloud.stamp, WhatIf(labels, *found)
