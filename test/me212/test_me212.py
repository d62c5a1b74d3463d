import math
from dataclasses import replace
from pathlib import Path

import pytest

from pool_sim_ros.me212.log import format_aim, format_shot, inches, published_final_positions
from pool_sim_ros.me212.shots import attitude_to_nearest, cue_velocity, nearest_ball
from pool_sim_ros.physics import Ball, report_table, simulate

LOG = Path(__file__).with_name('data') / 'published_output.log'


def test_the_log_of_the_four_shots_is_the_published_one_character_for_character():
    table = report_table()
    text = format_aim(table.labels[nearest_ball(table)], attitude_to_nearest(table)) + '\n'
    for number in (1, 2, 3, 4):
        velocity = cue_velocity(number, table)
        shot = simulate(table, velocity, integrator='time_slice')
        text += format_shot(number, velocity, zip(table.labels, shot.final_positions, strict=True))
        text += '\n'
    assert text == LOG.read_text()


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


def test_published_positions_are_44():
    published = published_final_positions()
    assert [len(published[n]) for n in (1, 2, 3, 4)] == [11] * 4
    assert published[4]['10'] == (19.49, 27.83)


def test_inches_are_those_of_the_log():
    assert inches(0.0254) == 1.0
    assert inches(1.0) == 39.37
