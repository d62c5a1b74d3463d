"""Where to point the cue: from one ball to another."""

from __future__ import annotations

import math

from numpy.typing import ArrayLike

from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.validation import array


def aim_at(table: Table, ball: str, target: str, positions: ArrayLike | None = None) -> float:
    """Return the azimuth from the centre of one ball to that of another, as `cue_strike` takes it.

    Parameters
    ----------
    table : Table
    ball, target : str
        Labels, such as 'C' and '9'.
    positions : array_like of shape (n, 2), optional
        Where the balls are instead of their own places, m.

    Returns
    -------
    float
        Degrees counterclockwise from +x, above -180 and at most 180. For a velocity take
        ``speed * cos(radians(azimuth)), speed * sin(radians(azimuth))``. What lies between the
        balls, and squirt, are not looked at.

    Raises
    ------
    ValueError
        For a label that is not on the table, a ball that aims at itself, and two in one place.

    Examples
    --------
    >>> from pool_sim_ros.physics import pool_table
    >>> aim_at(pool_table('7ft'), 'C', '1')
    180.0
    """
    one, other = table.index(ball), table.index(target)
    places = table.positions if positions is None else array('positions', positions)
    if places.shape != (len(table.balls), 2):
        raise ValueError(f'positions: shape {places.shape} must be ({len(table.balls)}, 2)')
    if one == other:
        raise ValueError(f'target: ball {target!r} cannot aim at itself')
    dx, dy = (places[other] - places[one]).tolist()
    if not math.isfinite(dx + dy) or (dx == 0.0 and dy == 0.0):
        raise ValueError(
            f'positions: balls {ball!r} and {target!r}, at {tuple(places[one].tolist())} and '
            f'{tuple(places[other].tolist())}, have no line between them'
        )
    return math.degrees(math.atan2(dy + 0.0, dx))
