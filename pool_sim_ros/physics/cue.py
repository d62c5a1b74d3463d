"""What a cue gives the cue ball: an instantaneous contact at one point.

The point is `side` and `above` radii from the middle of the ball as the player sees it. Sources:
Alciatore's technical proofs A.30 (speed and spin) and A.31 (squirt).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.balls import MASSES, Ball
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import MAX_SPEED, ROUNDING_OF_OFFSET
from pool_sim_ros.physics.validation import number

CUE_MASS = 0.567
"""kg: 20 ounces, the usual weight of a cue."""

END_MASS_RATIO = 30.0
"""Mass of a ball over that of the end of a cue that moves sideways with the tip: pooltool's value.
At half a radius it makes 1.9 degrees of squirt."""

MISCUE_OFFSET = 0.5
"""Radii from the middle of the ball beyond which a chalked tip slips off."""

SPIN_PER_OFFSET = 5.0 / 2.0
"""m R^2 / I of a sphere."""


def cue_strike(
    table: Table,
    speed: float,
    azimuth: float,
    elevation: float = 0.0,
    side: float = 0.0,
    above: float = 0.0,
    *,
    cue_mass: float = CUE_MASS,
    end_mass_ratio: float | None = END_MASS_RATIO,
    max_offset: float = MISCUE_OFFSET,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the velocity and the spin that a stroke gives the cue ball.

    Parameters
    ----------
    table : Table
        Whose cue ball is struck, ``table.balls[0]``.
    speed : float
        Of the cue before the impact, m/s.
    azimuth : float
        Where the cue points, degrees counterclockwise from +x.
    elevation : float, optional
        Of the butt of the cue, degrees, 0 to 90. The ball stays on the cloth.
    side, above : float, optional
        Where the tip hits, in radii from the middle of the ball as the player sees it: `side` to
        the left, `above` upwards.
    cue_mass : float, optional
        kg.
    end_mass_ratio : float, optional
        The ball's mass over that of the end of the cue, which `side` pushes aside. So the ball sets
        off a little to the other side (squirt). None: it does not.
    max_offset : float, optional
        Offset of the tip that still holds, as a part of the radius, at most 1.

    Returns
    -------
    velocity : ndarray of shape (2,)
        m/s.
    spin : ndarray of shape (3,)
        rad/s, z up. Squirt does not turn it.

    Raises
    ------
    ValueError
        For a miscue, and where a value is not finite or out of its range; names it.

    Examples
    --------
    >>> from pool_sim_ros.physics import report_table
    >>> velocity, spin = cue_strike(report_table(), speed=2.0, azimuth=0.0, above=0.4)
    >>> bool(velocity[0] > 0.0), bool(spin[1] > 0.0)
    (True, True)
    """
    ball = table.balls[0]
    speed = number('speed', speed, 0.0, MAX_SPEED)
    forward = _unit_vector(number('azimuth', azimuth))
    cosine, sine = _unit_vector(number('elevation', elevation, 0.0, 90.0))
    side, above = number('side', side), number('above', above)
    _check_offset(side, above, number('max_offset', max_offset, 0.0, 1.0))
    cue_mass = number('cue_mass', cue_mass, *MASSES)
    turn = (1.0, 0.0) if end_mass_ratio is None else _squirt(side, end_mass_ratio)

    velocity, spin = _struck(ball, cue_mass, speed, (forward, turn), (cosine, sine), (side, above))
    return np.array(velocity), np.array(spin)


def cue_strikes(
    table: Table, strokes: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
    """Return the velocities and the spins that many strokes give the cue ball.

    Parameters
    ----------
    table : Table
        Whose cue ball is struck, ``table.balls[0]``.
    strokes : ndarray of shape (m, 5)
        Speed (m/s), azimuth and elevation (degrees), side and above (radii), as `cue_strike` takes
        them; the cue and its end have the masses that are its defaults.

    Returns
    -------
    velocities : ndarray of shape (m, 2)
        m/s.
    spins : ndarray of shape (m, 3)
        rad/s, z up.
    holds : ndarray of bool, (m,)
        False where the tip hits more than `MISCUE_OFFSET` from the middle and slips off; nothing is
        given to the ball then.
    """
    speed, azimuth, elevation, side, above = strokes.T
    holds = np.hypot(side, above) <= MISCUE_OFFSET + ROUNDING_OF_OFFSET
    side, above = np.where(holds, side, 0.0), np.where(holds, above, 0.0)
    away, ahead = _squirt_legs(side, END_MASS_RATIO)
    size = np.hypot(away, ahead)
    phi, theta = np.radians(azimuth), np.radians(elevation)
    velocity, spin = _struck(
        table.balls[0],
        CUE_MASS,
        np.where(holds, speed, 0.0),
        ((np.cos(phi), np.sin(phi)), (ahead / size, -away / size)),
        (np.cos(theta), np.sin(theta)),
        (side, above),
    )
    return np.stack(velocity, axis=-1), np.stack(spin, axis=-1), holds


def _struck(
    ball: Ball,
    cue_mass: float,
    speed: Any,
    directions: tuple[tuple[Any, Any], tuple[Any, Any]],
    tilt: tuple[Any, Any],
    offsets: tuple[Any, Any],
) -> tuple[tuple[Any, Any], tuple[Any, Any, Any]]:
    """Return velocity and spin of one stroke, or of many where the values are arrays.

    `directions` are where the cue points and how far squirt turns the velocity, each as cosine and
    sine, as is `tilt`, the elevation of the cue.
    """
    (forward, turn), (cosine, sine), (side, above) = directions, tilt, offsets
    offset = SPIN_PER_OFFSET * (side * side + above * above)
    ball_speed = 2.0 * speed / (1.0 + ball.mass / cue_mass + offset)
    along = _turned(forward, turn)
    level = ball_speed * cosine
    rate = SPIN_PER_OFFSET * ball_speed / ball.radius
    # About the axes of the cue: to the left, backwards, up.
    left, backward = rate * above, rate * side * sine
    return (
        (level * along[0], level * along[1]),
        (
            -left * forward[1] - backward * forward[0],
            left * forward[0] - backward * forward[1],
            -rate * side * cosine,
        ),
    )


def _check_offset(side: float, above: float, most: float) -> None:
    offset = math.hypot(side, above)
    if offset > most + ROUNDING_OF_OFFSET:
        raise ValueError(
            f'side, above: ({side:g}, {above:g}) is {offset:g} radii from the middle of the ball; '
            f'beyond max_offset, {most:g}, the tip slips off (a miscue)'
        )


def _squirt(side: float, end_mass_ratio: float) -> tuple[float, float]:
    """Return the cosine and the sine of the angle by which squirt turns the velocity."""
    away, ahead = _squirt_legs(side, number('end_mass_ratio', end_mass_ratio, above=0.0))
    size = math.hypot(away, ahead)
    return ahead / size, -away / size


def _squirt_legs(side: Any, ratio: float) -> tuple[Any, Any]:
    """Return how far the ball goes aside and ahead, in one unit."""
    depth = np.maximum(1.0 - side * side, 0.0)
    return SPIN_PER_OFFSET * side * np.sqrt(depth), 1.0 + ratio + SPIN_PER_OFFSET * depth


def _turned(vector: tuple[Any, Any], turn: tuple[Any, Any]) -> tuple[Any, Any]:
    (x, y), (cosine, sine) = vector, turn
    return x * cosine - y * sine, x * sine + y * cosine


def _unit_vector(degrees: float) -> tuple[float, float]:
    """Return cosine and sine, exactly 0 and 1 at right angles: straight shots are straight."""
    rest = math.remainder(degrees, 90.0)
    quarters = round(math.remainder(degrees - rest, 360.0) / 90.0)
    x, y = math.cos(math.radians(rest)), math.sin(math.radians(rest))
    return ((x, y), (-y, x), (-x, -y), (y, -x))[quarters % 4]
