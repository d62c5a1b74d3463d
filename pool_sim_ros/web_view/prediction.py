"""Where the balls would go: a page draws it while somebody aims."""

from __future__ import annotations

from typing import Any

import numpy as np

from pool_sim_ros.physics import Table, cue_strike, simulate
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
    velocity, spin = strike_of(table, strike)
    shot = simulate(table, velocity, spins=spin, positions=positions, until=LONGEST)
    return {'asked': strike, 'velocity': velocity, 'spin': spin, **motion_fields(shot, positions)}


def strike_of(table: Table, strike: dict[str, Any]) -> tuple[list[float], list[float] | None]:
    """Return velocity, m/s, and spin, rad/s, of the cue ball; no spin where balls are discs."""
    if 'cue' in strike:
        if table.motion != 'ball':
            raise ValueError('cue: on a table of discs there is no spin; give a velocity')
        velocity, spin = cue_strike(table, **strike['cue'])
        return velocity.tolist(), spin.tolist()
    still = [0.0, 0.0, 0.0] if table.motion == 'ball' else None
    return list(strike['velocity']), strike.get('spin', still)
