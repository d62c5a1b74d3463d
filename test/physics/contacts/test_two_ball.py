"""Part 1 of the report: two balls that meet at an offset."""

import math

import naive
import numpy as np
import pytest
from tables import LAWS

from pool_sim_ros.physics import Ball, Table, simulate, two_ball_collision

GIVEN = dict(
    mass_a=0.2,
    mass_b=0.16,
    velocity_a=(1.0, 0.5),
    velocity_b=(-0.3, 0.2),
    radius_a=0.05,
    radius_b=0.03,
    offset=0.02,
    restitution=0.9,
    friction=0.05,
)


def random_given(rng):
    radii = rng.uniform(0.01, 0.1, 2)
    return dict(
        mass_a=rng.uniform(0.05, 2.0),
        mass_b=rng.uniform(0.05, 2.0),
        velocity_a=rng.normal(0.0, 2.0, 2),
        velocity_b=rng.normal(0.0, 2.0, 2),
        radius_a=radii[0],
        radius_b=radii[1],
        offset=rng.uniform(-0.99, 0.99) * radii.sum(),
        restitution=rng.uniform(0.0, 1.0),
        friction=rng.choice([0.0, 0.05, 0.3, 5.0]),
    )


def place_at_impact(given):
    """Centres of a and b when they touch, from the construction lines of Figure 2."""
    relative = np.subtract(given['velocity_a'], given['velocity_b'])
    along = relative / np.linalg.norm(relative)
    left = np.array([-along[1], along[0]])
    reach = given['radius_a'] + given['radius_b']
    ahead = math.sqrt(reach**2 - given['offset'] ** 2)
    return np.zeros(2), along * ahead + left * given['offset']


@pytest.mark.parametrize('law', LAWS)
def test_equals_the_engine_on_a_table_without_surface_friction(law):
    rng = np.random.default_rng(3)
    for _ in range(100):
        given = random_given(rng)
        a, b = place_at_impact(given)
        back = 0.02 / np.linalg.norm(np.subtract(given['velocity_a'], given['velocity_b']))
        centre = np.array([1.0, 1.0])
        balls = [
            Ball('a', given['mass_a'], given['radius_a'], centre + a - back * given['velocity_a']),
            Ball('b', given['mass_b'], given['radius_b'], centre + b - back * given['velocity_b']),
        ]
        table = Table(
            2.0,
            2.0,
            balls,
            mu_ball_ball=given['friction'],
            mu_ball_surface=0.0,
            e_ball_ball=given['restitution'],
            ball_friction=law,
        )
        velocities = [given['velocity_a'], given['velocity_b']]
        shot = simulate(table, velocities, until=2.0 * back)
        assert len(shot.events) == 1
        found = two_ball_collision(**given, ball_friction=law)
        staged = np.array([found.velocity_a, found.velocity_b])
        np.testing.assert_allclose(shot.final_velocities, staged, rtol=0, atol=1e-12)


@pytest.mark.parametrize('law', LAWS)
def test_equals_the_plain_twin(law):
    rng = np.random.default_rng(4)
    for _ in range(100):
        given = random_given(rng)
        a, b = place_at_impact(given)
        normal = (b - a) / np.linalg.norm(b - a)
        found = two_ball_collision(**given, ball_friction=law)
        va, vb = naive.collide_balls(
            given['velocity_a'],
            given['velocity_b'],
            normal,
            given['mass_a'],
            given['mass_b'],
            given['restitution'],
            given['friction'],
            law,
        )
        np.testing.assert_allclose([found.velocity_a, found.velocity_b], [va, vb], atol=1e-12)
        assert (math.cos(found.impact_angle), math.sin(found.impact_angle)) == pytest.approx(
            tuple(normal), abs=1e-12
        )


def test_the_report_s_equations_hold():
    """Equations 1 and 2 along the normal, Equation 6 along the tangent where it is not capped."""
    found = two_ball_collision(**GIVEN)
    (na, nb), (na2, nb2) = found.normal_before, found.normal_after
    (ta, tb), (ta2, tb2) = found.tangential_before, found.tangential_after
    assert 0.2 * na2 + 0.16 * nb2 == pytest.approx(0.2 * na + 0.16 * nb, abs=1e-14)
    assert na2 - nb2 == pytest.approx(0.9 * (nb - na), abs=1e-14)
    assert abs(ta2 - ta) == pytest.approx(0.05 * abs(na2 - na), abs=1e-14)
    assert 0.2 * ta2 + 0.16 * tb2 == pytest.approx(0.2 * ta + 0.16 * tb, abs=1e-14)
    assert abs(ta2 - tb2) < abs(ta - tb)


def test_head_on_between_equal_balls_exchanges_the_velocities():
    given = dict(GIVEN, mass_b=0.2, velocity_b=(0.0, 0.0), offset=0.0, restitution=1.0)
    found = two_ball_collision(**given)
    np.testing.assert_allclose(found.velocity_a, (0.0, 0.0), atol=1e-15)
    np.testing.assert_allclose(found.velocity_b, (1.0, 0.5), atol=1e-15)


def test_a_positive_offset_puts_b_on_the_left():
    """Equation 4: the impact line is turned by asin(e / h) from the velocity."""
    given = dict(GIVEN, velocity_a=(2.0, 0.0), velocity_b=(0.0, 0.0), offset=0.04)
    assert two_ball_collision(**given).impact_angle == pytest.approx(math.asin(0.04 / 0.08))
    assert two_ball_collision(**given).velocity_b[1] > 0.0


def test_the_mirror_image_collides_alike():
    mirrored = dict(GIVEN, velocity_a=(1.0, -0.5), velocity_b=(-0.3, -0.2), offset=-0.02)
    for law in LAWS:
        one = two_ball_collision(**GIVEN, ball_friction=law)
        other = two_ball_collision(**mirrored, ball_friction=law)
        np.testing.assert_allclose(other.velocity_a, one.velocity_a * (1, -1), atol=1e-14)
        np.testing.assert_allclose(other.velocity_b, one.velocity_b * (1, -1), atol=1e-14)


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('mass_a', 0.0),
        ('mass_b', -1.0),
        ('radius_a', 0.0),
        ('radius_b', math.nan),
        ('velocity_a', (1.0, math.inf)),
        ('velocity_b', (1.0,)),
        ('velocity_a', (-0.3, 0.2)),
        ('offset', 0.08),
        ('offset', -0.1),
        ('restitution', 1.1),
        ('friction', -0.1),
        ('ball_friction', 'none'),
    ],
)
def test_bad_input_is_named(name, value):
    with pytest.raises(ValueError, match=f'^{name}: '):
        two_ball_collision(**{**GIVEN, name: value})
