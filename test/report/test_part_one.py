import math
from dataclasses import replace

import numpy as np
import pytest

from pool_sim_ros.physics import Ball
from pool_sim_ros.report.part_one import example


def test_the_example_has_the_table_s_first_two_balls_and_its_coefficients(settings):
    collision = example(settings.table)
    assert (collision.a.label, collision.b.label) == ('C', '1')
    assert (collision.restitution, collision.friction) == (0.7, 0.05)
    assert collision.reach == pytest.approx(2 * 2.25 * 0.0254)


def test_two_balls_that_are_no_cue_ball_have_their_own_restitution(settings):
    balls = [Ball(label, 0.1, 0.05, (0.5 + i, 0.5)) for i, label in enumerate('ab')]
    table = replace(settings.table, balls=balls)
    assert example(table).restitution == table.e_ball_ball == 0.9


def test_one_ball_alone_meets_its_own_like(settings):
    collision = example(replace(settings.table, balls=settings.table.balls[:1]))
    assert collision.a is collision.b


def test_angles_are_those_of_equation_4(settings):
    collision = example(settings.table)
    h = collision.a.radius + collision.b.radius
    assert math.sin(collision.offset_angle) == pytest.approx(collision.offset / h)
    assert math.tan(collision.velocity_angle) == pytest.approx(1.2 / 0.6)
    assert collision.impact_angle == collision.velocity_angle - collision.offset_angle


def test_coulomb_keeps_momentum_and_the_report_s_law_does_not(settings):
    collision = example(settings.table)
    a, b = collision.a.mass, collision.b.mass

    def momentum(law):
        result = collision.collide(law)
        return [
            a * after_a + b * after_b
            for after_a, after_b in zip(result.velocity_a, result.velocity_b, strict=True)
        ]

    before = [a * part for part in collision.velocity]
    assert momentum('coulomb') == pytest.approx(before)
    assert momentum('report') != pytest.approx(before, rel=1e-3)


@pytest.mark.parametrize('velocity', [(1.2, 0.0), (1.2, 0.6), (-0.7, -0.2)])
def test_the_matrix_of_equations_5_and_7_rotates_by_the_angles_that_the_page_has(
    settings, velocity
):
    collision = replace(example(settings.table), velocity=velocity)
    result = collision.collide('coulomb')
    phi = collision.impact_angle - math.pi / 2
    in_frame = rotation(phi) @ velocity
    assert in_frame == pytest.approx((result.normal_before[0], result.tangential_before[0]))
    after = result.normal_after[0], result.tangential_after[0]
    assert rotation(-phi) @ after == pytest.approx(result.velocity_a)
    if velocity[1] == 0.0 < velocity[0]:  # along the x axis the report's own angle is the same
        assert collision.impact_angle - collision.velocity_angle == pytest.approx(phi)


def rotation(phi):
    """Return the matrix R of the report's Equations 5 and 7."""
    return np.array([[math.cos(phi), -math.sin(phi)], [math.sin(phi), math.cos(phi)]])
