from fractions import Fraction

import pytest

from pool_sim_ros.physics import solid_sphere


def test_all_follow_from_the_moment_of_inertia():
    """A push J at the surface changes v by J/m and R w by J R^2/I, so the slip by both."""
    inertia = Fraction(2, 5)
    assert solid_sphere.INERTIA == float(inertia)
    assert solid_sphere.SPIN_PER_PUSH == float(1 / inertia)
    assert solid_sphere.NO_SLIP_SHARE == float(1 / (1 + 1 / inertia))


def test_the_inertia_is_that_of_a_ball_filled_evenly():
    """The mean square distance from an axis, over thin shells of cylinders."""
    shells = 2000
    radii = [(k + 0.5) / shells for k in range(shells)]
    weights = [r * (1.0 - r * r) ** 0.5 for r in radii]
    mean = sum(w * r * r for w, r in zip(weights, radii, strict=True)) / sum(weights)
    assert mean == pytest.approx(solid_sphere.INERTIA, rel=1e-4)
