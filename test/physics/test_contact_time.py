"""The compiled contact times against plain twins and against roots in 50 digits."""

import math

import naive
import numpy as np
import oracle_roots
import pytest
from mpmath import mp, mpf
from numba import njit

from pool_sim_ros.physics.contact_time import (
    RelativeMotion,
    after,
    gap_from_below,
    stays_positive,
    time_to_line,
    time_to_moving_ball,
)

A = 0.980665


def relative(position_a, velocity_a, position_b, velocity_b, deceleration):
    """Return the motion of b relative to a, and the first stop."""
    speeds = [math.hypot(*velocity) for velocity in (velocity_a, velocity_b)]
    g = [-deceleration * (velocity_b[k] / speeds[1] - velocity_a[k] / speeds[0]) for k in (0, 1)]
    d, w = np.subtract(position_b, position_a), np.subtract(velocity_b, velocity_a)
    motion = RelativeMotion(*map(float, (*d, *w, *g)))
    return motion, min(speeds) / deceleration if deceleration > 0 else math.inf


def exact_first_entry(dx, dy, wx, wy, gx, gy, touch, horizon):
    """Return the first entry into contact from the exact quartic, None where it is unsafe."""
    with mp.workdps(50):
        d, w = [mpf(dx), mpf(dy)], [mpf(wx), mpf(wy)]
        c = [mpf(gx) / 2, mpf(gy) / 2]

        def dot(u, v):
            return u[0] * v[0] + u[1] * v[1]

        gap = [
            dot(d, d) - mpf(touch) ** 2,
            2 * dot(d, w),
            dot(w, w) + 2 * dot(d, c),
            2 * dot(w, c),
            dot(c, c),
        ]
        slope = oracle_roots.derivative(gap)
        turns = oracle_roots.real_roots(slope, mpf(0), mpf(horizon))
        if any(abs(oracle_roots.evaluate(gap, t)) < mpf('1e-14') for t in [*turns, mpf(horizon)]):
            return None
        roots = oracle_roots.real_roots(gap, mpf(0), mpf(horizon))
        entries = [t for t in roots if oracle_roots.evaluate(slope, t) < 0]
        return float(entries[0]) if entries else math.inf


def random_pairs(rng, count, spread):
    for _ in range(count):
        within_reach = min(0.4, spread * spread / A)
        position_b = (0.11 + rng.uniform(0.0, within_reach)) * np.array([1.0, 0.0])
        velocity_a, velocity_b = rng.normal(scale=spread, size=(2, 2))
        yield (0.0, 0.0), tuple(velocity_a), tuple(position_b), tuple(velocity_b)


@pytest.mark.parametrize('spread', [0.01, 0.3, 5.0])
def test_moving_balls_against_exact_roots(spread):
    rng = np.random.default_rng(21)
    hits = skipped = 0
    for pair in random_pairs(rng, 400, spread):
        motion, horizon = relative(*pair, A)
        exact = exact_first_entry(*motion, 0.11, horizon)
        if exact is None:
            skipped += 1
            continue
        found = time_to_moving_ball(motion, 0.11, horizon)
        if math.isinf(exact):
            assert found == math.inf
        else:
            hits += 1
            # A graze amplifies rounding; what counts is the gap at the time found.
            t = found
            gap = (
                math.hypot(
                    motion[0] + t * (motion[2] + 0.5 * t * motion[4]),
                    motion[1] + t * (motion[3] + 0.5 * t * motion[5]),
                )
                - 0.11
            )
            assert abs(gap) < 4e-16
            assert found == pytest.approx(exact, rel=1e-7)
    assert hits > 10 and skipped < 4


def test_moving_balls_equal_twin():
    rng = np.random.default_rng(22)
    hits = 0
    for pair in random_pairs(rng, 300, 1.0):
        motion, horizon = relative(*pair, A)
        found = time_to_moving_ball(motion, 0.11, horizon)
        twin = naive.time_to_moving_ball(*pair, 0.11, A)
        assert found == pytest.approx(twin, rel=1e-9, abs=1e-12)
        hits += math.isfinite(found)
    assert hits > 20


def test_moving_balls_without_friction_by_hand():
    def meet(*motion):
        return time_to_moving_ball(RelativeMotion(*motion, 0.0, 0.0), 0.11, math.inf)

    # 2 m/s towards each other, 0.5 m apart, radii 0.11 together: 0.39 m at 2 m/s.
    assert meet(0.5, 0.0, -2.0, 0.0) == pytest.approx(0.195, rel=1e-15)
    assert meet(0.5, 0.0, 2.0, 0.0) == math.inf
    assert meet(0.5, 0.0, 0.0, 0.0) == math.inf
    # Passing at 0.12 m is a miss, at 0.10 m a hit.
    assert meet(0.5, 0.12, -2.0, 0.0) == math.inf
    chord = math.sqrt(0.11**2 - 0.10**2)
    assert meet(0.5, 0.10, -2.0, 0.0) == pytest.approx((0.5 - chord) / 2.0, rel=1e-14)


@pytest.mark.parametrize('gap', [0.0, -1e-12, -1e-9])
def test_touching_balls_meet_now_if_they_close_and_not_if_they_part(gap):
    closing = RelativeMotion(0.11 + gap, 0.0, -1.0, 0.3, 0.0, 0.0)
    assert time_to_moving_ball(closing, 0.11, 10.0) == 0.0
    assert time_to_moving_ball(closing._replace(wx=1e-4), 0.11, 10.0) == math.inf


@pytest.mark.parametrize('depth', [1e-3, 1e-6, 1e-9, 1e-12])
def test_grazing_balls(depth):
    """A pass `depth` closer than the radii is a hit, one `depth` farther a miss."""
    for across, hits in ((0.11 - depth, True), (0.11 + depth, False)):
        motion = RelativeMotion(0.5, across, -2.0, 0.0, 0.1, 0.0)
        found = time_to_moving_ball(motion, 0.11, 3.0)
        assert math.isfinite(found) == hits
        if hits:
            exact = exact_first_entry(*motion, 0.11, 3.0)
            # Near a graze the gap is flat: its time is known to the root of the rounding.
            slack = 1e-15 / math.sqrt(depth) + 1e-12
            assert exact is None or abs(found - exact) < slack


def test_parabola_never_above_the_squared_gap():
    rng = np.random.default_rng(8)
    for _ in range(500):
        d, w, g = rng.normal(0.0, 0.3, 2), rng.normal(size=2), rng.normal(0.0, 2.0, 2)
        touch, horizon = 0.99 * math.hypot(*d), rng.choice([1e-3, 0.3, 2.0])
        gap, closing, opening = gap_from_below(RelativeMotion(*d, *w, *g), touch, horizon)
        t = np.linspace(0.0, horizon, 300)
        distance = np.hypot(*(d + np.outer(t, w) + 0.5 * np.outer(t * t, g)).T)
        squared_gap = distance**2 - touch**2
        assert gap == pytest.approx(squared_gap[0], rel=1e-12)
        assert np.all(gap - closing * t + 0.5 * opening * t**2 <= squared_gap + 1e-14 * (1 + t**4))


def test_a_gap_of_less_than_rounding_is_none():
    def gap(distance):
        return gap_from_below(RelativeMotion(distance, 0.0, 1.0, 0.0, 0.0, 0.0), 0.11, 1.0)[0]

    assert gap(0.11 + 2e-16) > 0.0
    assert gap(math.nextafter(0.11, 1.0)) == 0.0
    assert gap(0.1) == 0.0


@pytest.mark.parametrize('horizon', [1e-3, 0.3, 2.0, math.inf])
def test_what_is_said_to_stay_apart_never_touches(horizon):
    rng = np.random.default_rng(7)
    times = np.linspace(0.0, min(horizon, 1e3), 2000)[:, np.newaxis]
    said = 0
    for _ in range(500):
        place, velocity = rng.normal(0.0, 0.3, 2), rng.normal(0.0, rng.choice([0.01, 1.0]), 2)
        acceleration = rng.normal(0.0, rng.choice([0.0, 1.0]), 2)
        touch = min(0.1, 0.99 * math.hypot(*place))
        motion = RelativeMotion(*place, *velocity, *acceleration)
        parabola = gap_from_below(motion, touch, horizon)
        if stays_positive(*parabola, horizon):
            said += 1
            path = place + times * velocity + 0.5 * times**2 * acceleration
            assert np.hypot(*path.T).min() > touch
            assert time_to_moving_ball(motion, touch, horizon) == math.inf
    assert said > (0 if horizon == math.inf else 100)


@njit
def later(motion, t):
    return after(motion, t)


def test_later_it_is_where_its_parabola_leads():
    rng = np.random.default_rng(1)
    for _ in range(200):
        place, velocity, acceleration = rng.normal(size=(3, 2))
        t = rng.uniform(0.0, 3.0)
        found = later(RelativeMotion(*place, *velocity, *acceleration), t)
        np.testing.assert_allclose(found[:2], place + velocity * t + acceleration * t**2 / 2)
        np.testing.assert_allclose(found[2:4], velocity + acceleration * t, atol=1e-14)
        assert found[4:] == tuple(acceleration)


def test_two_steps_are_one():
    rng = np.random.default_rng(2)
    for _ in range(200):
        motion = RelativeMotion(*rng.normal(size=6))
        s, t = rng.uniform(0.0, 2.0, 2)
        np.testing.assert_allclose(later(later(motion, s), t), later(motion, s + t), atol=1e-12)


def test_no_time_changes_nothing():
    motion = RelativeMotion(1.0, -2.0, 3.0, -4.0, 5.0, -6.0)
    assert later(motion, 0.0) == motion


def search_line(gap, closing, pressing, lasts, steps=20_001):
    """Return when a gap first turns negative, from a fine search; None where that is not clear."""
    times = np.linspace(0.0, lasts, steps)
    gaps = gap - closing * times - 0.5 * pressing * times**2
    low_points = gaps[1:-1][(gaps[1:-1] <= gaps[:-2]) & (gaps[1:-1] <= gaps[2:])]
    if np.abs(low_points).min(initial=1.0) < 1e-6 or abs(gaps[-1]) < 1e-6:
        return None
    turns = np.flatnonzero((gaps[:-1] >= 0.0) & (gaps[1:] < 0.0))
    if not len(turns):
        return math.inf
    low, high = times[turns[0]], times[turns[0] + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        if gap - closing * middle - 0.5 * pressing * middle**2 < 0.0:
            high = middle
        else:
            low = middle
    return high


def test_the_time_to_a_line_equals_a_fine_search():
    rng = np.random.default_rng(41)
    met = missed = 0
    for _ in range(1000):
        gap, closing = rng.choice([rng.uniform(0.0, 0.5), -0.01, 0.001]), rng.normal()
        pressing, lasts = rng.choice([rng.normal(0.0, 2.0), 0.0]), rng.uniform(0.1, 3.0)
        expected = search_line(gap, closing, pressing, lasts)
        if expected is None:
            continue
        found = time_to_line(gap, closing, pressing, lasts)
        assert found == pytest.approx(expected, rel=1e-9), (gap, closing, pressing, lasts)
        met += found < math.inf
        missed += found == math.inf
    assert met > 300 and missed > 200


@pytest.mark.parametrize(
    ('gap', 'closing', 'pressing', 'lasts', 'expected'),
    [
        # It touches, and closes: now, whatever is to come.
        (0.0, 1.0, 0.0, math.inf, 0.0),
        (0.0, 1e-300, 0.0, math.inf, 0.0),
        (0.0, 1.0, -5.0, 1.0, 0.0),
        (0.0, 1.0, 5.0, 1.0, 0.0),
        (-9e-10, 1.0, 0.0, 1.0, 0.0),
        # It touches, and does not close.
        (0.0, 0.0, 0.0, math.inf, math.inf),
        (0.0, -0.0, -0.0, math.inf, math.inf),
        (0.0, -1.0, 0.0, math.inf, math.inf),
        (0.0, -1.0, -1.0, 5.0, math.inf),
        (-9e-10, -1.0, 0.0, 5.0, math.inf),
        # It moves along, and is pressed: truly, or by rounding.
        (0.0, 0.0, 1.0, 1.0, 0.0),
        (-9e-10, 0.0, 1.0, 1.0, 0.0),
        (0.0, 0.0, 1e-13, 1.0, math.inf),
        (0.0, -1e-17, 2e-16, 3.0, math.inf),
        (0.0, 0.0, 1.0, 1e-7, math.inf),
        # It leaves and comes back, if there is time.
        (0.0, -1.0, 2.0, 1.1, 1.0),
        (0.0, -1.0, 2.0, 1.0, math.inf),
        (0.125, 0.0, 1.0, 0.51, 0.5),
        (0.125, 0.0, 1.0, 0.49, math.inf),
        # Beyond the line it touches nothing, until it has come out.
        (-0.01, 1.0, 0.0, math.inf, math.inf),
        (-0.01, 1.0, 3.0, 10.0, math.inf),
        (-0.01, -1.0, 0.0, math.inf, math.inf),
        (-0.01, -0.01, 3.0, 10.0, math.inf),
        (-0.01, -1.0, 2.0, 10.0, 0.5 + math.sqrt(0.24)),
        (-0.01, -1.0, 2.0, 0.9, math.inf),
        # Not before the end.
        (0.5, 1.0, 0.0, 0.5, math.inf),
        (0.5, 1.0, 0.0, math.inf, 0.5),
        (0.5, 1.0, -2.0, 5.0, math.inf),
        (0.0, 1.0, 0.0, 0.0, math.inf),
        (0.5, 0.0, 0.0, math.inf, math.inf),
    ],
)
def test_the_time_to_a_line_in_nasty_cases(gap, closing, pressing, lasts, expected):
    found = time_to_line(gap, closing, pressing, lasts)
    assert found == pytest.approx(expected, rel=1e-14)
