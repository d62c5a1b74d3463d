"""What an action does to the cue ball."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table
from pool_sim_ros.study.checks import positive

MISCUE_OFFSET = 0.5
"""How far from the middle the tip meets the ball at most, in radii: farther out it slips off."""

SPIN_PER_OFFSET = 5.0 / 2.0
"""m R^2 / I of a sphere."""

MAX_SPEED = 1000.0
"""m/s; no cue comes near."""


class Strikes:
    """Turns actions into velocities and spins.

    Parameters
    ----------
    table : Table
    speed : float
        Of the cue ball along x or y at most, m/s.

    Attributes
    ----------
    count : int
        Numbers of an action, each -1 to 1: the velocity of the cue ball as parts of `speed`, along
        x and y. Where balls spin, two more say where the tip of a level cue meets the ball: to the
        left and above the middle, as parts of half a radius; beyond that circle it counts as on it.

    Raises
    ------
    ValueError
        Where the speed is not above 0.
    """

    def __init__(self, table: Table, speed: float) -> None:
        self._speed = positive('speed', speed, 'm/s', MAX_SPEED)
        self._spins = table.motion == 'ball'
        self._rate = SPIN_PER_OFFSET * MISCUE_OFFSET / table.balls[0].radius
        self.count = 4 if self._spins else 2

    def of(
        self, actions: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64] | None]:
        """Return velocities, (m, 2) in m/s, and spins, (m, 3) in rad/s, or None for discs.

        Parameters
        ----------
        actions : ndarray of shape (m, count)
            What is beyond -1 or 1 counts as these.
        """
        within = np.minimum(np.maximum(actions, -1.0), 1.0)
        if not self._spins:
            within *= self._speed
            return within, None
        velocities = within[:, :2] * self._speed
        left, above = within[:, 2], within[:, 3]
        rate = self._rate / np.maximum(np.sqrt(left * left + above * above), 1.0)
        x, y = velocities[:, 0], velocities[:, 1]
        spins = np.empty((len(actions), 3))
        up = rate * above
        np.multiply(up, y, out=spins[:, 0])
        np.multiply(up, x, out=spins[:, 1])
        np.multiply(rate * left, np.sqrt(x * x + y * y), out=spins[:, 2])
        turned = spins[:, ::2]
        np.negative(turned, out=turned)
        return velocities, spins
