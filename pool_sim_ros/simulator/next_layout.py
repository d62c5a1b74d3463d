"""Where the balls may lie from which the next shot begins."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table, check_layout, separated
from pool_sim_ros.simulator.layout import IDENTITY, Layout, layout_at, pockets_at
from pool_sim_ros.simulator.refusals import RefusedError
from pool_sim_ros.simulator.request_fields import quote
from pool_sim_ros.simulator.settings import Settings
from pool_sim_ros.simulator.shot_request import Code

MOST_LABELS = 30
"""Labels that a message names: a snooker table has 22."""


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


def check_cue_ball(table: Table, layout: Layout) -> None:
    """Raise RefusedError where the cue ball, the first, lies in a pocket."""
    if 0 in layout.pocketed:
        reason = f'the cue ball {table.labels[0]!r} lies in a pocket; place it on the cloth first'
        raise RefusedError(Code.CUE_POCKETED, reason)


def with_placed(table: Table, layout: Layout, places: Mapping[str, tuple[float, float]]) -> Layout:
    """Return a layout in which single balls lie elsewhere, not turned.

    Parameters
    ----------
    table : Table
    layout : Layout
        How all balls lie now.
    places : mapping
        Label -> (x, y), m.

    Raises
    ------
    RefusedError
        Where there is no such ball, or one cannot lie there; nothing has changed.
    """
    positions = layout.positions.copy()
    turned = None if layout.orientations is None else layout.orientations.copy()
    for label, place in places.items():
        try:
            ball = table.index(label)
        except ValueError:
            known = ', '.join(table.labels[:MOST_LABELS])
            more = ', ...' if len(table.labels) > MOST_LABELS else ''
            reason = f'place: there is no ball {quote(label)}; the table has {known}{more}'
            raise RefusedError(Code.BAD_LAYOUT, reason) from None
        positions[ball] = place
        if turned is not None:
            turned[ball] = IDENTITY
    for label, pocket in zip(table.labels, pockets_at(table, positions).tolist(), strict=True):
        if pocket >= 0 and label in places:
            reason = f'place: ball {label!r} would fall into pocket {pocket}; place it on the cloth'
            raise RefusedError(Code.BAD_LAYOUT, reason)
    try:
        check_layout(table, positions, 'place')
    except ValueError as error:
        raise RefusedError(Code.BAD_LAYOUT, str(error)) from None
    return layout_at(table, positions, turned, layout.pocketed)


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
        # No ball that spins is let through another, and one in a pocket must stay there.
        apart = separated(table, played) if table.motion == 'disc' else None
        if apart is None:
            return before, f'{error}; the balls are back where they lay before the shot'
        return apart, f'{error}; the balls were moved apart'
    return played, None
