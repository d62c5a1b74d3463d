"""Which unknown names are taken for misspelt ones."""

import time

import pytest

from pool_sim_ros.simulator.parameter_names import near_misses
from pool_sim_ros.simulator.parameter_table import PARAMETERS

MISSPELT = {
    'real_time_facter': 'real_time_factor',
    'realtime_factor': 'real_time_factor',
    'real_time_factors': 'real_time_factor',
    'publish_clok': 'publish_clock',
    'publish-clock': 'publish_clock',
    'Publish_Clock': 'publish_clock',
    'publish_rat': 'publish_rate',
    'max_cue_sped': 'max_cue_speed',
    'max_shot_durration': 'max_shot_duration',
    'integrater': 'integrator',
    'report_intergrator': 'report_integrator',
    'timeslice': 'time_slice',
    'time_slise': 'time_slice',
    'step_tick': 'step_ticks',
    'start_pause': 'start_paused',
    'frameid': 'frame_id',
    'recrd': 'record',
    'table.lenght': 'table.length',
    'table.len': 'table.length',
    'table.widht': 'table.width',
    'table.e_cue_bal': 'table.e_cue_ball',
    'table.mu_ball_cloth': 'table.mu_ball_ball',
    'table.ball_frction': 'table.ball_friction',
    'balls.label': 'balls.labels',
    'balls.mass': 'balls.masses',
    'balls.radius': 'balls.radii',
    'balls.colours': 'balls.colors',
    'tabel.length': 'table.length',
    'ball.labels': 'balls.labels',
    'e_cue_ball': 'table.e_cue_ball',
    'ball_friction': 'table.ball_friction',
    'preset': 'table.preset',
    'table.presets': 'table.preset',
    'table.pocket': 'table.pockets',
    'table.mu_slid': 'table.mu_slide',
}

FOREIGN = [
    'use_sim_time',
    'start_type_description_service',
    'qos_overrides./parameter_events.publisher.depth',
    'table.frame',
    'table.frame_id',
    'table.height',
    'table.color',
    'table.legs',
    'balls.count',
    'balls.topic',
    'camera.width',
    'camera.frame_id',
    'robot.max_speed',
    'width',
    'length',
    'rate',
    'max_speed',
    'publish_tf',
    'publish_state',
    'publish_frequency',
    'base_frame_id',
    'map_frame',
    'robot_description',
    'recordings.folder',
    'x',
    '',
]


@pytest.mark.parametrize(('name', 'ours'), MISSPELT.items())
def test_a_misspelt_name_is_told_with_the_right_one(name, ours):
    assert near_misses([name]) == {name: ours}


@pytest.mark.parametrize('name', FOREIGN)
def test_what_belongs_to_others_is_left_alone(name):
    assert near_misses([name]) == {}


def test_our_own_names_are_no_misses():
    assert near_misses(PARAMETERS) == {}


@pytest.mark.parametrize('name', PARAMETERS)
def test_a_character_too_few_is_a_miss_of_that_name(name):
    for index in range(name.rfind('.') + 2, len(name)):
        assert near_misses([name[:index] + name[index + 1 :]]).popitem()[1] == name


def test_thousands_of_names_of_others_take_no_time():
    start = time.monotonic()
    assert near_misses(f'planner_{k}.cost_of_{k}' for k in range(5_000)) == {}
    assert near_misses(['table.' + 'x' * 1_000_000, 'real_time' * 100_000]) == {}
    assert time.monotonic() - start < 10.0
