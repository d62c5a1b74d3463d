"""The report's table, number by number: its Table 1 and the constants of its listings."""

import math

import pytest

from pool_sim_ros.physics import report_table

INCHES = {
    'C': (66.00, 22.00),
    '1': (40.08, 21.23),
    '2': (17.52, 37.29),
    '3': (12.53, 2.75),
    '4': (10.47, 25.10),
    '5': (27.32, 4.87),
    '6': (16.25, 13.80),
    '7': (7.60, 21.49),
    '8': (10.81, 9.21),
    '9': (26.19, 21.84),
    '10': (19.78, 26.81),
}


def test_balls():
    table = report_table()
    assert table.labels == tuple(INCHES)
    for ball in table.balls:
        assert ball.position == pytest.approx([0.0254 * inch for inch in INCHES[ball.label]])
        assert ball.radius == pytest.approx(2.25 * 0.0254)
        assert ball.mass == pytest.approx(0.2 if ball.label == 'C' else 0.16)
        assert ball.is_cue == (ball.label == 'C')
    assert len({ball.color for ball in table.balls}) == 11
    assert table.balls[0].color == (1.0, 1.0, 1.0) and table.balls[8].color == (0.0, 0.0, 0.0)


def test_the_cloth_and_the_coefficients():
    table = report_table()
    assert (table.length, table.width) == pytest.approx((88 * 0.0254, 44 * 0.0254))
    assert (table.mu_ball_ball, table.mu_ball_surface, table.mu_ball_cushion) == (0.05, 0.1, 0.2)
    assert (table.e_cue_ball, table.e_ball_ball, table.e_ball_cushion) == (0.7, 0.9, 0.7)
    assert table.gravity == 9.80665 and table.ball_friction == 'report'
    assert table.deceleration == pytest.approx(0.980665)


def test_the_nearest_two_balls_have_room():
    table = report_table()
    gaps = [
        math.dist(a.position, b.position) - a.radius - b.radius
        for k, a in enumerate(table.balls)
        for b in table.balls[:k]
    ]
    assert min(gaps) > 0.0


def test_each_call_gives_an_equal_table():
    assert report_table() == report_table()
