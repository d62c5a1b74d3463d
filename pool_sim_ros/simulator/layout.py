"""How the balls lie while they rest: where, how they are turned, and which are in pockets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table

IDENTITY = (0.0, 0.0, 0.0, 1.0)
"""The quaternion x, y, z, w of a ball that is not turned."""


@dataclass(frozen=True, eq=False, slots=True)
class Layout:
    """Balls at rest.

    Attributes
    ----------
    positions : ndarray of shape (n, 2)
        m; a ball in a pocket is at its centre.
    orientations : ndarray of shape (n, 4), or None
        Unit quaternions x, y, z, w; None on a table of discs, which do not turn.
    pocketed : tuple of int
        The balls in pockets, in the order in which they fell.
    """

    positions: NDArray[np.float64]
    orientations: NDArray[np.float64] | None = None
    pocketed: tuple[int, ...] = ()


def layout_at(
    table: Table,
    positions: NDArray[np.float64],
    orientations: NDArray[np.float64] | None = None,
    before: tuple[int, ...] = (),
) -> Layout:
    """Return how balls lie at (n, 2) positions in m; those in a pocket go to its centre.

    Parameters
    ----------
    table : Table
    positions : ndarray of shape (n, 2)
        m.
    orientations : ndarray of shape (n, 4), optional
        By default no ball is turned.
    before : tuple of int, optional
        Balls that lay in pockets before, in the order in which they fell.
    """
    if table.motion != 'ball':
        return Layout(positions)
    if orientations is None:
        orientations = np.tile(IDENTITY, (len(positions), 1))
    pockets = pockets_at(table, positions)
    in_pockets = np.flatnonzero(pockets >= 0).tolist()
    if in_pockets:
        positions = positions.copy()
        positions[in_pockets] = table.pockets[pockets[in_pockets], :2]
    order = [ball for ball in before if ball in in_pockets]
    return Layout(
        positions, orientations, (*order, *(ball for ball in in_pockets if ball not in order))
    )


def start_layout(table: Table) -> Layout:
    """Return how the balls lie at the start: none is turned."""
    return layout_at(table, table.positions)


def pockets_at(table: Table, positions: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the number of the pocket in whose circle each of (n, 2) positions is; -1 for none."""
    if not len(table.pockets):
        return np.full(len(positions), -1)
    apart = positions[:, np.newaxis] - table.pockets[:, :2]
    with np.errstate(over='ignore'):  # anybody may ask for any place
        inside = np.sum(apart * apart, axis=2) < table.pockets[:, 2] ** 2
    return np.where(inside.any(axis=1), inside.argmax(axis=1), -1)
