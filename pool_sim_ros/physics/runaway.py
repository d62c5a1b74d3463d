"""Shots that never end because each contact adds energy, as the report's law of friction can.

Under that law the second ball gains slip by friction, without a bound. Beside enough restitution
and too little other loss, the balls then meet ever faster, infinitely often in finite time.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import inlined
from pool_sim_ros.physics.tolerances import RUNAWAY_GAIN, RUNAWAY_SPEED


@inlined
def most_energy(balls: NDArray[np.void], table: Any, velocities: NDArray[np.float64]) -> float:
    """Return twice the kinetic energy in J with which a ball runs away.

    Parameters
    ----------
    balls : ndarray
    table : named tuple
    velocities : ndarray of shape (n or 1, 2)
        Of the first balls at the start, m/s.
    """
    if table.coulomb:
        return np.inf
    total = 0.0
    for i in range(len(velocities)):
        vx, vy = velocities[i, 0], velocities[i, 1]
        squared = max(vx * vx + vy * vy, RUNAWAY_SPEED * RUNAWAY_SPEED)
        total += squared / balls[i].inverse_mass
    return RUNAWAY_GAIN * total
