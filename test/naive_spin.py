"""Plain twins of the contacts of balls that spin: vectors in space, as many digits as one likes.

The formulas are those of docs/physics.md without any choice of axes. Velocities and spins are lists
of three mpf; `normal` is a unit vector, from ball 1 to ball 2 or from the ball into the cushion.
`compliant_springs` and `rub_along` step through a contact instead, in plain floats.
"""

import math

from mpmath import mp, mpf

mp.dps = 40


def exact(vector):
    return [mpf(part) for part in vector]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(a, b, share=1):
    """a + share b."""
    return [x + share * y for x, y in zip(a, b, strict=True)]


def times(a, share):
    return [x * share for x in a]


def size(a):
    return mp.sqrt(dot(a, a))


def unit(a):
    return times(exact(a), 1 / size(exact(a)))


def on_cloth(v):
    return [v[0], v[1], mpf(0)]


def surface(v, w, arm):
    """The velocity of a ball's surface at `arm` from its centre."""
    return plus(v, cross(w, arm))


def against(slip, most, stop):
    """The push of friction against a slip: `stop` times the slip, `most` in size at most."""
    if size(slip) == 0:
        return times(slip, 0)
    return times(slip, -min(stop, most / size(slip)))


def alciatore(slip):
    return mpf(0.009951) + mpf(0.108) * mp.exp(-mpf(1.088) * slip)  # the doubles, exactly


def collide_balls(v1, w1, v2, w2, normal, m1, m2, radius, e, mu, bound='impulse'):
    """Two balls; `mu` is a function of the slip."""
    v1, w1, v2, w2, n = (exact(each) for each in (v1, w1, v2, w2, normal))
    m1, m2, radius, e = exact((m1, m2, radius, e))
    reduced = m1 * m2 / (m1 + m2)
    closing = dot(plus(v1, v2, -1), n)
    push = reduced * (1 + e) * closing
    slip = plus(surface(v1, w1, times(n, radius)), surface(v2, w2, times(n, -radius)), -1)
    slip = plus(slip, n, -dot(slip, n))
    bounding = push if bound == 'impulse' else 2 * reduced * e * closing
    friction = against(slip, mu(size(slip)) * bounding, mpf(2) / 7 * reduced)
    on_1 = plus(friction, n, -push)
    v1, v2 = plus(v1, on_1, 1 / m1), plus(v2, on_1, -1 / m2)
    for w, m in ((w1, m1), (w2, m2)):
        w[:] = plus(w, cross(times(n, radius), friction), 5 / (2 * m * radius**2))
    return on_cloth(v1), w1, on_cloth(v2), w2


def push_direction(normal, radius, height, nose_radius, model):
    """The unit vector along which the edge pushes."""
    radius, height = mpf(radius), mpf(height)
    if model == 'impulse' or model == 'stronge':
        across, up = radius + mpf(nose_radius), radius - height
    else:
        sine = height / radius - 1
        across, up = mp.sqrt(1 - sine**2), -sine
    return unit([-across * normal[0], -across * normal[1], up])


def collide_cushion(v, w, normal, radius, height, e, f, model, nose_radius=0):
    """A ball and an edge: 'han', 'impulse' or 'stronge'."""
    v, w, n = exact(v), exact(w), exact(normal)
    m = push_direction(n, radius, height, nose_radius, model)
    radius, e, f = exact((radius, e, f))
    arm = times(m, -radius)
    closing = -dot(v, m)
    push = (1 + e) * closing
    slip = surface(v, w, arm)
    slip = plus(slip, m, -dot(slip, m))
    if model == 'stronge':
        left = compliant_slip(size(slip), closing, e, f) / size(slip) if size(slip) else mpf(1)
        friction = times(slip, (left - 1) * 2 / 7)
    else:
        friction = against(slip, f * push, mpf(2) / 7)
    w = plus(w, cross(arm, friction), 5 / (2 * radius**2))
    return on_cloth(plus(plus(v, m, push), friction)), w


FREQUENCY_RATIO = mpf(1.8)


def compliant_slip(slip, closing, e, f, ratio=FREQUENCY_RATIO):
    """The slip after Stronge's contact, as the formulas of its three cases have it.

    Times in units of the normal spring. `angle(t)` is that of the normal spring.
    """
    beta, r = mpf(7) / 2, slip / closing
    eta2 = beta / ratio**2
    t_c = mp.pi / 2
    t_f = (1 + e) * t_c

    def angle(t):
        return t if t <= t_c else t_c + (t - t_c) / e

    gross = max(beta, (1 + e) * beta - eta2 / e) if e > 0 else beta
    if r >= f * gross:
        return closing * (r - f * beta * (1 + e))
    if r <= f * eta2:
        t1, u1, y1 = mpf(0), mpf(0), r
    elif r <= f * beta:
        t1 = mp.acos((r / f - beta) / (eta2 - beta))
        u1, y1 = f * eta2 * mp.sin(t1), r - f * beta * (1 - mp.cos(t1))
    else:
        theta = mp.acos((r / f - beta) / (eta2 / e - e * beta))
        t1 = t_c + e * (theta - t_c)
        u1, y1 = f * eta2 * mp.sin(theta), r - f * beta * (1 - e * mp.cos(theta))

    def spring(t):
        return u1 * mp.cos(ratio * (t - t1)) + y1 / ratio * mp.sin(ratio * (t - t1))

    def loose(t):
        return abs(spring(t)) > f * eta2 * mp.sin(angle(t))

    # The first time at which the spring is too strong, on a fine grid, then by halves.
    low = max(t1, t_c)
    for k in range(1, 401):
        high = low + (t_f - low) * k / 400
        if k == 400 or loose(high):
            break
    low = low + (t_f - low) * (k - 1) / 400
    for _ in range(140):
        middle = (low + high) / 2
        low, high = (low, middle) if loose(middle) else (middle, high)
    y2 = -ratio * u1 * mp.sin(ratio * (high - t1)) + y1 * mp.cos(ratio * (high - t1))
    side = 1 if spring(high) > 0 else -1
    return closing * (y2 - side * f * beta * e * (1 + mp.cos(angle(high))))


def compliant_springs(slip, closing, e, f, ratio=1.8, steps=20_000):
    """The same by steps in time: a spring that slips where it would pull more than friction can."""
    eta2 = 3.5 / ratio**2
    u, y = 0.0, slip / closing
    dt = (1 + e) * math.pi / 2 / steps
    for k in range(1, steps + 1):
        t = k * dt
        angle = t if t <= math.pi / 2 else math.pi / 2 + (t - math.pi / 2) / e
        most = f * eta2 * max(math.sin(min(angle, math.pi)), 0.0)
        u = min(max(u + y * dt, -most), most)
        y -= 3.5 * u / eta2 * dt
    return y * closing


def rub_along(v, w, radius, height, e, f, mu_slide, steps):
    """Mathavan, Jackson and Parkin 2010, Equations 12 to 17, by Euler's method.

    In their axes: y into the cushion, x along it, z up. `v` is (x, y). A slip of zero has no angle,
    so then there is no friction.
    """
    (vx, vy), (wx, wy, wz) = v, w
    sine = height / radius - 1
    cosine = math.sqrt(1 - sine * sine)
    dp = vy / steps
    work, goal = 0.0, None
    while goal is None or work < goal:
        slip = math.hypot(vx + wy * radius * sine - wz * radius * cosine, -vy * sine + wx * radius)
        cos_a = (vx + wy * radius * sine - wz * radius * cosine) / slip if slip else 0.0
        sin_a = (-vy * sine + wx * radius) / slip if slip else 0.0
        slip = math.hypot(vx - wy * radius, vy + wx * radius)
        cos_b = (vx - wy * radius) / slip if slip else 0.0
        sin_b = (vy + wx * radius) / slip if slip else 0.0
        share = max(sine + f * sin_a * cosine, 0.0)
        before = vy
        vx -= (f * cos_a + mu_slide * cos_b * share) * dp
        vy -= (cosine - f * sine * sin_a + mu_slide * sin_b * share) * dp
        factor = 5 / (2 * radius) * dp
        wx -= factor * (f * sin_a + mu_slide * sin_b * share)
        wy -= factor * (f * cos_a * sine - mu_slide * cos_b * share)
        wz += factor * f * cos_a * cosine
        work += cosine * abs(before + vy) / 2 * dp
        if goal is None and vy <= 0:
            work, goal = 0.0, e * e * work
    return (vx, vy), (wx, wy, wz)
