"""Part 1 of the report: two balls of any mass, radius and velocity that meet at an offset."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics.boundary import Rectangle
from pool_sim_ros.physics.contacts.discs import collide_discs
from pool_sim_ros.physics.law_names import DISC_FRICTION_LAWS, DiscFriction
from pool_sim_ros.physics.motion import DiscTable
from pool_sim_ros.physics.validation import number, numbers


class TwoBallCollision(NamedTuple):
    """A collision of balls a and b, in the frame of the contact and in x-y.

    Attributes
    ----------
    impact_angle : float
        Direction of the line from a's centre to b's at impact, rad from the x axis
        (report, Equation 4).
    normal_before, normal_after : tuple of float
        Velocities of a and b along that line, m/s (Equations 1, 2 and 5).
    tangential_before, tangential_after : tuple of float
        Velocities of a and b along its left-hand perpendicular, m/s (Equations 5 and 6).
    velocity_a, velocity_b : ndarray of shape (2,)
        Velocities after the impact, x-y, m/s (Equation 7).
    """

    impact_angle: float
    normal_before: tuple[float, float]
    tangential_before: tuple[float, float]
    normal_after: tuple[float, float]
    tangential_after: tuple[float, float]
    velocity_a: NDArray[np.float64]
    velocity_b: NDArray[np.float64]


def two_ball_collision(
    mass_a: float,
    mass_b: float,
    velocity_a: ArrayLike,
    velocity_b: ArrayLike,
    radius_a: float,
    radius_b: float,
    offset: float,
    restitution: float,
    friction: float,
    ball_friction: DiscFriction = 'coulomb',
) -> TwoBallCollision:
    """Return the velocities of two balls after they collide (report, section 1).

    Parameters
    ----------
    mass_a, mass_b : float
        kg.
    velocity_a, velocity_b : array_like of shape (2,)
        Before the impact, m/s.
    radius_a, radius_b : float
        m; equal in the report.
    offset : float
        How far b's centre lies to the left of the line along which a's centre moves relative
        to b, m; negative to the right. Less than the sum of the radii either way.
    restitution : float
        0 to 1.
    friction : float
        Coefficient of friction between the balls, at least 0.
    ball_friction : {'coulomb', 'report'}, optional
        Equation 6 with the slip's direction and a cap, or as Listing 3 has it.

    Returns
    -------
    TwoBallCollision

    Raises
    ------
    ValueError
        Where a value is out of its range, or the balls do not approach each other.
    """
    mass_a = number('mass_a', mass_a, above=0.0)
    mass_b = number('mass_b', mass_b, above=0.0)
    reach = number('radius_a', radius_a, above=0.0) + number('radius_b', radius_b, above=0.0)
    va, vb = numbers('velocity_a', velocity_a, 2), numbers('velocity_b', velocity_b, 2)
    offset = number('offset', offset)
    restitution = number('restitution', restitution, least=0.0, most=1.0)
    friction = number('friction', friction, least=0.0)
    if ball_friction not in DISC_FRICTION_LAWS:
        raise ValueError(f"ball_friction: {ball_friction!r} must be 'report' or 'coulomb'")
    if abs(offset) >= reach:
        raise ValueError(f'offset: {offset} m; beyond the two radii, {reach:g} m, the balls miss')
    if va == vb:
        raise ValueError(f'velocity_a: {va} is also velocity_b; such balls do not approach')

    angle = math.atan2(va[1] - vb[1], va[0] - vb[0]) + math.asin(offset / reach)
    normal = (math.cos(angle), math.sin(angle))
    before_a, before_b = _in_frame(va, normal), _in_frame(vb, normal)
    after_a, after_b = collide_discs(
        _contact_table(friction, ball_friction),
        va,
        vb,
        normal,
        (1.0 / mass_a, 1.0 / mass_b),
        restitution * (before_a[0] - before_b[0]),
    )
    in_frame_a, in_frame_b = _in_frame(after_a, normal), _in_frame(after_b, normal)
    return TwoBallCollision(
        impact_angle=math.remainder(angle, math.tau),
        normal_before=(before_a[0], before_b[0]),
        tangential_before=(before_a[1], before_b[1]),
        normal_after=(in_frame_a[0], in_frame_b[0]),
        tangential_after=(in_frame_a[1], in_frame_b[1]),
        velocity_a=np.array(after_a),
        velocity_b=np.array(after_b),
    )


def _in_frame(v: Sequence[float], normal: tuple[float, float]) -> tuple[float, float]:
    """Return the normal and tangential parts of a velocity (report, Equation 5)."""
    return v[0] * normal[0] + v[1] * normal[1], v[1] * normal[0] - v[0] * normal[1]


def _contact_table(friction: float, ball_friction: str) -> DiscTable:
    """Return a table of which only the friction of two balls counts."""
    coulomb = ball_friction == 'coulomb'
    return DiscTable(Rectangle(0.0, 0.0), 0.0, friction, 0.0, 0.0, 0.0, 0.0, coulomb, -1)
