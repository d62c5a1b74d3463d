"""The compiled contact laws against their plain twins."""

import itertools
import math

import naive
import numpy as np
import pytest
from tables import LAWS

from pool_sim_ros.physics.boundary import Rectangle
from pool_sim_ros.physics.contacts import (
    collide_disc_with_cushion,
    collide_discs,
    restitution,
)
from pool_sim_ros.physics.motion import DiscTable

NASTY = (0.0, -0.0, 1e-300, 1e-12, -1e-12, 1.0, -1.0, 1.0 + 2**-52, 100.0)


def table_with(ball_friction, mu=0.05, e_cue_ball=0.7, e_ball_ball=0.9):
    return DiscTable(
        boundary=Rectangle(2.0, 1.0),
        deceleration=1.0,
        mu_ball_ball=mu,
        mu_ball_cushion=0.2,
        e_cue_ball=e_cue_ball,
        e_ball_ball=e_ball_ball,
        e_ball_cushion=0.7,
        coulomb=ball_friction == 'coulomb',
        cue_ball=0,
    )


def compare_ball_collision(velocity_a, velocity_b, normal, mass_a, mass_b, e, mu, law):
    closing = np.dot(np.subtract(velocity_a, velocity_b), normal)
    found = collide_discs(
        table_with(law, mu), velocity_a, velocity_b, normal, (1 / mass_a, 1 / mass_b), e * closing
    )
    twin = naive.collide_balls(velocity_a, velocity_b, normal, mass_a, mass_b, e, mu, law)
    speeds = np.abs([velocity_a, velocity_b]).max()
    ratio = max(mass_a / mass_b, mass_b / mass_a)
    np.testing.assert_allclose(found, twin, rtol=0, atol=1e-14 * (1 + mu) * speeds * ratio + 1e-300)


@pytest.mark.parametrize('law', LAWS)
def test_ball_collision_equals_twin(law):
    rng = np.random.default_rng(11)
    for _ in range(2000):
        angle = rng.uniform(-math.pi, math.pi)
        compare_ball_collision(
            tuple(rng.normal(size=2)),
            tuple(rng.normal(size=2)),
            (math.cos(angle), math.sin(angle)),
            *rng.uniform(0.01, 1.0, 2),
            rng.uniform(0.0, 1.0),
            rng.uniform(0.0, 2.0),
            law,
        )


@pytest.mark.parametrize('law', LAWS)
def test_ball_collision_equals_twin_on_nasty_velocities(law):
    for a_n, a_t, b_n, b_t in itertools.product(NASTY, repeat=4):
        if law == 'report' and 0 < abs(a_t - b_t) <= 1e-9 * abs(a_n - b_n):
            continue  # a head-on hit but for rounding: below
        for normal in ((1.0, 0.0), (0.0, -1.0)):
            nx, ny = normal
            compare_ball_collision(
                (a_n * nx - a_t * ny, a_n * ny + a_t * nx),
                (b_n * nx - b_t * ny, b_n * ny + b_t * nx),
                normal,
                0.2,
                0.16,
                0.9,
                0.05,
                law,
            )


@pytest.mark.parametrize('law', LAWS)
def test_ball_collision_keeps_normal_momentum_and_restitution(law):
    rng = np.random.default_rng(12)
    for _ in range(500):
        angle = rng.uniform(-math.pi, math.pi)
        normal = np.array([math.cos(angle), math.sin(angle)])
        before = rng.normal(size=(2, 2))
        masses, e = rng.uniform(0.01, 1.0, 2), rng.uniform(0.0, 1.0)
        closing = (before[0] - before[1]) @ normal
        after = np.array(
            collide_discs(
                table_with(law),
                tuple(before[0]),
                tuple(before[1]),
                tuple(normal),
                tuple(1 / masses),
                e * closing,
            )
        )
        change = masses @ (after - before)
        assert abs(change @ normal) < 1e-14
        assert (after[1] - after[0]) @ normal == pytest.approx(e * closing, abs=1e-14)
        if law == 'coulomb':
            assert np.abs(change).max() < 1e-14


def test_coulomb_never_turns_the_slip_and_never_feeds_energy():
    rng = np.random.default_rng(13)
    masses = np.array([0.2, 0.16])
    for _ in range(1000):
        before, mu = rng.normal(size=(2, 2)), rng.choice([0.0, 0.05, 0.5, 50.0])
        before[0, 0] = before[1, 0] + abs(rng.normal())
        e = rng.uniform(0.0, 1.0)
        separation = e * (before[0, 0] - before[1, 0])
        after = np.array(
            collide_discs(
                table_with('coulomb', mu),
                tuple(before[0]),
                tuple(before[1]),
                (1.0, 0.0),
                tuple(1 / masses),
                separation,
            )
        )
        slip_before, slip_after = before[0, 1] - before[1, 1], after[0, 1] - after[1, 1]
        assert slip_after * np.sign(slip_before) >= -1e-14
        assert abs(slip_after) <= abs(slip_before) + 1e-14
        energy_before, energy_after = (masses @ np.sum(v * v, axis=1) for v in (before, after))
        assert energy_after <= energy_before * (1 + 1e-14)


def test_report_friction_is_that_of_the_listing():
    # Listing 3, lines 131 and 132: a loses speed along the slip, and so does b, the wrong way.
    a_n, a_t, b_n, b_t = 2.0, 0.5, 0.0, 0.25
    (_, new_a_t), (_, new_b_t) = collide_discs(
        table_with('report', mu=0.05), (a_n, a_t), (b_n, b_t), (1.0, 0.0), (2.0, 2.0), 1.0 * a_n
    )
    assert new_a_t == pytest.approx(0.5 - 0.05 * 2.0, abs=1e-15)
    assert new_b_t == pytest.approx(0.25 - 0.05 * 2.0, abs=1e-15)


@pytest.mark.parametrize('slip', [1e-16, -1e-16, 1e-12, -1e-12])
def test_report_friction_does_not_follow_the_sign_of_a_rounding(slip):
    """A head-on hit has no slip; one of a rounding kicks neither ball sideways."""
    found = collide_discs(
        table_with('report', mu=0.05), (1.0, slip), (0.0, 0.0), (1.0, 0.0), (5.0, 6.25), 0.7
    )
    assert np.abs([found[0][1], found[1][1]]).max() <= abs(slip)


def test_cushion_equals_twin():
    rng = np.random.default_rng(14)
    speeds = [*itertools.product(NASTY, repeat=2), *rng.normal(size=(500, 2))]
    for normal_speed, tangential in speeds:
        found = collide_disc_with_cushion(
            table_with('coulomb'), normal_speed, tangential, 0.7 * abs(normal_speed)
        )
        twin = naive.collide_cushion((normal_speed, tangential), 0, 0.7, 0.2)
        np.testing.assert_allclose(found, twin, rtol=1e-15, atol=1e-300)


def test_cushion_by_hand():
    # Equation 9: 1 m/s becomes -0.7; the other 1 m/s loses 0.2 * 1.7.
    assert collide_disc_with_cushion(table_with('report'), 1.0, 1.0, 0.7) == pytest.approx(
        (-0.7, 0.66)
    )
    assert collide_disc_with_cushion(table_with('report'), 1.0, -0.1, 0.7) == pytest.approx(
        (-0.7, 0.0)
    )


def test_cue_ball_has_its_own_restitution():
    for a_is_cue, b_is_cue in itertools.product((False, True), repeat=2):
        expected = 0.7 if a_is_cue or b_is_cue else 0.9
        assert restitution(table_with('report'), a_is_cue, b_is_cue) == expected
