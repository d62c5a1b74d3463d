"""Where the balls would go: a page draws it while somebody aims."""

from __future__ import annotations

from typing import Any

import numpy as np

from pool_sim_ros.physics import Table, simulate
from pool_sim_ros.simulator import RefusedError, Request, strike_on
from pool_sim_ros.web_view.motion import LONGEST, motion_fields


def predict(table: Table, positions: np.ndarray, strike: dict[str, Any]) -> dict[str, object]:
    """Return what a strike would do.

    Parameters
    ----------
    table : Table
    positions : ndarray of shape (n, 2)
        Positions of the resting balls, m.
    strike : dict
        As a request has it: ``velocity`` in m/s, with or without ``spin`` in rad/s, or ``cue``.

    Returns
    -------
    dict
        The fields of `motion_fields`; ``velocity`` and ``spin`` of the cue ball; ``asked``: the
        strike.

    Raises
    ------
    ValueError
        If the balls cannot lie there, or nobody can strike like this.
    """
    try:
        velocity, spin = strike_on(table, Request(**strike))
    except RefusedError as error:
        raise ValueError(error.reason) from None
    shot = simulate(table, velocity, spins=spin, positions=positions, until=LONGEST)
    return {
        'asked': strike,
        'velocity': list(velocity),
        'spin': None if spin is None else list(spin),
        **motion_fields(shot, positions),
    }
