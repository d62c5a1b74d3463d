"""Mathavan's model against Euler's method with tiny steps, and against its published figures."""

import math
import re

import naive_spin
import numpy as np
import pytest
from billiards import anchors

from pool_sim_ros.physics.contacts import EdgeLaw, lean_of, meet_edge
from pool_sim_ros.physics.contacts.edge import MATHAVAN
from pool_sim_ros.physics.contacts.mathavan import held_or_slipping, impulses, length_left
from pool_sim_ros.physics.tolerances import CUSHION_STEPS

SNOOKER = dict(radius=0.02625, height=1.4 * 0.02625, e=0.98, f=0.14, mu_slide=0.212)
POOL = dict(radius=0.028575, height=1.28 * 0.028575, e=0.85, f=0.2, mu_slide=0.2)


def bounce(v, w, radius, height, e, f, mu_slide):
    """Velocity (x, y) and spin in the paper's axes: y into the cushion, x along it."""
    law = EdgeLaw(MATHAVAN, e, f, height, mu_slide)
    (v_n, v_t), (w_n, w_t, w_z) = meet_edge(law, (v[1], -v[0]), (w[1], -w[0], w[2]), radius, 0.0)
    return (-v_t, v_n), (-w_t, w_n, w_z)


def shot(speed, angle, radius, rolls=True, side=0.0):
    """A ball at an angle in degrees to the rail; `side` in parts of speed over radius."""
    vx, vy = speed * math.cos(math.radians(angle)), speed * math.sin(math.radians(angle))
    w = (-vy / radius, vx / radius) if rolls else (0.0, 0.0)
    return (vx, vy), (*w, side * speed / radius)


def flat(motion, radius):
    return np.array([*motion[0], *(radius * w for w in motion[1])])


@pytest.mark.parametrize(
    ('name', 'rolls', 'side'),
    [
        ('mathavan2010_stun', False, 0.0),
        ('mathavan2010_rolling', True, 0.0),
        ('mathavan2010_rolling_side', True, 1.0),
    ],
)
def test_published_figures(name, rolls, side):
    ((_, expected),) = anchors()[name]
    speeds, angles = (part.split('/') for part in re.findall(r'[\d.]+(?:/[\d.]+)+', expected))
    for angle, speed_out, angle_out in zip((30, 45, 60, 90), speeds, angles, strict=True):
        (vx, vy), _ = bounce(*shot(1.0, angle, SNOOKER['radius'], rolls, side), **SNOOKER)
        assert math.hypot(vx, vy) == pytest.approx(float(speed_out), abs=1e-4)
        assert math.degrees(math.atan2(-vy, vx)) == pytest.approx(float(angle_out), abs=6e-3)


def test_slow_balls_bounce_as_fast_ones():
    """The map is homogeneous of degree 1; pooltool's is not below 0.1 m/s."""
    motions = []
    for speed in (1e-6, 0.03, 0.1, 1.0):
        v, w = bounce(*shot(speed, 45, POOL['radius']), **POOL)
        assert math.hypot(*v) / speed == pytest.approx(0.772, rel=1e-3)
        assert math.degrees(math.atan2(-v[1], v[0])) == pytest.approx(50.3, rel=1e-3)
        motions.append(flat((v, w), POOL['radius']) / speed)
    for motion in motions:
        np.testing.assert_allclose(motion, motions[-1], rtol=0, atol=1e-13)


def random_case(rng):
    radius = POOL['radius']
    v = (rng.normal(), abs(rng.normal()) + 0.05)
    w = rng.choice([0.0, 1.0, 3.0]) * rng.normal(size=3) / radius
    if rng.random() < 0.3:
        w[:2] = -v[1] / radius, v[0] / radius
    law = dict(
        radius=radius,
        height=rng.uniform(0.8, 1.5) * radius,
        e=rng.uniform(0.5, 1.0),
        f=rng.choice([0.0, 0.14, 0.2, 0.5]),
        mu_slide=rng.choice([0.0, 0.2, 0.5]),
    )
    return v, tuple(w), law


def test_equals_euler_s_method_with_tiny_steps():
    rng = np.random.default_rng(51)
    worst = 0.0
    for _ in range(40):
        v, w, law = random_case(rng)
        twin = flat(naive_spin.rub_along(v, w, **law, steps=20_000), law['radius'])
        found = flat(bounce(v, w, **law), law['radius'])
        scale = np.abs(flat((v, w), law['radius'])).max()
        worst = max(worst, np.abs(found - twin).max() / scale)
    assert worst < 2e-4


def test_the_error_of_the_steps_is_as_small_as_the_documentation_says():
    """Of 300 contacts with pool's coefficients, beside steps that are 20 times as short."""
    rng = np.random.default_rng(52)
    law = EdgeLaw(MATHAVAN, POOL['e'], POOL['f'], POOL['height'], POOL['mu_slide'])
    lean = lean_of(law, POOL['radius'], 0.0)
    coefficients = law.e, law.f, law.mu_slide
    errors = []
    for _ in range(300):
        (vx, vy), w, _ = random_case(rng)
        found, exact = (
            np.array(extrapolated((vx, vy), w, POOL['radius'], lean, coefficients, steps))
            for steps in (CUSHION_STEPS, 20 * CUSHION_STEPS)
        )
        scale = np.abs(flat(((vx, vy), w), POOL['radius'])).max()
        errors.append(np.abs(found - exact).max() / scale)
    assert max(errors) < 5e-4
    assert np.quantile(errors, 0.99) < 5e-5


def extrapolated(v, w, radius, lean, coefficients, steps):
    """The impulses of friction at edge and cloth and the push; the slips by the paper's axes."""
    (vx, vy), (wx, wy, wz), (cosine, sine) = v, w, lean
    over_edge = vx + radius * (wy * sine - wz * cosine), radius * wx - vy * sine
    slips = over_edge, (vx - radius * wy, vy + radius * wx)
    coarse, fine = (np.array(impulses(slips, vy, lean, coefficients, k * steps)) for k in (1, 2))
    return 2 * fine - coarse


def test_friction_holds_or_is_the_most_there_is():
    # A slip of 0.35 m/s that 3.5 times a push ends: 0.1 m/s, so 0.5 for each of a step of 0.2.
    assert held_or_slipping((0.35, 0.0), (3.5, 3.5), 1.0, 0.2) == pytest.approx((-0.5, 0.0))
    assert held_or_slipping((0.3, -0.4), (3.5, 3.5), 0.1, 0.01) == pytest.approx((-0.06, 0.08))
    assert held_or_slipping((0.0, 0.0), (3.5, 3.5), 0.0, 0.2) == (0.0, 0.0)
    assert held_or_slipping((1e-170, 0.0), (3.5, 3.5), 0.0, 1e-172) == (0.0, 0.0)


def test_the_push_that_is_left():
    # Compression ends when v = slowing times push; the rebound when the work is done.
    assert length_left(0.5, 2.0, 0.0, False) == 0.25
    assert length_left(0.5, 0.0, 0.0, False) == math.inf
    left = length_left(-0.5, 2.0, 1.0, True)
    assert 0.5 * left + 2.0 * left**2 / 2 == pytest.approx(1.0)
    assert length_left(0.0, -1.0, 1.0, True) == math.inf


def test_a_contact_ends_even_where_the_edge_cannot_push_back():
    """An edge near the top of the ball, with more friction than the push back: no end by itself."""
    law = dict(radius=0.03, height=1.99 * 0.03, e=0.9, f=5.0, mu_slide=0.0)
    for spin in (-1e4, 0.0, 1e4):
        motion = bounce((0.3, 1.0), (spin, spin, spin), **law)
        assert np.isfinite(flat(motion, 0.03)).all()
