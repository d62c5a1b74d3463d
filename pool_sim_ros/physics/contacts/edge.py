"""A ball that spins against the edge of a cushion: four models, chosen by number.

The edge has a height. At a contact n points from the ball into the cushion, t = z x n, and z
points up. The models work in these axes: velocity (n, t), m/s, and spin (n, t, z), rad/s. The ball
stays on the cloth. `rigid_edge`, `stronge` and `mathavan` have the models, docs/physics.md their
sources.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from pool_sim_ros.physics.contacts.mathavan import integrate_impulse
from pool_sim_ros.physics.contacts.rigid_edge import (
    Lean,
    lean_of_edge,
    lean_of_push,
    rebound,
    rigid_share,
    slip_at_edge,
)
from pool_sim_ros.physics.contacts.spheres import Spin, Velocity
from pool_sim_ros.physics.contacts.stronge import compliant_share
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.law_names import CUSHION_MODELS
from pool_sim_ros.physics.tolerances import NO_CLOSING

HAN, IMPULSE, STRONGE, MATHAVAN = range(len(CUSHION_MODELS))
"""The models by number, as kernels have them."""


class EdgeLaw(NamedTuple):
    """What happens between a ball and the edge of a cushion.

    Attributes
    ----------
    model : int
        Index in CUSHION_MODELS.
    e, f : float
        Coefficients of restitution and of friction.
    height : float
        Of the edge above the cloth, m: between half a radius and two.
    mu_slide : float
        Friction of the ball on the cloth, which only `mathavan` needs.
    """

    model: int
    e: float
    f: float
    height: float
    mu_slide: float


@inlined
def lean_of(law: EdgeLaw, radius: float, nose_radius: float) -> Lean:
    """Return the lean of the push, by model; see `rigid_edge`."""
    if law.model == HAN or law.model == MATHAVAN:
        return lean_of_edge(radius, law.height)
    return lean_of_push(radius, law.height, nose_radius)


@inlined
def parting_of_push(law: EdgeLaw, lean: Lean, closing: float) -> float:
    """Return how fast a ball parts along the normal after the push of the edge alone, m/s.

    `closing` is its speed into the cushion. Since the push is leaned, and the ball stays on the
    cloth, this is less than e times `closing`, and may be negative.
    """
    return closing * ((1.0 + law.e) * lean[0] * lean[0] - 1.0)


@kernel
def friction_of_edge(
    law: EdgeLaw, v: Velocity, w: Spin, radius: float, lean: Lean, push: float
) -> tuple[float, float]:
    """Return the push of friction, m/s, as `rebound` takes it, in the axes of the contact.

    That of `mathavan`, which is no sum of a push and friction, is that of `han` here.

    Parameters
    ----------
    law : EdgeLaw
    v : tuple of float
        Velocity (n, t) before the push of the edge, m/s. In `stronge` the spring along the push
        has this closing speed.
    w : tuple of float
        Spin (n, t, z), rad/s.
    radius : float
        Of the ball, m.
    lean : tuple of float
        As `lean_of` has it.
    push : float
        Of the edge, an impulse by mass along the lean, m/s.
    """
    along, across = slip_at_edge(v, w, radius, lean)
    slip = math.sqrt(along * along + across * across)
    if law.model == STRONGE:
        share = compliant_share(slip, push / (1.0 + law.e), law.e, law.f)
    else:
        share = rigid_share(slip, push, law.f)
    return share * along, share * across


@kernel
def meet_edge(
    law: EdgeLaw, v: Velocity, w: Spin, radius: float, nose_radius: float
) -> tuple[Velocity, Spin]:
    """Return velocity and spin in the axes of the contact after a ball has met an edge.

    A ball that does not move into the cushion gets no push. Another need not part: with h > R
    friction may leave it on its way into the cushion.

    Parameters
    ----------
    law : EdgeLaw
    v : tuple of float
        Velocity (n, t), m/s.
    w : tuple of float
        Spin (n, t, z), rad/s.
    radius : float
        Of the ball, m.
    nose_radius : float
        Of a round nose, m; 0 for a straight cushion.
    """
    if not v[0] > NO_CLOSING:
        return v, w
    lean = lean_of(law, radius, nose_radius)
    if law.model == MATHAVAN:
        return integrate_impulse(v, w, radius, lean, (law.e, law.f, law.mu_slide))
    push = (1.0 + law.e) * v[0] * lean[0]
    friction = friction_of_edge(law, v, w, radius, lean, push)
    return rebound(v, w, radius, lean, push, friction)


@inlined
def to_contact_axes(v: Velocity, w: Spin, normal: Velocity) -> tuple[Velocity, Spin]:
    """Return velocity (n, t) and spin (n, t, z) of vectors along x, y (and z)."""
    nx, ny = normal
    return (
        (v[0] * nx + v[1] * ny, v[1] * nx - v[0] * ny),
        (w[0] * nx + w[1] * ny, w[1] * nx - w[0] * ny, w[2]),
    )


@inlined
def from_contact_axes(v: Velocity, w: Spin, normal: Velocity) -> tuple[Velocity, Spin]:
    """Return velocity (x, y) and spin (x, y, z), of which `to_contact_axes` gives these parts."""
    nx, ny = normal
    return (
        (v[0] * nx - v[1] * ny, v[0] * ny + v[1] * nx),
        (w[0] * nx - w[1] * ny, w[0] * ny + w[1] * nx, w[2]),
    )


@inlined
def collide_with_edge(
    law: EdgeLaw,
    v: Velocity,
    w: Spin,
    normal: Velocity,
    radii: tuple[float, float],
    separation: float,
) -> tuple[Velocity, Spin]:
    """Return velocity and spin, both along x, y (and z), after a ball has met an edge.

    Parameters
    ----------
    law : EdgeLaw
    v, w : tuple of float
        Velocity (x, y), m/s, into the cushion, and spin (x, y, z), rad/s.
    normal : tuple of float
        Unit vector from the ball into the cushion.
    radii : tuple of float
        Of the ball and of a round nose, m; 0 for a straight cushion.
    separation : float
        The least speed at which the ball parts from the cushion, m/s.
    """
    v, w = to_contact_axes(v, w, normal)
    v, w = meet_edge(law, v, w, radii[0], radii[1])
    return from_contact_axes((min(v[0], -separation), v[1]), w, normal)
