from pathlib import Path

import pytest

from pool_sim_ros.me212.log import (
    format_aim,
    format_log,
    format_position,
    format_shot,
    format_shot_head,
    inches,
    published_final_positions,
)
from pool_sim_ros.me212.shots import attitude_to_nearest, cue_velocity, nearest_ball
from pool_sim_ros.physics import report_table, simulate

LOG = Path(__file__).with_name('data') / 'published_output.log'


def test_the_log_of_the_four_shots_is_the_published_one_character_for_character():
    table = report_table()
    shots = []
    for number in (1, 2, 3, 4):
        velocity = cue_velocity(number, table)
        shot = simulate(table, velocity, integrator='time_slice')
        shots.append((number, velocity, list(zip(table.labels, shot.final_positions, strict=True))))
    aim = table.labels[nearest_ball(table)], attitude_to_nearest(table)
    assert format_log(shots, aim) == LOG.read_text()


def test_the_log_is_its_parts_each_with_an_empty_line_after_it():
    shot = (1, (-4.0, 0.0), [('C', (1.0, 0.5))])
    aim, remark = ('1', 3.0), 'not as printed'
    assert format_log([shot], None) == format_shot(*shot) + '\n'
    assert format_log([shot], aim) == format_aim(*aim) + '\n' + format_shot(*shot) + '\n'
    assert format_log([], None, remark) == remark + '\n\n'


def test_a_shot_is_its_head_and_a_line_for_each_ball():
    positions = [('C', (1.0, 0.5)), ('10', (0.0254, 0.254))]
    lines = format_shot(2, (-2.0, 0.5), positions).splitlines()
    assert lines[:2] == format_shot_head(2, (-2.0, 0.5)).splitlines()
    assert lines[2:] == [format_position(*position) for position in positions]
    assert lines[3].split() == ['Ball', '10:', '[', '1.00,', '10.00]', '(in)']


def test_any_other_strike_has_no_number():
    head = format_shot_head(None, (1.0, 0.0))
    assert head == format_shot_head(7, (1.0, 0.0)).replace('Simulation 7', 'Simulation')


def test_published_positions_are_44():
    published = published_final_positions()
    assert [len(published[n]) for n in (1, 2, 3, 4)] == [11] * 4
    assert published[4]['10'] == (19.49, 27.83)


@pytest.mark.parametrize('coordinate', [0.0, 0.3, 1.27, 2.1])
def test_inches_are_the_printed_ones(coordinate):
    assert f'{inches(coordinate):5.2f}' in format_position('C', (coordinate, 0.0))


def test_inches_are_those_of_the_log():
    assert inches(0.0254) == 1.0
    assert inches(1.0) == 39.37
