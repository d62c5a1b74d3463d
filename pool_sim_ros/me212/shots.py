"""The velocities of the cue ball in the report's four shots (Listing 2)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pool_sim_ros.physics import Table

SHOT_NUMBERS = (1, 2, 3, 4)
"""Of the report's shots."""

_SPEEDS_AND_ANGLES = {1: (4.0, 0.0), 2: (2.5, 15.0), 3: (1.5, 30.0)}
"""m/s, and degrees from -x towards +y."""

_SPEED_TO_NEAREST = 1.5
"""Speed of shot 4, m/s."""


def nearest_ball(table: Table) -> int:
    """Return the index of the ball nearest to the cue ball on the start layout.

    If several are equally near, it is the first of them (Listing 3, `find_nearest`).

    Parameters
    ----------
    table : Table

    Raises
    ------
    ValueError
        Where the cue ball is alone.
    """
    if len(table.balls) < 2:
        raise ValueError('the cue ball is alone on this table; there is no nearest ball')
    cue = table.balls[0].position
    return min(range(1, len(table.balls)), key=lambda i: math.dist(table.balls[i].position, cue))


def attitude_to_nearest(table: Table) -> float:
    """Return the direction from the cue ball to the nearest ball, rad counterclockwise from +x.

    Parameters
    ----------
    table : Table

    Raises
    ------
    ValueError
        Where the cue ball is alone.
    """
    cue, nearest = table.balls[0].position, table.balls[nearest_ball(table)].position
    return math.atan2(nearest[1] - cue[1], nearest[0] - cue[0])


def cue_velocity(shot: int, table: Table) -> tuple[float, float]:
    """Return the velocity of the cue ball in a shot of the report.

    Parameters
    ----------
    shot : int
        1 to 4.
    table : Table
        Shot 4 is aimed at the ball nearest to the cue ball in its start layout.

    Returns
    -------
    tuple of float
        (x, y), m/s.

    Raises
    ------
    ValueError
        Where there is no such shot, or the cue ball is alone in shot 4.
    """
    if shot == 4:
        angle = attitude_to_nearest(table)
        return math.cos(angle) * _SPEED_TO_NEAREST, math.sin(angle) * _SPEED_TO_NEAREST
    if shot not in _SPEEDS_AND_ANGLES:
        raise ValueError(f"shot: {shot!r} is not one of the report's, 1 to 4")
    speed, degrees = _SPEEDS_AND_ANGLES[shot]
    angle = math.radians(degrees)
    return -math.cos(angle) * speed, math.sin(angle) * speed
