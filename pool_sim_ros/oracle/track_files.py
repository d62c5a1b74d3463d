"""`read_tracks`: tracks from CSV files and recordings."""

from __future__ import annotations

import csv
import os
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.recordings import read_recording
from pool_sim_ros.oracle.tracks import Track
from pool_sim_ros.physics import Table

COLUMNS = ['t', 'ball', 'x', 'y']


def read_tracks(table: Table, paths: Sequence[str | os.PathLike[str]]) -> list[Track]:
    """Read tracks from files.

    Parameters
    ----------
    table : Table
        Whose labels stand in the column `ball`.
    paths : sequence of path
        A name that ends in .mcap is that of a recording, as `record_shot` writes it, and has the
        shots that were played in it. Any other file is a CSV with the columns t, ball, x and y, and
        has one shot.

    Returns
    -------
    list of Track
        In the order of the files, and of the shots in each.

    Raises
    ------
    OSError
        Where a file cannot be read.
    ValueError
        For a recording without shots, and a line that is none; names file and line.
    ModuleNotFoundError
        Where rosbags is not installed, which recordings need.
    """
    tracks: list[Track] = []
    for path in paths:
        if os.fspath(path).endswith('.mcap'):
            tracks += read_recording(table, path)
        else:
            tracks.append(read_track(table, path))
    return tracks


def read_track(table: Table, path: str | os.PathLike[str]) -> Track:
    """Read the track of a CSV file, as `read_tracks` does."""
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
