"""A trajectory as a file of NumPy's npz format: arrays, and the table as JSON."""

from __future__ import annotations

import os
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.log import EVENT
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.table_file import table_of_text, table_text
from pool_sim_ros.physics.trajectory import Trajectory
from pool_sim_ros.physics.validation import number

FORMAT = 'pool_sim_ros trajectory'
VERSION = 1

UNREADABLE = (ValueError, EOFError, NotImplementedError, zipfile.BadZipFile, zlib.error)
"""What NumPy raises for a file, or an array in it, that is damaged or of another kind."""


def save_trajectory(shot: Trajectory, path: str | os.PathLike[str]) -> None:
    """Write a trajectory to a file of exactly this name."""
    with open(Path(path).expanduser(), 'wb') as file:
        np.savez_compressed(
            file,
            format=FORMAT,
            version=VERSION,
            table=table_text(shot.table),
            final_positions=shot.final_positions,
            final_velocities=shot.final_velocities,
            duration=shot.duration,
            events=shot.events,
            segments=shot.segments,
            complete=shot.complete,
            pocketed=shot.pocketed,
        )


def load_trajectory(path: str | os.PathLike[str]) -> Trajectory:
    """Read a trajectory from a file.

    Raises
    ------
    ValueError
        Where it is no such file; names the file, and the field that is wrong.
    OSError
    """
    file = Path(path).expanduser()
    try:
        with open(file, 'rb') as opened:
            return _trajectory(_arrays(opened))
    except ValueError as error:
        raise ValueError(f'{file}: {error}') from None


def _arrays(file: Any) -> dict[str, NDArray[Any]]:
    """Return all arrays of an npz file by their names."""
    try:
        archive = np.load(file, allow_pickle=False)
    except UNREADABLE:
        raise ValueError(f'it is no {FORMAT}') from None
    if not isinstance(archive, np.lib.npyio.NpzFile):
        raise ValueError(f'it is no {FORMAT}')
    arrays = {}
    for name in archive.files:
        try:
            arrays[name] = archive[name]
        except UNREADABLE:
            raise ValueError(f'{name}: it is damaged') from None
    return arrays


def _trajectory(arrays: dict[str, NDArray[Any]]) -> Trajectory:
    if str(arrays.get('format')) != FORMAT:
        raise ValueError(f'it is no {FORMAT}')
    if str(arrays.get('version')) != str(VERSION):
        raise ValueError(f'version: {arrays.get("version")} must be {VERSION}')
    try:
        table = table_of_text(str(_field(arrays, 'table', ())))
    except ValueError as error:
        raise ValueError(f'table: {error}') from None
    n, floats = len(table.balls), np.dtype(np.float64)
    duration = _field(arrays, 'duration', (), floats)
    return Trajectory(
        table,
        _field(arrays, 'final_positions', (n, 2), floats),
        _field(arrays, 'final_velocities', (n, 2), floats),
        number('duration', duration.item(), least=0.0),
        _field(arrays, 'events', (None,), EVENT),
        _segments(arrays, table),
        bool(_field(arrays, 'complete', (), np.dtype(np.bool_))),
        _pocketed(arrays, table),
    )


def _field(
    arrays: dict[str, NDArray[Any]],
    name: str,
    shape: tuple[int | None, ...],
    dtype: np.dtype[Any] | None = None,
) -> NDArray[Any]:
    """Return an array of this shape, in which None stands for any length, and of this type."""
    if name not in arrays:
        raise ValueError(f'{name}: it is missing')
    array = arrays[name]
    fits = len(array.shape) == len(shape) and all(
        wanted in (None, given) for wanted, given in zip(shape, array.shape, strict=True)
    )
    if not fits:
        wanted = tuple('k' if length is None else length for length in shape)
        raise ValueError(f'{name}: shape {array.shape} must be {wanted}')
    if dtype is not None and array.dtype != dtype:
        raise ValueError(f'{name}: it has type {array.dtype}, not {dtype}')
    return array


def _segments(arrays: dict[str, NDArray[Any]], table: Table) -> NDArray[np.void]:
    """Return the segments; the kernels that look them up rely on what is checked here."""
    segments = _field(arrays, 'segments', (None,), table.segment_type)
    n, balls, times = len(table.balls), segments['ball'], segments['t']
    if not np.array_equal(np.unique(balls), np.arange(n)):
        raise ValueError(f'segments: they must be of the {n} balls of the table, some of each')
    if not (np.isfinite(times).all() and np.all(np.diff(times) >= 0.0)):
        raise ValueError('segments: their times must be finite and in order')
    return segments


def _pocketed(arrays: dict[str, NDArray[Any]], table: Table) -> NDArray[np.int64]:
    pocketed = _field(arrays, 'pocketed', (len(table.balls),), np.dtype(np.int64))
    wrong = (pocketed < -1) | (pocketed >= len(table.pockets))
    if wrong.any():
        raise ValueError(
            f'pocketed: {pocketed[wrong][0]} must be -1 or one of {len(table.pockets)} pockets'
        )
    return pocketed
