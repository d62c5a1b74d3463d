"""Where the balls would go: what a page draws while somebody aims."""

from __future__ import annotations

import numpy as np

from pool_sim_ros.physics import Table, simulate

LONGEST = 120.0
"""Seconds of play that are predicted; the default of the node's `max_shot_duration`."""


def predict(
    table: Table, positions: np.ndarray, velocity: tuple[float, float]
) -> dict[str, object]:
    """Return the paths of a shot.

    Parameters
    ----------
    table : Table
    positions : ndarray of shape (n, 2)
        Where the balls rest, m.
    velocity : tuple of float
        Of the cue ball, m/s.

    Returns
    -------
    dict
        ``paths``: for each ball that moves its index ``ball`` and ``points``, the corners of its
        way, [[x, y], ...] in m; ``duration``: s until all balls rest.

    Raises
    ------
    ValueError
        Where the balls cannot lie there.
    """
    shot = simulate(table, velocity, positions=positions, until=LONGEST)
    paths = [shot.path(i) for i in range(len(positions))]
    return {
        'paths': [{'ball': i, 'points': p.tolist()} for i, p in enumerate(paths) if len(p) > 1],
        'duration': shot.duration,
    }
