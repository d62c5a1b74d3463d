"""A ball against an edge that does not give: the models `han` and `impulse`.

Both push the ball away from the edge and rub it there with Coulomb's friction. They differ in the
direction of the push, its lean: the cosine and the sine of the angle from n up to the line from the
ball's centre to the point of contact. Axes as in `edge`.
"""

from __future__ import annotations

import math

from pool_sim_ros.physics.contacts.spheres import Spin, Velocity
from pool_sim_ros.physics.jit import inlined
from pool_sim_ros.physics.solid_sphere import NO_SLIP_SHARE, SPIN_PER_PUSH

Lean = tuple[float, float]


@inlined
def lean_of_edge(radius: float, height: float) -> Lean:
    """Return the lean where the sphere touches an edge at a height in m: Han 2005."""
    sine = height / radius - 1.0
    return math.sqrt((1.0 - sine) * (1.0 + sine)), sine


@inlined
def lean_of_push(radius: float, height: float, nose_radius: float) -> Lean:
    """Return the lean of the line from the ball's centre to the edge, as seen on a table.

    On the table a ball meets a cushion when its centre is one radius away, as if the edge were at
    the height of the centre. So the edge is there, at its height; of a round nose it is the axis.
    """
    across, up = radius + nose_radius, height - radius
    inverse = 1.0 / math.sqrt(across * across + up * up)
    return across * inverse, up * inverse


@inlined
def slip_at_edge(v: Velocity, w: Spin, radius: float, lean: Lean) -> tuple[float, float]:
    """Return how the ball's surface slips over the edge, m/s: along n leaned down, and along t."""
    cosine, sine = lean
    return v[0] * sine + radius * w[1], v[1] + radius * (w[2] * cosine - w[0] * sine)


@inlined
def rigid_share(slip: float, push: float, f: float) -> float:
    """Return the part of the slip, m/s, that friction takes as a push: all that stops it, or less.

    `push` is the push of the edge, m/s. This form needs no direction where there is no slip.
    """
    most = f * push
    if most < NO_SLIP_SHARE * slip:
        return most / slip
    return NO_SLIP_SHARE


@inlined
def rebound(
    v: Velocity, w: Spin, radius: float, lean: Lean, push: float, friction: tuple[float, float]
) -> tuple[Velocity, Spin]:
    """Return velocity and spin after a push away from the edge and a push of friction.

    Both are impulses by the ball's mass, m/s, friction against the slip. What would lift the ball,
    or push it into the cloth, is lost.
    """
    cosine, sine = lean
    along, across = friction
    gain = SPIN_PER_PUSH / radius
    return (
        (v[0] - along * sine - push * cosine, v[1] - across),
        (w[0] + gain * across * sine, w[1] - gain * along, w[2] - gain * across * cosine),
    )
