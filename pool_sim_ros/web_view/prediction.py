"""Where the balls would go: a page draws it while somebody aims."""

from __future__ import annotations

import numpy as np

from pool_sim_ros.physics import Table, simulate

LONGEST = 120.0
"""Longest prediction, in s of play: the default of the node's `max_shot_duration`."""


def predict(
    table: Table, positions: np.ndarray, velocity: tuple[float, float]
) -> dict[str, object]:
    """Return the paths of a shot.

    Parameters
    ----------
    table : Table
    positions : ndarray of shape (n, 2)
        Positions of the resting balls, m.
    velocity : tuple of float
        Of the cue ball, m/s.

    Returns
    -------
    dict
        ``paths``: for each ball that moves its index ``ball`` and ``points``, the corners of its
        path, [[x, y], ...] in m; ``duration``: time until all balls rest, s.

    Raises
    ------
    ValueError
        If the balls cannot lie there.
    """
    shot = simulate(table, velocity, positions=positions, until=LONGEST)
    paths = [shot.path(i) for i in range(len(positions))]
    return {
        'paths': [{'ball': i, 'points': p.tolist()} for i, p in enumerate(paths) if len(p) > 1],
        'duration': shot.duration,
    }
