"""Where the balls may lie from which the next shot begins."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table, check_layout, separated
from pool_sim_ros.simulator.settings import Settings


def why_refused(settings: Settings, positions: NDArray[np.float64], frame_id: str) -> str | None:
    """Return why a layout, (k, 2) in m in the order of the balls, cannot be; None where it can."""
    table = settings.table
    if fault := settings.frame_fault(frame_id):
        return fault
    if len(positions) != len(table.balls):
        return f'{len(positions)} positions; the table has {len(table.balls)} balls'
    try:
        check_layout(table, positions)
    except ValueError as error:
        return str(error)
    return None


def next_layout(
    table: Table, played: NDArray[np.float64], before: NDArray[np.float64]
) -> tuple[NDArray[np.float64], str | None]:
    """Return a layout that can be played on, and in words why it is not what was played.

    The report's integrator lets balls through one another that touch at the start or hardly
    rebound; a shot cannot begin from what comes of it.

    Parameters
    ----------
    table : Table
    played : ndarray of shape (n, 2)
        Where a shot has left the balls, m.
    before : ndarray of shape (n, 2)
        Where they lay before it, m.
    """
    try:
        check_layout(table, played, 'final positions')
    except ValueError as error:
        apart = separated(table, played)
        if apart is None:
            return before, f'{error}; the balls are back where they lay before the shot'
        return apart, f'{error}; the balls were moved apart'
    return played, None
