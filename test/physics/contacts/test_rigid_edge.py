"""The models `han` and `impulse`: by hand, and the directions of their pushes."""

import math

import pytest

from pool_sim_ros.physics.contacts.rigid_edge import (
    lean_of_edge,
    lean_of_push,
    rebound,
    rigid_share,
    slip_at_edge,
)

RADIUS = 0.028575


def test_leans_are_unit_vectors_towards_the_edge():
    for height in (0.51, 0.7, 1.0, 1.28, 1.4, 1.99):
        for cosine, sine in (
            lean_of_edge(RADIUS, height * RADIUS),
            lean_of_push(RADIUS, height * RADIUS, 0.0),
            lean_of_push(RADIUS, height * RADIUS, 0.02),
        ):
            assert math.hypot(cosine, sine) == pytest.approx(1.0, abs=1e-15)
            assert cosine > 0.0 and sine * (height - 1.0) >= 0.0


def test_leans_at_pool_s_height():
    """16.3 and 15.6 degrees at 1.28 radii; flatter at a round nose."""
    angle = math.degrees(math.atan2(*lean_of_edge(RADIUS, 1.28 * RADIUS)[::-1]))
    assert angle == pytest.approx(math.degrees(math.asin(0.28)), abs=1e-12)
    angle = math.degrees(math.atan2(*lean_of_push(RADIUS, 1.28 * RADIUS, 0.0)[::-1]))
    assert angle == pytest.approx(math.degrees(math.atan(0.28)), abs=1e-12)
    angle = math.degrees(math.atan2(*lean_of_push(RADIUS, 1.28 * RADIUS, RADIUS)[::-1]))
    assert angle == pytest.approx(math.degrees(math.atan(0.14)), abs=1e-12)


def test_an_edge_at_the_height_of_the_centre_pushes_level():
    """Then all is as for two balls, one of which does not move: by hand."""
    lean = lean_of_edge(RADIUS, RADIUS)
    assert lean == (1.0, 0.0)
    v, w = (2.0, 1.0), (3.0, 0.0, 0.0)
    slip = slip_at_edge(v, w, RADIUS, lean)
    assert slip == (0.0, 1.0)
    share = rigid_share(1.0, 1.5 * 2.0, 0.1)
    assert share == pytest.approx(2 / 7)
    assert rigid_share(1.0, 1.5 * 2.0, 0.05) == pytest.approx(0.15)
    (v_n, v_t), spin = rebound(v, w, RADIUS, lean, 3.0, (0.0, 0.15))
    assert (v_n, v_t) == pytest.approx((-1.0, 0.85))
    assert spin == pytest.approx((3.0, 0.0, -2.5 * 0.15 / RADIUS))


def test_no_slip_needs_no_direction():
    assert rigid_share(0.0, 1.0, 0.2) == 2 / 7
    assert rigid_share(0.0, 0.0, 0.0) == 2 / 7
    assert rigid_share(1.0, 0.0, 0.2) == 0.0


def test_rolling_on_along_the_edge_slips_by_the_height():
    """A ball that rolls straight in, at 1 m/s: its surface at the edge goes down at 1 + sin."""
    lean = lean_of_edge(RADIUS, 1.28 * RADIUS)
    slip = slip_at_edge((1.0, 0.0), (0.0, 1.0 / RADIUS, 0.0), RADIUS, lean)
    assert slip == pytest.approx((1.28, 0.0), abs=1e-14)
