"""When two balls that both move touch: never by stepping past a contact.

Nothing is discarded by an epsilon (Bannerman et al., arXiv 1211.6718): a pair that touches or
overlaps and approaches meets now, one that separates does not. Any two motions of constant
acceleration will do.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from pool_sim_ros.physics.jit import inlined
from pool_sim_ros.physics.tolerances import (
    GAP_ROUNDING,
    MAX_STEPS,
    PRESSED,
    ROOT_MARGIN,
    TOUCH_ROUNDING,
    TOUCHING,
)


class RelativeMotion(NamedTuple):
    """Position in m, velocity in m/s and constant acceleration in m/s^2 of a second ball.

    All are relative to a first one.
    """

    dx: float
    dy: float
    wx: float
    wy: float
    gx: float
    gy: float


@inlined
def after(motion: RelativeMotion, t: float) -> RelativeMotion:
    """Return the same motion `t` s later."""
    dx, dy, wx, wy, gx, gy = motion
    return RelativeMotion(
        dx + t * (wx + 0.5 * t * gx),
        dy + t * (wy + 0.5 * t * gy),
        wx + t * gx,
        wy + t * gy,
        gx,
        gy,
    )


@inlined
def first_root(gap: float, closing: float, opening: float) -> float:
    """Return the smallest root >= 0 of ``gap - closing t + opening t^2 / 2``; inf for none.

    `gap` must not be negative, unless `closing` and `opening` are: then it is the root at which it
    becomes negative again.
    """
    if gap == 0.0 and closing > 0.0:
        return 0.0
    if opening >= 0.0 and closing <= 0.0:
        return np.inf
    discriminant = closing * closing - 2.0 * opening * gap
    if discriminant < 0.0:
        return np.inf
    root = np.sqrt(discriminant)
    if closing > 0.0:
        return 2.0 * gap / (closing + root)
    return (closing - root) / opening


@inlined
def time_to_line(gap: float, closing: float, pressing: float, lasts: float) -> float:
    """Return the first time before `lasts` at which a ball touches a straight line; inf for none.

    Parameters
    ----------
    gap : float
        Between them, m. Where it is below -TOUCHING the ball is beyond the line, and touches it
        when it comes back after it came out.
    closing : float
        Speed towards the line, m/s.
    pressing : float
        Acceleration towards it, m/s^2.
    lasts : float
        s; finite where `pressing` is not zero.
    """
    if gap > -TOUCHING:
        gap = gap if gap > GAP_ROUNDING else 0.0
    if closing <= 0.0:
        # A ball that lies on the line, and moves along it, is pressed by no more than rounding.
        if pressing <= 0.0 or lasts * (closing + 0.5 * pressing * lasts) - gap <= PRESSED:
            return np.inf
    elif gap < 0.0:
        return np.inf
    t = first_root(gap, closing, -pressing)
    return t if t < lasts else np.inf


@inlined
def gap_from_below(
    motion: RelativeMotion, touch: float, horizon: float
) -> tuple[float, float, float]:
    """Return a parabola in time that the squared gap of two balls is never below.

    That holds up to `horizon`. It is the difference of the squares of distance and `touch`, m^2,
    as the `gap`, `closing` and `opening` of `first_root`. Arguments as `time_to_moving_ball`.

    The square of ``d + w t + g t^2 / 2`` is a quartic. Its cubic term is ``w g t^3``, and together
    with the last one it is no less than ``-w^2 t^2``: both are taken at their worst.
    """
    dx, dy, wx, wy, gx, gy = motion
    squared = wx * wx + wy * wy
    bending = wx * gx + wy * gy
    worst = max(bending * horizon, -squared) if bending < 0.0 else 0.0
    touch_squared = touch * touch
    gap = dx * dx + dy * dy - touch_squared
    gap = gap if gap > TOUCH_ROUNDING * touch_squared else 0.0
    return gap, -2.0 * (dx * wx + dy * wy), 2.0 * (squared + dx * gx + dy * gy + worst)


@inlined
def stays_positive(gap: float, closing: float, opening: float, horizon: float) -> bool:
    """Return whether ``gap - closing t + opening t^2 / 2`` has no root before `horizon`.

    False where rounding might decide.
    """
    at_end = gap - horizon * (closing - 0.5 * horizon * opening)
    above = closing * closing < 2.0 * opening * gap * (1.0 - ROOT_MARGIN)
    return (at_end > ROOT_MARGIN * gap) & (above | (closing <= 0.0) | (closing > opening * horizon))


@inlined
def time_to_moving_ball(motion: RelativeMotion, touch: float, horizon: float) -> float:
    """Return the time in s until two moving balls touch; inf if not before `horizon`.

    Parameters
    ----------
    motion : RelativeMotion
        Of the second ball relative to the first.
    touch : float
        Sum of the radii, m.
    horizon : float
        Neither ball changes its motion before, s.

    Notes
    -----
    The first root of a parabola that the squared gap is never below is a lower bound of the
    contact time: step there and repeat. This cannot step past a contact, and converges as Newton's
    method does; without friction the first step is exact.
    """
    gap, closing, opening = gap_from_below(motion, touch, horizon)
    if (horizon <= 0.0) | stays_positive(gap, closing, opening, horizon):
        return np.inf
    t = 0.0
    for _ in range(MAX_STEPS):
        step = first_root(gap, closing, opening)
        if not t + step < horizon:
            return np.inf
        if t + step == t:
            return t
        t += step
        gap, closing, opening = gap_from_below(after(motion, t), touch, horizon - t)
    return t
