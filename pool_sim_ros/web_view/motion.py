"""A shot as a page gets it: the page looks positions up at any time, and draws the paths."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import EventKind, Trajectory

LONGEST = 120.0
"""Longest motion that is computed, in s of play: the default of the node's `max_shot_duration`."""

SHOWN = (EventKind.BALL_BALL, EventKind.CUSHION, EventKind.POCKETED)
"""Kinds of events that a page lists."""

EVENT_FIELDS = ('t', 'kind', 'a', 'b', 'x', 'y', 'speed')


def motion_fields(shot: Trajectory, start: NDArray[np.float64]) -> dict[str, object]:
    """Return the motion of all balls as fields for JSON.

    Parameters
    ----------
    shot : Trajectory
    start : ndarray of shape (n, 2)
        Where the balls start, m.

    Returns
    -------
    dict
        ``start`` and ``ends``: (n, 2) in m; ``duration`` in s; ``pocketed``: (n,), -1 for none;
        ``segments``: rows of ball, t, x, y, vx, vy, ax, ay and, where balls spin, wx, wy, wz,
        turn_x, turn_y, as `Trajectory.segments` has them, of the balls that move.
    """
    return {
        'start': np.asarray(start).tolist(),
        'ends': shot.final_positions.tolist(),
        'duration': shot.duration,
        'pocketed': shot.pocketed.tolist(),
        'segments': _rows(shot.segments[_moves(shot)], shot.segments.dtype.names or ()),
    }


def event_rows(shot: Trajectory) -> list[list[float]]:
    """Return the contacts and the catches of a shot, (k, 7) in the order of `EVENT_FIELDS`."""
    return _rows(shot.events[np.isin(shot.events['kind'], SHOWN)], EVENT_FIELDS)


def _moves(shot: Trajectory) -> NDArray[np.bool_]:
    """Return of each segment whether its ball moves or turns in this shot."""
    balls = shot.segments['ball']
    still = np.bincount(balls, minlength=len(shot.final_positions)) == 1
    for name in ('vx', 'vy', 'wx', 'wy', 'wz'):
        if name in (shot.segments.dtype.names or ()):
            still[balls[shot.segments[name] != 0.0]] = False
    moves: NDArray[np.bool_] = ~still[balls]
    return moves


def _rows(records: NDArray[np.void], names: tuple[str, ...]) -> list[Any]:
    if not len(records):
        return []
    rows: list[Any] = np.column_stack([records[name] for name in names]).tolist()
    return rows
