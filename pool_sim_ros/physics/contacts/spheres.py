"""The law of one contact of two spheres of equal radius: balls that spin.

At a contact n is the unit vector from ball 1 to ball 2, t = z x n, and z points up. Both balls stay
on the cloth. A motion of a ball is its velocity (x, y), m/s, and its spin (x, y, z), rad/s.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from pool_sim_ros.physics.contacts.discs import reduced_mass
from pool_sim_ros.physics.jit import inlined
from pool_sim_ros.physics.solid_sphere import NO_SLIP_SHARE, SPIN_PER_PUSH

Velocity = tuple[float, float]
Spin = tuple[float, float, float]
Motion = tuple[Velocity, Spin]
Friction = tuple[float, float]

ALCIATORE_FLOOR = 9.951e-3
ALCIATORE_RANGE = 0.108
ALCIATORE_DECAY = 1.088
"""Friction of two balls at the slip s in m/s: floor + range exp(-decay s), Alciatore's fit to
measurements (technical proof A.14)."""


class BallLaw(NamedTuple):
    """How two balls rub.

    Attributes
    ----------
    mu : float
        Coefficient of friction, where it is constant.
    alciatore : bool
        Whether it depends on the slip instead.
    by_restitution : bool
        What bounds friction: e times the closing speed instead of the normal impulse.
    """

    mu: float
    alciatore: bool
    by_restitution: bool


@inlined
def friction_coefficient(law: BallLaw, slip: float) -> float:
    """Return the coefficient of friction of two balls at a slip in m/s."""
    if law.alciatore:
        return ALCIATORE_FLOOR + ALCIATORE_RANGE * math.exp(-ALCIATORE_DECAY * slip)
    return law.mu


@inlined
def friction_bound(law: BallLaw, impulse: float, e: float) -> float:
    """Return what bounds friction, in N s, once multiplied by its coefficient.

    That is the normal impulse, which is (1 + e)/2 times the closing speed for equal balls of 1 kg;
    or, as pooltool 0.6.0 has it, e times the closing speed.
    """
    if law.by_restitution:
        return impulse * (2.0 * e / (1.0 + e))
    return impulse


@inlined
def slip_of_balls(one: Motion, other: Motion, normal: Velocity, radius: float) -> Friction:
    """Return how the surface of ball 1 slips over that of ball 2: along t and z, m/s."""
    (v1, w1), (v2, w2) = one, other
    nx, ny = normal
    along = (v1[1] - v2[1]) * nx - (v1[0] - v2[0]) * ny + radius * (w1[2] + w2[2])
    up = radius * ((w1[0] + w2[0]) * ny - (w1[1] + w2[1]) * nx)
    return along, up


@inlined
def friction_of_balls(
    law: BallLaw,
    one: Motion,
    other: Motion,
    normal: Velocity,
    radius: float,
    mass: float,
    bound: float,
) -> Friction:
    """Return the impulse of friction on ball 1, along t and z, N s; ball 2 gets the opposite.

    ``J = min(mu J_n, (2/7) m |c|)`` against the slip c. This form needs no direction where there is
    no slip.

    Parameters
    ----------
    law : BallLaw
    one, other : tuple
        The motions of both balls, before friction.
    normal : tuple of float
        Unit vector from ball 1 to ball 2.
    radius : float
        Of both, m.
    mass : float
        The reduced mass, kg.
    bound : float
        As `friction_bound` has it, N s.
    """
    along, up = slip_of_balls(one, other, normal, radius)
    slip = math.sqrt(along * along + up * up)
    most = friction_coefficient(law, slip) * bound
    share = NO_SLIP_SHARE * mass
    # A slip whose square is no number any more is none.
    if slip > 0.0 and most < share * slip:
        share = most / slip
    return -share * along, -share * up


@inlined
def rub_sphere(
    motion: Motion, normal: Velocity, radius: float, push: Friction, spin: Friction
) -> Motion:
    """Return a ball's motion after friction.

    `push` and `spin` are both friction by the ball's mass, along t and z, m/s, `push` as this ball
    feels it, `spin` as ball 1 does: the spins of both balls change alike. Only the part along t
    moves a ball, since it stays on the cloth.
    """
    (vx, vy), (wx, wy, wz) = motion
    nx, ny = normal
    gain = SPIN_PER_PUSH / radius
    turn = gain * spin[1]
    return (
        (vx - push[0] * ny, vy + push[0] * nx),
        (wx + turn * ny, wy - turn * nx, wz + gain * spin[0]),
    )


@inlined
def rub_spheres(
    one: Motion,
    other: Motion,
    normal: Velocity,
    radius: float,
    inverse_masses: tuple[float, float],
    friction: Friction,
) -> tuple[Motion, Motion]:
    """Return both motions after an impulse of friction on ball 1, along t and z, N s."""
    first = friction[0] * inverse_masses[0], friction[1] * inverse_masses[0]
    second = friction[0] * inverse_masses[1], friction[1] * inverse_masses[1]
    opposite = -second[0], -second[1]
    return (
        rub_sphere(one, normal, radius, first, first),
        rub_sphere(other, normal, radius, opposite, second),
    )


@inlined
def collide_spheres(
    law: BallLaw,
    one: Motion,
    other: Motion,
    normal: Velocity,
    radius: float,
    inverse_masses: tuple[float, float],
    restitution: tuple[float, float],
) -> tuple[Motion, Motion]:
    """Return both motions after a contact of two balls that nothing else touches.

    Parameters
    ----------
    law : BallLaw
    one, other : tuple
        The motions of both balls before.
    normal : tuple of float
        Unit vector from ball 1 to ball 2.
    radius : float
        Of both, m.
    inverse_masses : tuple of float
        1/kg.
    restitution : tuple of float
        The coefficient e, which `friction_bound` may need, and the speed at which the balls part
        along the normal, m/s: e times that at which they close, or more.
    """
    (v1, w1), (v2, w2) = one, other
    nx, ny = normal
    e, separation = restitution
    mass = reduced_mass(inverse_masses[0], inverse_masses[1])
    impulse = ((v1[0] - v2[0]) * nx + (v1[1] - v2[1]) * ny + separation) * mass
    push1, push2 = impulse * inverse_masses[0], impulse * inverse_masses[1]
    one = (v1[0] - push1 * nx, v1[1] - push1 * ny), w1
    other = (v2[0] + push2 * nx, v2[1] + push2 * ny), w2
    bound = friction_bound(law, impulse, e)
    friction = friction_of_balls(law, one, other, normal, radius, mass, bound)
    return rub_spheres(one, other, normal, radius, inverse_masses, friction)
