"""Many strokes of a cue at once, and many directions."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics.cue import (
    CUE_MASS,
    END_MASS_RATIO,
    MISCUE_OFFSET,
    SPIN_PER_OFFSET,
    struck,
)
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import ROUNDING_OF_OFFSET

Floats = NDArray[np.float64]

STRAIGHT = np.array([1.0, 0.0, -1.0, 0.0]), np.array([0.0, 1.0, 0.0, -1.0])
"""Cosines and sines of 0, 90, 180 and 270 degrees."""


def cue_strikes(
    table: Table,
    speed: ArrayLike,
    azimuth: ArrayLike,
    elevation: ArrayLike = 0.0,
    side: ArrayLike = 0.0,
    above: ArrayLike = 0.0,
) -> tuple[Floats, Floats]:
    """Return the velocities and the spins that strokes give the cue ball, as `cue_strike` does.

    Parameters
    ----------
    table : Table
        Whose cue ball is struck, ``table.balls[0]``.
    speed, azimuth, elevation, side, above : array_like
        As of `cue_strike`: m/s, degrees, and parts of the radius; of one shape (m,), or numbers.

    Returns
    -------
    velocities : ndarray of shape (m, 2)
        m/s. NaN where the tip slips off (a miscue), and where the speed is below 0 or the elevation
        not from 0 to 90.
    spins : ndarray of shape (m, 3)
        rad/s, NaN as above.

    Raises
    ------
    ValueError
        Where the shapes do not go together.
    """
    given = (np.asarray(each, dtype=float) for each in (speed, azimuth, elevation, side, above))
    speeds, azimuths, elevations, sides, aboves = np.broadcast_arrays(*given)
    forward = unit_vectors(azimuths)
    turn = _squirt(sides)
    along = forward[0] * turn[0] - forward[1] * turn[1], forward[0] * turn[1] + forward[1] * turn[0]
    directions = forward, unit_vectors(elevations)
    velocity, spin = struck(table, CUE_MASS, speeds, directions, (sides, aboves), along)
    velocities, spins = np.stack(velocity, axis=-1), np.stack(spin, axis=-1)
    offsets = np.sqrt(sides * sides + aboves * aboves)
    right = (offsets <= MISCUE_OFFSET + ROUNDING_OF_OFFSET) & (speeds >= 0.0)
    right &= (elevations >= 0.0) & (elevations <= 90.0)
    velocities[~right] = spins[~right] = np.nan
    return velocities, spins


def unit_vectors(degrees: ArrayLike) -> tuple[Floats, Floats]:
    """Return cosines and sines of any shape, exactly 0 and 1 at right angles.

    Parameters
    ----------
    degrees : array_like of shape (m,), or any other
        Directions, degrees. Each value gives the same bits, wherever it stands.
    """
    angles = np.asarray(degrees, dtype=float)
    turned = angles - 360.0 * np.rint(angles / 360.0)
    radians = turned * (np.pi / 180.0)
    x, y = np.asarray(np.cos(radians)), np.asarray(np.sin(radians))
    quarters = np.rint(turned / 90.0)
    straight = turned == 90.0 * quarters
    if straight.any():
        quarter = quarters[straight].astype(int) % 4
        x[straight], y[straight] = STRAIGHT[0][quarter], STRAIGHT[1][quarter]
    return x, y


def _squirt(side: Floats) -> tuple[Floats, Floats]:
    """Return cosines and sines of the angles by which squirt turns the velocities."""
    depth = np.maximum(1.0 - side * side, 0.0)
    away = SPIN_PER_OFFSET * side * np.sqrt(depth)
    ahead = 1.0 + END_MASS_RATIO + SPIN_PER_OFFSET * depth
    size = np.sqrt(away * away + ahead * ahead)
    return ahead / size, -away / size
