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
    if v[0] <= 0.0:
        return v, w
    if law.model == MATHAVAN:
        lean = lean_of_edge(radius, law.height)
        return integrate_impulse(v, w, radius, lean, (law.e, law.f, law.mu_slide))
    if law.model == HAN:
        lean = lean_of_edge(radius, law.height)
    else:
        lean = lean_of_push(radius, law.height, nose_radius)
    closing = v[0] * lean[0]
    push = (1.0 + law.e) * closing
    along, across = slip_at_edge(v, w, radius, lean)
    slip = math.sqrt(along * along + across * across)
    if law.model == STRONGE:
        share = compliant_share(slip, closing, law.e, law.f)
    else:
        share = rigid_share(slip, push, law.f)
    return rebound(v, w, radius, lean, push, (share * along, share * across))


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
    nx, ny = normal
    v_local = v[0] * nx + v[1] * ny, v[1] * nx - v[0] * ny
    w_local = w[0] * nx + w[1] * ny, w[1] * nx - w[0] * ny, w[2]
    (v_n, v_t), (w_n, w_t, w_z) = meet_edge(law, v_local, w_local, radii[0], radii[1])
    v_n = min(v_n, -separation)
    return (
        (v_n * nx - v_t * ny, v_n * ny + v_t * nx),
        (w_n * nx - w_t * ny, w_n * ny + w_t * nx, w_z),
    )
