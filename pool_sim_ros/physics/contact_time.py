"""When two things that move towards each other touch.

Nothing is discarded by an epsilon (Bannerman et al., arXiv 1211.6718): a pair
that touches or overlaps and approaches meets now, one that separates does not.
"""

import numpy as np

from pool_sim_ros.physics.kernel import inlined

MAX_STEPS = 200
"""Far beyond what quadratic convergence needs; a graze, where it is linear, takes about 50."""


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
def passes_by(dx, dy, wx, wy, gx, gy, touch, horizon):
    """Return whether two balls stay too far apart sideways to touch before `horizon`.

    Across the relative velocity w the second ball moves by its acceleration alone, from
    ``d x w`` to ``d x w + t^2 g x w / 2``, in units of |w|. Arguments as `time_to_moving_ball`.
    """
    before = dx * wy - dy * wx
    after = before + 0.5 * horizon * horizon * (gx * wy - gy * wx)
    least = min(abs(before), abs(after))
    margin = touch * touch * (wx * wx + wy * wy)
    return (before * after > 0.0) & (least * least > margin * (1.0 + 1e-9))


@inlined
def stays_away(dx, dy, wx, wy, gx, gy, touch, horizon):
    """Return whether two balls, along their present centre line, stay too far apart to touch.

    That is before `horizon`. Arguments as `time_to_moving_ball`.
    """
    squared = dx * dx + dy * dy
    closing = min(dx * wx + dy * wy, 0.0)
    bending = min(dx * gx + dy * gy, 0.0)
    least = squared + horizon * (closing + 0.5 * horizon * bending)
    apart = (least > 0.0) & (least * least > touch * touch * squared * (1.0 + 1e-9))
    return apart | (closing + bending == 0.0)


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
    With the present centre line held fixed, the gap along it is a quadratic
    in time and never more than the true gap. Its first root is therefore a
    lower bound of the contact time: step there and repeat. It cannot step past a
    contact, and converges as Newton's method does.
    """
    if (
        (horizon <= 0.0)
        | stays_away(dx, dy, wx, wy, gx, gy, touch, horizon)
        | passes_by(dx, dy, wx, wy, gx, gy, touch, horizon)
    ):
        return np.inf
    t = 0.0
    for _ in range(MAX_STEPS):
        px = dx + t * (wx + 0.5 * t * gx)
        py = dy + t * (wy + 0.5 * t * gy)
        distance = np.sqrt(px * px + py * py)
        inverse = 1.0 / distance
        nx, ny = px * inverse, py * inverse
        gap = max(distance - touch, 0.0)
        closing = -(nx * (wx + t * gx) + ny * (wy + t * gy))
        step = first_root(gap, closing, nx * gx + ny * gy)
        if not t + step < horizon:
            return np.inf
        if t + step == t:
            return t
        t += step
    return t
