"""Balls that overlap, moved apart as little as that needs.

The report's integrator lets balls into each other, and noise may. What comes of it is no layout
that a shot can begin from.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import MAX_SEPARATIONS, OVERLAP
from pool_sim_ros.physics.validation import is_bad


def separated(table: Table, positions: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return positions at which no ball overlaps another or a cushion.

    All pairs that overlap move apart at once, along the line of their centres, each ball half the
    way; a ball in several pairs by the mean of these. Then each goes back inside the cushions.
    This repeats until nothing overlaps, so the order of the balls does not matter. Two balls in
    one place move apart along x.

    Parameters
    ----------
    table : Table
    positions : ndarray of shape (n, 2)
        m.

    Returns
    -------
    ndarray of shape (n, 2), or None
        m; the very array where nothing overlaps, None where no such positions were found.
    """
    if not is_bad(table, positions):
        return positions
    radii = table.radii[:, np.newaxis]
    places = np.clip(positions, radii, (table.length, table.width) - radii)
    first, second = np.triu_indices(len(places), 1)
    touch = table.radii[first] + table.radii[second]
    for _ in range(MAX_SEPARATIONS):
        apart = places[second] - places[first]
        distance = np.hypot(*apart.T)
        close = distance < touch - 0.5 * OVERLAP
        if not close.any():
            return None if is_bad(table, places) else places
        a, b, apart, distance = first[close], second[close], apart[close], distance[close]
        apart[distance == 0.0] = 1.0, 0.0
        unit = apart / np.where(distance == 0.0, 1.0, distance)[:, np.newaxis]
        half = 0.5 * (touch[close] - distance)[:, np.newaxis] * unit
        moves, counts = np.zeros_like(places), np.zeros((len(places), 1))
        np.add.at(moves, a, -half)
        np.add.at(moves, b, half)
        np.add.at(counts, a, 1.0)
        np.add.at(counts, b, 1.0)
        places = np.clip(
            places + moves / np.maximum(counts, 1.0), radii, (table.length, table.width) - radii
        )
    return None
