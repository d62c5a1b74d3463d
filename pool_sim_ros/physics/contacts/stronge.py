"""A ball against an edge that gives: Stronge's impact of compliant bodies with friction (1994).

At the point of contact sits a spring along the push and one along the slip, and the latter is held
by Coulomb's friction. While friction holds it, the point sticks; otherwise it slips. Time is in
units of the frequency of the first spring, speeds in units of the closing speed, and the
deformation of the second spring and the slip moreover in units of f. So friction holds up to
L(angle) = ETA_SQUARED sin(angle), where the angle of the first spring is the time t up to pi/2,
when compression ends, and pi/2 + (t - pi/2) / e then. It ends at pi.
"""

from __future__ import annotations

import math

from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.solid_sphere import NO_SLIP_SHARE, SPIN_PER_PUSH
from pool_sim_ros.physics.tolerances import MAX_STEPS, ROOT_PRECISION

FREQUENCY_RATIO = 1.8
"""Frequency of the spring along the slip over that along the push; pooltool's value.

It follows from Poisson's ratio, and must be between 1 and 2.
"""

BETA = 1.0 + SPIN_PER_PUSH
"""7/2: what a push across the surface changes of its slip."""

HALF_PI = math.pi / 2.0


@inlined
def compliant_share(slip: float, closing: float, e: float, f: float) -> float:
    """Return the part of the slip that friction takes as a push, as `rigid_share` does.

    `slip` and `closing` are speeds in m/s across and along the push, at the point of contact. Where
    the slip is reversed the part is more than NO_SLIP_SHARE, up to twice that.
    """
    if slip == 0.0:
        return NO_SLIP_SHARE
    if slip >= gross_slip(e, FREQUENCY_RATIO) * f * closing:
        return f * (1.0 + e) * closing / slip
    scaled = slip / (f * closing)
    return (1.0 - remaining_slip(scaled, e, FREQUENCY_RATIO) / scaled) / BETA


@inlined
def gross_slip(e: float, ratio: float) -> float:
    """Return the least slip that never ends during the contact.

    Slip ends when the point, which follows the spring, has no speed: in compression from BETA
    down; in restitution where (1 + e) BETA - ETA_SQUARED / e or less was left. The latter is above
    BETA where e is above 1 / ratio. Below that, slip cannot end in restitution. (pooltool 0.6.0 has
    the second term alone, so it takes every slip as gross where e is small.)
    """
    if e * ratio > 1.0:
        return BETA * (1.0 + e - 1.0 / (ratio * ratio * e))
    return BETA


@kernel
def remaining_slip(slip: float, e: float, ratio: float) -> float:
    """Return the slip at the end of a contact in which the point sticks for a while.

    `slip` is that at the start, not negative; after a reversal it is negative.
    """
    eta_squared = BETA / (ratio * ratio)
    # Where sticking begins: time, deformation u and slip y.
    t, u, y = 0.0, 0.0, slip
    if slip > BETA:
        cosine = max((slip - BETA) / (eta_squared / e - e * BETA), -1.0)
        angle = math.acos(cosine)
        t = HALF_PI + e * (angle - HALF_PI)
        u, y = eta_squared * math.sin(angle), eta_squared * cosine / e
    elif slip > eta_squared:
        cosine = (BETA - slip) / (BETA - eta_squared)
        t = math.acos(cosine)
        u, y = eta_squared * math.sin(t), eta_squared * cosine
    # The spring swings: u = size sin(ratio (t - zero)).
    size = math.sqrt(u * u + y * y / (ratio * ratio))
    zero = t - math.atan2(ratio * u, y) / ratio
    angle = end_of_sticking(size, zero, e, ratio)
    swing = ratio * (HALF_PI + e * (angle - HALF_PI) - zero)
    side = 1.0 if swing < math.pi else -1.0
    # From then on friction takes what of the push is left, against the force of the spring.
    half = math.cos(angle / 2.0)
    return ratio * size * math.cos(swing) - side * BETA * e * 2.0 * half * half


@kernel
def end_of_sticking(size: float, zero: float, e: float, ratio: float) -> float:
    """Return the angle of the first spring at which the second breaks loose.

    That is where |u| = L. Both are swings, u of frequency `ratio`, and L of frequency 1 in
    compression and 1 / e in restitution. Where both are positive, the sign of the rate of |u| / L
    is that of D = |u|' L - |u| L', and D' = |u| L (1/e^2 - ratio^2), or (1 - ratio^2) in
    compression.

    - Compression: D starts at 0 or less, where sticking begins with |u| <= L and, after slip, with
      |u|' = L'. It falls, so |u| <= L up to pi/2.
    - u is 0 at zero + pi / ratio, which is after pi/2, since zero is not negative and ratio < 2;
      and again only after 2 pi / ratio > pi, when the contact is over. L is 0 at the end.
    - u is 0 before L is: until then |u| / L falls. For D cannot be positive and |u| fall to 0: if
      e ratio > 1, D begins at 0 or less and falls; else it rises. From there to the end D is
      monotonic, and positive at both ends, so |u| / L rises from 0 to infinity: one root.
    - L is 0 first: then e ratio < 1, D rises, and |u| / L falls, then rises to infinity: one root,
      since |u| <= L at pi/2.

    So from the later of pi/2 and the zero of u up to pi there is one root, where |u| - L becomes
    positive. Newton's method; where that leaves the bracket or is slow, bisection.
    """
    eta_squared = BETA / (ratio * ratio)
    low, high = HALF_PI, math.pi
    side = 1.0
    turn = zero + math.pi / ratio
    if e > 0.0 and turn < HALF_PI + e * HALF_PI:
        low, side = max(HALF_PI + (turn - HALF_PI) / e, HALF_PI), -1.0
    angle, last = (low + high) / 2.0, high - low
    for _ in range(MAX_STEPS):
        swing = ratio * (HALF_PI + e * (angle - HALF_PI) - zero)
        over = side * size * math.sin(swing) - eta_squared * math.sin(angle)
        rate = side * size * ratio * e * math.cos(swing) - eta_squared * math.cos(angle)
        if over < 0.0:
            low = angle
        else:
            high = angle
        step = -over / rate if rate != 0.0 else high - low
        following = angle + step
        if not low <= following <= high or abs(step) > last / 2.0:
            following = (low + high) / 2.0
        last = abs(following - angle)
        angle = following
        if last <= ROOT_PRECISION:
            break
    return angle
