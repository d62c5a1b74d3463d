import math
from dataclasses import replace

import pytest

from pool_sim_ros.me212.shots import (
    SHOT_NUMBERS,
    attitude_to_nearest,
    cue_velocity,
    nearest_ball,
)
from pool_sim_ros.physics import Ball, report_table


def test_cue_velocities_are_those_of_listing_2():
    table = report_table()
    speeds = [math.hypot(*cue_velocity(n, table)) for n in (1, 2, 3, 4)]
    assert speeds == pytest.approx([4.0, 2.5, 1.5, 1.5])
    angles = [math.degrees(math.atan2(*reversed(cue_velocity(n, table)))) for n in (1, 2, 3)]
    assert angles == pytest.approx([180.0, 165.0, 150.0])


def test_shot_4_is_aimed_at_the_nearest_ball_of_the_table():
    table = report_table()
    balls = [*table.balls, Ball('near', 0.1, 0.02, (1.6764, 0.75))]
    x, y = cue_velocity(4, replace(table, balls=balls))
    assert (x, y) == pytest.approx((0.0, 1.5), abs=1e-12)


def test_of_two_balls_at_one_distance_the_first_is_the_nearest():
    table = report_table()
    sides = [Ball(str(dy), 0.1, 0.02, (1.6764, 0.5588 + dy)) for dy in (0.25, -0.25)]
    assert nearest_ball(replace(table, balls=[table.balls[0], *sides])) == 1


@pytest.mark.parametrize('number', [0, 5, '1', None])
def test_there_is_no_other_shot(number):
    with pytest.raises(ValueError, match='shot'):
        cue_velocity(number, report_table())


def test_a_cue_ball_alone_has_no_nearest():
    table = report_table()
    with pytest.raises(ValueError, match='alone'):
        cue_velocity(4, replace(table, balls=table.balls[:1]))


def test_every_shot_of_the_report_has_a_velocity():
    assert [len(cue_velocity(number, report_table())) for number in SHOT_NUMBERS] == [2] * 4


def test_the_attitude_is_the_direction_of_shot_4():
    table = report_table()
    angle = attitude_to_nearest(table)
    x, y = cue_velocity(4, table)
    assert math.atan2(y, x) == pytest.approx(angle, abs=1e-15)
    cue, ball = table.positions[0], table.positions[nearest_ball(table)]
    distance = math.dist(cue, ball)
    reached = cue[0] + distance * math.cos(angle), cue[1] + distance * math.sin(angle)
    assert reached == pytest.approx(tuple(ball), abs=1e-12)
