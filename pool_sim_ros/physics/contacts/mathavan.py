"""A ball between an edge and the cloth: Mathavan, Jackson and Parkin 2010, Equations 12 to 17.

The edge pushes the ball back and down on the cloth, and both rub it. Velocities are functions of
the push of the edge, an impulse by mass in m/s: it grows until the ball has no speed into the
cushion, and then until the edge has done e^2 of the work on the ball that the ball did on it. Axes
here are the paper's, y = n, x = -t, z up.

Four slips tell all: of the ball over the edge, s = (vx + R (wy S - wz C), R wx - vy S), and over
the cloth, c = (vx - R wy, vy + R wx), where C and S are the cosine and the sine of the lean. With
friction F of the edge and G of the cloth per push, |F| <= f and |G| <= mu max(S - F_y C, 0):

    ds = (7/2 F_x + (1 - 5/2 S) G_x,        C S + (5/2 + S^2) F_y + (5/2 - S) G_y)
    dc = ((1 - 5/2 S) F_x + 7/2 G_x,  -C + (5/2 - S) F_y + 7/2 G_y)
    dvy = -C - S F_y + G_y
"""

from __future__ import annotations

import math

from pool_sim_ros.physics.contacts.spheres import Spin, Velocity
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.solid_sphere import SPIN_PER_PUSH
from pool_sim_ros.physics.tolerances import CUSHION_STEPS

Pair = tuple[float, float]
Slips = tuple[Pair, Pair]

RESISTANCE = 1.0 + SPIN_PER_PUSH
"""7/2: what a push across the surface of a free sphere changes of its slip."""

LONGEST = 4
"""Times CUSHION_STEPS, the steps after which a contact is over at the latest. With no friction it
takes 1 + e times; where f is above C / S, an edge far above the centre may stop pushing back."""


@kernel
def integrate_impulse(
    v: Velocity, w: Spin, radius: float, lean: Pair, coefficients: tuple[float, float, float]
) -> tuple[Velocity, Spin]:
    """Return velocity (n, t) and spin (n, t, z) after the contact, m/s and rad/s.

    The error of the steps is of first order; what two step lengths give is extrapolated to none.

    Parameters
    ----------
    v, w : tuple of float
        Velocity (n, t), m/s, into the cushion, and spin (n, t, z), rad/s.
    radius : float
        m.
    lean : tuple of float
        Cosine and sine of the angle to the edge.
    coefficients : tuple of float
        e, f, and the friction of the cloth.
    """
    cosine, sine = lean
    over_edge = (
        -v[1] + radius * (w[0] * sine - w[2] * cosine),
        -radius * w[1] - v[0] * sine,
    )
    over_cloth = -v[1] - radius * w[0], v[0] - radius * w[1]
    slips = over_edge, over_cloth
    coarse = impulses(slips, v[0], lean, coefficients, CUSHION_STEPS)
    fine = impulses(slips, v[0], lean, coefficients, 2 * CUSHION_STEPS)
    edge_x = 2.0 * fine[0] - coarse[0]
    edge_y = 2.0 * fine[1] - coarse[1]
    cloth_x = 2.0 * fine[2] - coarse[2]
    cloth_y = 2.0 * fine[3] - coarse[3]
    push = 2.0 * fine[4] - coarse[4]
    gain = SPIN_PER_PUSH / radius
    return (
        (v[0] - push * cosine - edge_y * sine + cloth_y, v[1] - edge_x - cloth_x),
        (
            w[0] + gain * (edge_x * sine - cloth_x),
            w[1] - gain * (edge_y + cloth_y),
            w[2] - gain * edge_x * cosine,
        ),
    )


@kernel
def impulses(
    slips: Slips, speed: float, lean: Pair, coefficients: tuple[float, float, float], steps: int
) -> tuple[float, float, float, float, float]:
    """Return the impulses by mass, m/s: of friction at edge and cloth (x and y each), and the push.

    Each step takes the friction that the slip at its end needs, so that a slip that ends stays 0
    and needs no angle.

    Parameters
    ----------
    slips : tuple
        Over the edge and over the cloth at the start, x and y, m/s.
    speed : float
        Into the cushion, m/s.
    lean : tuple of float
    coefficients : tuple of float
        As `integrate_impulse` has them.
    steps : int
        Into which the push that would stop the ball without friction is divided.
    """
    cosine, sine = lean
    e = coefficients[0]
    step = speed / (cosine * steps)
    total = (0.0, 0.0, 0.0, 0.0, 0.0)
    cloth = (0.0, 0.0)
    work, rebounds = 0.0, False
    for _ in range(LONGEST * steps):
        # What edge and cloth take depends on both: twice is enough.
        edge, cloth = friction_of_step(slips, lean, coefficients, step, cloth)
        edge, cloth = friction_of_step(slips, lean, coefficients, step, cloth)
        slowing = cosine + sine * edge[1] - cloth[1]
        left = length_left(speed, slowing, work, rebounds)
        length = min(left, step)
        following = speed - slowing * length
        # By the cosine; negative on the way out.
        work += (speed + following) / 2.0 * length
        speed = following
        total = (
            total[0] + length * edge[0],
            total[1] + length * edge[1],
            total[2] + length * cloth[0],
            total[3] + length * cloth[1],
            total[4] + length,
        )
        slips = slips_after(slips, lean, edge, cloth, length)
        if left <= step:
            if rebounds:
                break
            speed, work, rebounds = 0.0, work * e * e, True
            if work <= 0.0:
                break
    return total


@inlined
def length_left(speed: float, slowing: float, work: float, rebounds: bool) -> float:
    """Return the push in m/s that ends compression or, with `work` still to do, the rebound."""
    if not rebounds:
        return speed / slowing if slowing > 0.0 else math.inf
    under_root = speed * speed + 2.0 * slowing * work
    if under_root <= 0.0:
        return math.inf
    return 2.0 * work / (math.sqrt(under_root) - speed)


@inlined
def friction_of_step(
    slips: Slips,
    lean: Pair,
    coefficients: tuple[float, float, float],
    step: float,
    cloth: Pair,
) -> Slips:
    """Return the friction of edge and cloth per push in one step; `cloth` is a first guess."""
    cosine, sine = lean
    _, f, mu_slide = coefficients
    (s_x, s_y), (c_x, c_y) = slips
    across, up = coupling(sine)
    at_edge = s_x + step * across * cloth[0], s_y + step * (cosine * sine + up * cloth[1])
    edge = held_or_slipping(at_edge, (RESISTANCE, SPIN_PER_PUSH + sine * sine), f, step)
    at_cloth = c_x + step * across * edge[0], c_y + step * (up * edge[1] - cosine)
    most = mu_slide * max(sine - edge[1] * cosine, 0.0)
    return edge, held_or_slipping(at_cloth, (RESISTANCE, RESISTANCE), most, step)


@inlined
def coupling(sine: float) -> Pair:
    """Return what friction at the edge does to the slip over the cloth, and the other way round."""
    return 1.0 - SPIN_PER_PUSH * sine, SPIN_PER_PUSH - sine


@inlined
def held_or_slipping(slip: Pair, resistance: Pair, most: float, step: float) -> Pair:
    """Return the friction that ends a slip within a step, or, against it, the most there is."""
    x, y = -slip[0] / (resistance[0] * step), -slip[1] / (resistance[1] * step)
    if x * x + y * y <= most * most:
        return x, y
    x, y = x * resistance[0], y * resistance[1]
    share = most / math.sqrt(x * x + y * y)
    return share * x, share * y


@inlined
def slips_after(slips: Slips, lean: Pair, edge: Pair, cloth: Pair, length: float) -> Slips:
    """Return both slips after a push of `length`, m/s."""
    cosine, sine = lean
    (s_x, s_y), (c_x, c_y) = slips
    across, up = coupling(sine)
    resistance = SPIN_PER_PUSH + sine * sine
    return (
        (
            s_x + length * (RESISTANCE * edge[0] + across * cloth[0]),
            s_y + length * (cosine * sine + resistance * edge[1] + up * cloth[1]),
        ),
        (
            c_x + length * (across * edge[0] + RESISTANCE * cloth[0]),
            c_y + length * (up * edge[1] + RESISTANCE * cloth[1] - cosine),
        ),
    )
