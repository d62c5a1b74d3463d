"""`what_if`: what comes of very many strokes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pool_sim_ros.oracle.cluster import Cluster
from pool_sim_ros.physics import Outcomes, Table, simulate_many


def what_if(
    table: Table,
    candidates: ArrayLike,
    *,
    positions: ArrayLike | None = None,
    events: bool = False,
    threads: int | None = None,
    cluster: Cluster | None = None,
) -> Outcomes:
    """Return what would come of each candidate, exactly, without noise.

    Parameters
    ----------
    table : Table
    candidates : array_like of shape (m, 2) or (m, 5)
        Velocities of the cue ball, vx, vy in m/s; where balls spin also its spins, wx, wy, wz in
        rad/s.
    positions : array_like of shape (n, 2) or (m, n, 2), optional
        Where the balls start instead of their own places, m.
    events : bool, optional
        Whether to keep all events.
    threads : int, optional
        At most so many; by default one for each core.
    cluster : Cluster, optional
        Where to play instead.

    Returns
    -------
    Outcomes
        Bit for bit those of `simulate_many`; a shot that fails is marked there.

    Raises
    ------
    ValueError
        For a wrong shape, and a value that is not finite or too large.
    ClusterError
        Where the cluster does not play.
    """
    try:
        rows = np.asarray(candidates, dtype=float)
    except (TypeError, ValueError):
        raise ValueError('candidates: they are not an array of numbers') from None
    if rows.ndim != 2 or rows.shape[1] not in (2, 5):
        raise ValueError(f'candidates: shape {rows.shape} must be (m, 2) or (m, 5)')
    play = simulate_many if cluster is None else cluster.simulate_many
    return play(
        table,
        rows[:, :2],
        spins=rows[:, 2:] if rows.shape[1] == 5 else None,
        positions=positions,
        events=events,
        errors='mark',
        threads=threads,
    )
