"""Tracks: where somebody saw the balls of a shot, frame by frame."""

from __future__ import annotations

import csv
import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics import Table

COLUMNS = ['t', 'ball', 'x', 'y']


@dataclass(frozen=True, eq=False)
class Track:
    """One shot as somebody saw it.

    Parameters
    ----------
    times : array_like of shape (k,)
        Of the frames, s since the cue struck, rising; before 0 all balls rest.
    positions : array_like of shape (k, n, 2)
        Where the balls were seen, m; NaN where one was not.
    spin : array_like of shape (3,), optional
        A first guess of the spin that the cue gave, rad/s, as `cue_strike` returns it; without it
        that the ball rolls.

    Raises
    ------
    ValueError
        For a wrong shape, times that do not rise or are not finite.
    """

    times: NDArray[np.float64]
    positions: NDArray[np.float64]
    spin: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        times, positions = as_floats('times', self.times), as_floats('positions', self.positions)
        if times.ndim != 1 or positions.ndim != 3 or positions.shape[::2] != (len(times), 2):
            raise ValueError(
                f'track: shapes {times.shape} and {positions.shape} must be (k,) and (k, n, 2)'
            )
        if not (np.isfinite(times).all() and (np.diff(times) > 0.0).all()):
            raise ValueError('track: times must be finite and rise')
        if self.spin is not None:
            spin = as_floats('spin', self.spin)
            if spin.shape != (3,) or not np.isfinite(spin).all():
                raise ValueError(f'track: spin {spin.tolist()} must be three finite numbers')
            object.__setattr__(self, 'spin', spin)
        object.__setattr__(self, 'times', times)
        object.__setattr__(self, 'positions', positions)


def read_tracks(table: Table, paths: Sequence[str | os.PathLike[str]]) -> list[Track]:
    """Read tracks from CSV files, one shot each, with the columns t, ball, x and y.

    Parameters
    ----------
    table : Table
        Whose labels stand in the column `ball`.
    paths : sequence of path

    Returns
    -------
    list of Track

    Raises
    ------
    OSError
        Where a file cannot be read.
    ValueError
        For a line that is none; names file and line.
    """
    return [read_track(table, path) for path in paths]


def read_track(table: Table, path: str | os.PathLike[str]) -> Track:
    """Read one track, as `read_tracks` does."""
    seen: dict[float, NDArray[np.float64]] = {}
    with open(path, newline='', encoding='utf-8') as file:
        lines = csv.reader(file)
        if next(lines, None) != COLUMNS:
            raise ValueError(f'{path}: line 1 must be {",".join(COLUMNS)}')
        for line in lines:
            where = f'{path}: line {lines.line_num}'
            if len(line) != 4:
                raise ValueError(f'{where}: {len(line)} fields must be 4')
            try:
                t, x, y = float(line[0]), float(line[2]), float(line[3])
            except ValueError:
                raise ValueError(f'{where}: t, x and y must be numbers') from None
            if line[1] not in table.labels:
                raise ValueError(f'{where}: ball {line[1]!r} is not on the table')
            frame = seen.setdefault(t, np.full((len(table.balls), 2), np.nan))
            frame[table.labels.index(line[1])] = x, y
    times = sorted(seen)
    if not times:
        raise ValueError(f'{path}: there is no frame in it')
    return Track(np.array(times), np.array([seen[t] for t in times]))


def as_floats(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return an array of floats; raise ValueError, naming it, where it is none."""
    try:
        return np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f'track: {name} are not an array of numbers') from None
