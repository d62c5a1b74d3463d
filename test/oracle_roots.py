"""Real roots of polynomials by isolation, in the precision that mpmath is set to."""

import math

from mpmath import mp, mpf


def evaluate(polynomial, t):
    """Horner; coefficients from the constant term up."""
    value = mpf(0)
    for coefficient in reversed(polynomial):
        value = value * t + coefficient
    return value


def derivative(polynomial):
    return [k * coefficient for k, coefficient in enumerate(polynomial)][1:]


def real_roots(polynomial, low, high):
    """Roots in [low, high] at which the sign changes, in order.

    Between two neighbouring roots of its derivative a polynomial is monotonic, so the roots are
    bracketed from the derivative's, down to the linear one.
    """
    while polynomial and polynomial[-1] == 0:
        polynomial = polynomial[:-1]
    if len(polynomial) < 2:
        return []
    turns = real_roots(derivative(polynomial), low, high)
    knots = [low, *turns, high]
    roots = []
    for left, right in zip(knots, knots[1:], strict=False):
        if evaluate(polynomial, left) * evaluate(polynomial, right) < 0:
            roots.append(bracketed_root(polynomial, left, right))
    return roots


def bracketed_root(polynomial, low, high):
    """Newton's method, replaced by bisection wherever it leaves the bracket."""
    slope = derivative(polynomial)
    rising = evaluate(polynomial, high) > 0
    t = (low + high) / 2
    for _ in range(400):
        value = evaluate(polynomial, t)
        if value == 0:
            return t
        if (value > 0) == rising:
            high = t
        else:
            low = t
        rise = evaluate(slope, t)
        step = t - value / rise if rise != 0 else low
        if not low < step < high:
            step = (low + high) / 2
        if abs(step - t) <= mpf(10) ** (3 - mp.dps):
            return step
        t = step
    return t


def segment_distance(p0, p1, q0, q1):
    """Distance of two segments in double precision: 0 where they cross, else from an end."""

    def cross(u, w):
        return u[0] * w[1] - u[1] * w[0]

    def from_point(point, start, end):
        along = end - start
        length = along @ along
        share = min(1.0, max(0.0, (point - start) @ along / length)) if length > 0 else 0.0
        return math.hypot(*(start + share * along - point))

    sides_q = cross(p1 - p0, q0 - p0) * cross(p1 - p0, q1 - p0)
    sides_p = cross(q1 - q0, p0 - q0) * cross(q1 - q0, p1 - q0)
    if sides_q <= 0 and sides_p <= 0:
        return 0.0
    ends = ((p0, q0, q1), (p1, q0, q1), (q0, p0, p1), (q1, p0, p1))
    return min(from_point(*end) for end in ends)
