"""The laws of a single contact: ball on ball, ball on cushion.

All take and return velocities in m/s; a unit normal points from the first ball to the second, or
from the ball into the cushion, and the tangent is the normal turned left by a right angle.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from pool_sim_ros.physics.jit import inlined
from pool_sim_ros.physics.tolerances import NO_SLIP


@inlined
def sign(value: float) -> float:
    """Return 1, 0 or -1, as MATLAB's sign does."""
    if value > 0.0:
        return 1.0
    if value < 0.0:
        return -1.0
    return 0.0


@inlined
def restitution(table: Any, a_is_cue: int, b_is_cue: int) -> float:
    """Return the coefficient of restitution of two balls."""
    if a_is_cue or b_is_cue:
        return table.e_cue_ball
    return table.e_ball_ball


@inlined
def reduced_mass(inverse_a: float, inverse_b: float) -> float:
    """Return ``m_a m_b / (m_a + m_b)`` in kg from the inverses of both masses."""
    return 1.0 / (inverse_a + inverse_b)


@inlined
def coulomb_impulse(normal_impulse: float, slip: float, mass: float, mu: float) -> float:
    """Return the tangential impulse in N s on the first body, against `slip`.

    ``J_t = min(mu J_n, |slip| m)`` with the reduced `mass`: friction may stop the slip, never
    turn it round (report, Equation 6, with the slip's direction and a cap).
    """
    return -sign(slip) * min(mu * normal_impulse, abs(slip) * mass)


@inlined
def report_friction(
    tangential: float, other_tangential: float, normal_loss: float, mu: float
) -> float:
    """Return a ball's tangential velocity after a contact as Listing 3 has it.

    `normal_loss` is the ball's normal velocity before less that after: positive for the first
    ball, negative for the second, whose slip therefore grows. A loss never turns the velocity
    round (Listing 3, lines 131 to 139).
    """
    after = tangential - sign(tangential - other_tangential) * (mu * normal_loss)
    if sign(after) != sign(tangential) and sign(tangential) != 0.0:
        return 0.0
    return after


@inlined
def rub_balls(
    table: Any,
    tangential: tuple[float, float],
    normal_impulse: float,
    inverse_masses: tuple[float, float],
    shares: tuple[float, float],
) -> tuple[float, float]:
    """Return both tangential velocities after the friction of one contact.

    `shares` says with how many contacts of the same instant each ball shares its mass, so that
    together they cannot turn a slip round (`coulomb` only). The report's law jumps where the slip
    is zero, so there a slip that is no more than rounding counts as none.

    Parameters
    ----------
    table : named tuple
        Coefficient and law of friction.
    tangential : tuple of float
        Velocities of both along the tangent, m/s.
    normal_impulse : float
        N s.
    inverse_masses : tuple of float
        1/kg.
    shares : tuple of float
    """
    va_t, vb_t = tangential
    inverse_a, inverse_b = inverse_masses
    if table.coulomb:
        mass = reduced_mass(inverse_a * shares[0], inverse_b * shares[1])
        impulse = coulomb_impulse(normal_impulse, va_t - vb_t, mass, table.mu_ball_ball)
        return va_t + impulse * inverse_a, vb_t - impulse * inverse_b
    if abs(va_t - vb_t) <= NO_SLIP * normal_impulse * (inverse_a + inverse_b):
        return va_t, vb_t
    return (
        report_friction(va_t, vb_t, normal_impulse * inverse_a, table.mu_ball_ball),
        report_friction(vb_t, va_t, -normal_impulse * inverse_b, table.mu_ball_ball),
    )


@inlined
def rub_cushion(tangential: float, normal_change: float, mu: float, share: float) -> float:
    """Return the tangential velocity after a cushion's friction (report, Equation 9).

    ``v_t' = v_t - sign(v_t) mu |v_n' - v_n|``, never past zero.
    """
    return tangential - sign(tangential) * min(mu * abs(normal_change), abs(tangential) / share)


@inlined
def collide_discs(
    table: Any,
    va: tuple[float, float],
    vb: tuple[float, float],
    normal: tuple[float, float],
    inverse_masses: tuple[float, float],
    separation: float,
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return both velocities after a contact of two balls that nothing else touches.

    Parameters
    ----------
    table : named tuple
        Coefficients and law of friction.
    va, vb, normal : tuple of float
        Velocities before, m/s, and the unit vector from a to b.
    inverse_masses : tuple of float
        Of a and of b, 1/kg.
    separation : float
        Speed at which they part along the normal, m/s: ``e (v_a - v_b)`` by report, Equation 2.

    Returns
    -------
    tuple of tuple of float
        The velocities of a and of b, m/s.
    """
    nx, ny = normal
    inverse_a, inverse_b = inverse_masses
    va_n, va_t = va[0] * nx + va[1] * ny, va[1] * nx - va[0] * ny
    vb_n, vb_t = vb[0] * nx + vb[1] * ny, vb[1] * nx - vb[0] * ny
    impulse = (va_n - vb_n + separation) * reduced_mass(inverse_a, inverse_b)
    va_n -= impulse * inverse_a
    vb_n += impulse * inverse_b
    va_t, vb_t = rub_balls(table, (va_t, vb_t), impulse, inverse_masses, (1.0, 1.0))
    return (
        (va_n * nx - va_t * ny, va_n * ny + va_t * nx),
        (vb_n * nx - vb_t * ny, vb_n * ny + vb_t * nx),
    )


@inlined
def collide_disc_with_cushion(
    table: Any, normal: float, tangential: float, separation: float
) -> tuple[float, float]:
    """Return the normal and tangential velocity of a ball after a cushion (report, Equation 9).

    All in m/s, each part in either direction. `separation` is the speed at which it leaves:
    ``e |v_n|``.
    """
    after = -sign(normal) * separation
    return after, rub_cushion(tangential, after - normal, table.mu_ball_cushion, 1.0)


@inlined
def contact_normal(dx: float, dy: float) -> tuple[float, float]:
    """Return the unit vector along (dx, dy)."""
    inverse = 1.0 / np.sqrt(dx * dx + dy * dy)
    return dx * inverse, dy * inverse
