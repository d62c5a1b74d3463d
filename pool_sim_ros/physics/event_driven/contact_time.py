"""When two things that move towards each other touch.

Nothing is discarded by an epsilon (Bannerman et al., arXiv 1211.6718): a pair
that touches or overlaps and approaches meets now, one that separates does not.
"""

import numpy as np

from pool_sim_ros.physics.jit import inlined

MAX_STEPS = 200
"""Far beyond what quadratic convergence needs; a graze, where it is linear, takes about 50."""

TOUCH_ROUNDING = 2.0**-51
"""Part of the square of the distance at contact that rounding may add to or take from it."""


@inlined
def time_to_cover(way, speed, deceleration):
    """Return the time in s to roll `way` m, which must be within reach.

    The smaller root of ``way = speed t - deceleration t^2 / 2``, without cancellation.
    """
    return 2.0 * way / (speed + np.sqrt(max(speed * speed - 2.0 * deceleration * way, 0.0)))


@inlined
def way_to_resting_ball(dx, dy, ux, uy, touch, reach):
    """Return the way in m along (ux, uy) to a ball at rest at (dx, dy); inf for a miss.

    `touch` is the sum of the radii. A graze is a miss: it exchanges nothing. So, here, is what
    is farther than `reach`.
    """
    along = dx * ux + dy * uy
    aside = dx * uy - dy * ux
    half_chord_squared = touch * touch - aside * aside
    # One test, nearly always false: each of the three would be guessed wrong half the time.
    if (along > 0.0) & (along - touch < reach) & (half_chord_squared > 0.0):
        return max(along - np.sqrt(half_chord_squared), 0.0)
    return np.inf


@inlined
def first_root(gap, closing, opening):
    """Return the smallest root >= 0 of ``gap - closing t + opening t^2 / 2``; inf for none.

    `gap` must not be negative.
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
def gap_from_below(dx, dy, wx, wy, gx, gy, touch, horizon):
    """Return a parabola in time that the squared gap of two balls is never below.

    That is up to `horizon`: the difference of the squares of distance and `touch`, m^2, as the
    `gap`, `closing` and `opening` of `first_root`. Arguments as `time_to_moving_ball`.

    The square of ``d + w t + g t^2 / 2`` is a quartic whose cubic term is ``w g t^3``, and with
    the last one no less than ``-w^2 t^2``: both are taken at their worst.
    """
    squared = wx * wx + wy * wy
    bending = wx * gx + wy * gy
    worst = max(bending * horizon, -squared) if bending < 0.0 else 0.0
    touch_squared = touch * touch
    gap = dx * dx + dy * dy - touch_squared
    gap = gap if gap > TOUCH_ROUNDING * touch_squared else 0.0
    return gap, -2.0 * (dx * wx + dy * wy), 2.0 * (squared + dx * gx + dy * gy + worst)


@inlined
def stays_positive(gap, closing, opening, horizon):
    """Return whether ``gap - closing t + opening t^2 / 2`` has no root before `horizon`.

    False where rounding might decide.
    """
    at_end = gap - horizon * (closing - 0.5 * horizon * opening)
    above = closing * closing < 2.0 * opening * gap * (1.0 - 1e-9)
    return (at_end > 1e-9 * gap) & (above | (closing <= 0.0) | (closing > opening * horizon))


@inlined
def time_to_moving_ball(dx, dy, wx, wy, gx, gy, touch, horizon):
    """Return the time in s until two moving balls touch; inf if not before `horizon`.

    Parameters
    ----------
    dx, dy, wx, wy, gx, gy : float
        Place, velocity and acceleration of the second ball relative to the
        first: m, m/s, m/s^2.
    touch : float
        Sum of the radii, m.
    horizon : float
        Neither ball changes its motion before, s.

    Notes
    -----
    The first root of a parabola that the squared gap is never below is a lower
    bound of the contact time: step there and repeat. It cannot step past a
    contact, and converges as Newton's method does; without friction the first
    step is exact.
    """
    gap, closing, opening = gap_from_below(dx, dy, wx, wy, gx, gy, touch, horizon)
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
        gap, closing, opening = gap_from_below(
            dx + t * (wx + 0.5 * t * gx),
            dy + t * (wy + 0.5 * t * gy),
            wx + t * gx,
            wy + t * gy,
            gx,
            gy,
            touch,
            horizon - t,
        )
    return t
