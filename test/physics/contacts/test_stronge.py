"""Stronge's compliant contact: its formulas with many digits, and its springs step by step."""

import math

import naive_spin
import numpy as np
import pytest
from billiards import anchors

from pool_sim_ros.physics.contacts.stronge import (
    FREQUENCY_RATIO,
    compliant_share,
    end_of_sticking,
    gross_slip,
    remaining_slip,
)

BETA = 3.5


def slip_after(slip, closing, e, f):
    return slip * (1.0 - BETA * compliant_share(slip, closing, e, f))


def test_published_values():
    """Both have mu 0.2, e 0.7, a ratio of 1.7, and v_n = -1; slips are positive here."""
    (gross, first), (stick, second) = anchors()['stronge_gross_slip'] + anchors()['stronge_stick']
    assert 'mu 0.2; e 0.7; omega ratio 1.7; v_n -1; v_t -3' == gross
    assert 3.0 > 0.2 * gross_slip(0.7, 1.7)
    assert -slip_after(3.0, 1.0, 0.7, 0.2) == pytest.approx(float(first.split()[1]), abs=1e-12)
    assert 'mu 0.2; e 0.7; omega ratio 1.7; v_n -1; v_t -0.5' == stick
    assert 0.5 < 0.2 * gross_slip(0.7, 1.7)
    found = -0.2 * remaining_slip(0.5 / 0.2, 0.7, 1.7)
    assert found == pytest.approx(float(second.split()[1]), abs=1e-9)


def cases(count, seed=41):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        e = rng.choice([0.0, 1.0, rng.uniform(0.0, 1.0), rng.uniform(0.5, 0.95)])
        f = rng.choice([0.05, 0.2, 1.0])
        closing = rng.choice([0.01, 1.0, 5.0])
        slip = f * closing * rng.choice([rng.uniform(0.0, 1.2), rng.uniform(1.0, 8.0), 1e-6])
        yield slip, closing, e, f


def test_equals_the_formulas_with_many_digits():
    for slip, closing, e, f in cases(120):
        given = naive_spin.exact((slip, closing, e, f))
        twin = float(naive_spin.compliant_slip(*given))
        found = slip_after(slip, closing, e, f)
        # Where sticking begins late it ends soon: there |u| leaves L slowly, and a root is blurred.
        assert found == pytest.approx(twin, abs=2e-12 * (slip + f * closing)), (slip, closing, e, f)


def test_equals_the_springs_step_by_step():
    """Each case, and low restitutions too, where pooltool takes every slip for gross."""
    for e in (0.0001, 0.1, 0.4, 0.55, 0.56, 0.7, 0.9, 1.0):
        for scaled in (0.2, 1.0, 1.2, 2.0, 3.0, 3.45, 3.6, 4.5, 6.0):
            twin = naive_spin.compliant_springs(0.2 * scaled, 1.0, e, 0.2)
            assert slip_after(0.2 * scaled, 1.0, e, 0.2) == pytest.approx(twin, abs=1e-3)


def test_slip_never_grows_even_reversed():
    for slip, closing, e, f in cases(3000, 42):
        assert abs(slip_after(slip, closing, e, f)) <= slip * (1 + 1e-12)


def test_the_cases_meet():
    """No jump where sticking at once, late, or never begins; nor where u changes its side."""
    for e in (0.01, 0.3, 0.5, 1 / FREQUENCY_RATIO, 0.6, 0.8, 1.0):
        eta_squared = BETA / FREQUENCY_RATIO**2
        for edge in (eta_squared, BETA, gross_slip(e, FREQUENCY_RATIO)):
            low, high = (slip_after(edge * (1 + d), 1.0, e, 1.0) for d in (-1e-9, 1e-9))
            assert low == pytest.approx(high, abs=2e-4)  # the rate has a square root there


def test_sticking_ends_where_the_spring_is_too_strong():
    """Spring stuck from the start at 0.5: |u| = L at the angle, and less just before."""
    e, ratio, speed = 0.8, 1.8, 0.5
    angle = end_of_sticking(speed / ratio, 0.0, e, ratio)

    def excess(at):
        t = math.pi / 2 + e * (at - math.pi / 2)
        spring = abs(speed / ratio * math.sin(ratio * t))
        return spring - BETA / ratio**2 * math.sin(at)

    assert math.pi / 2 < angle < math.pi
    assert excess(angle) == pytest.approx(0.0, abs=1e-15)
    grid = np.linspace(math.pi / 2, angle - 1e-6, 1000)
    assert max(excess(at) for at in grid) < 0.0


def test_no_slip_no_closing_no_friction():
    assert compliant_share(0.0, 1.0, 0.85, 0.2) == 2 / 7
    assert compliant_share(1.0, 1.0, 0.85, 0.0) == 0.0
    assert compliant_share(1e9, 1e-300, 0.85, 0.2) < 1e-300
    assert math.isfinite(compliant_share(1e-300, 1.0, 0.85, 0.2) * 1e-300)
