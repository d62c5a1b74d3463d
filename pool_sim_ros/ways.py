"""The ways that the balls of a shot go: straight from contact to contact."""

from __future__ import annotations

import numpy as np

from pool_sim_ros.physics import Trajectory


def waypoints(trajectory: Trajectory, ball: int) -> np.ndarray:
    """Return the corners of a ball's way, from its start to its end.

    Between two contacts a ball goes straight, since friction on the cloth acts against its motion.

    Parameters
    ----------
    trajectory : Trajectory
    ball : int
        Its index.

    Returns
    -------
    ndarray of shape (k, 2)
        m; no corner twice in a row, so that a ball that never moves has one.
    """
    segments = trajectory.segments[trajectory.segments['ball'] == ball]
    corners = np.column_stack([segments['x'], segments['y']])
    corners = np.vstack([corners, trajectory.final_positions[ball]])
    new = np.any(np.diff(corners, axis=0) != 0.0, axis=1)
    return corners[np.concatenate([[True], new])]
