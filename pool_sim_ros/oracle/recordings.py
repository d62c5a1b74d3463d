"""Tracks from an MCAP file: what `record_shot` writes, or any recording of such topics.

rosbags reads it, which needs no ROS.
"""

from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.tracks import Track
from pool_sim_ros.physics import Table

POSES, ANSWERS = 'ball_poses', 'shot/response'
"""How the names of the two topics end."""

TYPES = {POSES: 'geometry_msgs/msg/PoseArray', ANSWERS: 'std_msgs/msg/String'}

REST = 0.2
"""s after a shot whose frames still count: the balls rest."""

SECOND = 1_000_000_000
"""ns."""


def read_recording(table: Table, path: str | os.PathLike[str]) -> list[Track]:
    """Read the tracks of all shots that were played to their end.

    Parameters
    ----------
    table : Table
        With as many balls as the poses have.
    path : path
        Of an MCAP file with one topic `.../ball_poses` and one `.../shot/response`. The latter says
        when the cue struck, and with which spin.

    Raises
    ------
    OSError
        Where the file cannot be read.
    ValueError
        Where it is no such recording; names the file.
    ModuleNotFoundError
        Where rosbags is not installed.
    """
    try:
        stamps, places, answers = contents(Path(path))
    except (OSError, ModuleNotFoundError):
        raise
    except Exception as error:  # whatever a damaged file makes of its reader
        raise ValueError(f'{path}: it is no recording of shots: {error}') from error
    wrong = next((len(frame) for frame in places if len(frame) != len(table.balls)), None)
    if wrong is not None:
        raise ValueError(f'{path}: a frame has {wrong} balls; the table has {len(table.balls)}')
    done = [answer for answer in answers if is_shot(answer)]
    if not done:
        raise ValueError(f'{path}: no shot in it was played to its end')
    begins = [round(answer['t_start'] * SECOND) for answer in done]
    tracks = []
    for answer, begin, after in zip(done, begins, [*begins[1:], None], strict=True):
        end = round((answer['t_end'] + REST) * SECOND)
        here = (stamps >= begin) & (stamps <= end)
        if after is not None:
            here &= stamps < after
        frames = np.array([places[k] for k in np.flatnonzero(here)]).reshape(-1, *places[0].shape)
        tracks.append(Track((stamps[here] - begin) / SECOND, frames, spin=answer.get('spin')))
    return tracks


def contents(path: Path) -> tuple[NDArray[np.int64], list[NDArray[np.float64]], list[Any]]:
    """Return the stamps of the frames, ns, their places, each (n, 2) in m, and the answers."""
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    frames: dict[int, NDArray[np.float64]] = {}
    answers = []
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        for connection, _, data in reader.messages([only(reader.connections, POSES)]):
            message: Any = reader.deserialize(data, connection.msgtype)
            stamp = message.header.stamp.sec * SECOND + message.header.stamp.nanosec
            frames[stamp] = np.array([(p.position.x, p.position.y) for p in message.poses])
        for connection, _, data in reader.messages([only(reader.connections, ANSWERS)]):
            message = reader.deserialize(data, connection.msgtype)
            answers.append(json.loads(message.data))
    stamps = sorted(frames)
    return np.array(stamps, np.int64), [frames[stamp] for stamp in stamps], answers


def only(connections: Any, name: str) -> Any:
    """Return the connection of the only topic with a name of this end."""
    found = [c for c in connections if f'/{c.topic}'.endswith(f'/{name}')]
    topics = sorted({c.topic for c in found})
    if len(topics) != 1:
        raise ValueError(f'it needs one topic {name}, not {", ".join(topics) or "none"}')
    if found[0].msgtype != TYPES[name]:
        raise ValueError(f'{topics[0]} is a {found[0].msgtype}, not a {TYPES[name]}')
    return found[0]


def is_shot(answer: Any) -> bool:
    """Return whether an answer says that a shot was played to its end."""
    if not isinstance(answer, dict) or answer.get('phase') != 'done':
        return False
    times = [answer.get(name) for name in ('t_start', 't_end')]
    return answer.get('velocity') is not None and all(
        isinstance(time, (int, float)) and math.isfinite(time) for time in times
    )
