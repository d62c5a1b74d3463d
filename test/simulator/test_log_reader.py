"""Logs of both versions, and what a log of balls that spin may say."""

import json
from pathlib import Path

import numpy as np
import pytest

from pool_sim_ros.physics import report_table
from pool_sim_ros.simulator.command_log import VERSION, LogError
from pool_sim_ros.simulator.log_reader import NEW_IN_2, read_log
from pool_sim_ros.simulator.parameter_table import parameters_of
from pool_sim_ros.simulator.parameter_values import values_from
from pool_sim_ros.simulator.settings import values_of

OLD = Path(__file__).with_name('data') / 'session_97539c6.log'
POOL = {'format': 'pool_sim_ros command log', 'version': VERSION}
TURNED = [[0.6, 0.0, 0.0, 0.8]] * 16
PLACE = {'command': 'place', 'positions': [[1, 2]] * 16}


@pytest.fixture(scope='module')
def head():
    return {**POOL, 'parameters': values_from({'table.preset': '7ft'})}


def write(path, *lines):
    path.write_text(''.join(json.dumps(line) + '\n' for line in lines))
    return path


def test_a_log_of_version_1_has_a_table_of_discs():
    settings, commands = read_log(OLD)
    assert json.loads(OLD.read_text().split('\n')[0])['version'] == 1 and len(commands) > 3
    assert (settings.preset, settings.table.motion) == ('report', 'disc')
    given = json.loads(OLD.read_text().split('\n')[0])['parameters']
    assert values_of(settings) == {**given, **NEW_IN_2}
    assert settings.table.balls == report_table().balls


def test_a_log_of_version_1_must_lack_nothing_else(tmp_path):
    first, *rest = map(json.loads, OLD.read_text().splitlines())
    del first['parameters']['table.gravity']
    with pytest.raises(LogError, match='line 1: parameters must have every parameter'):
        read_log(write(tmp_path / 'x.log', first, *rest))


def test_spins_and_orientations_are_read_back_bit_for_bit(tmp_path, head):
    spin, places = (0.1 + 0.2, -1e-300, 50.0), [[0.1 * k + 0.1, 0.3] for k in range(16)]
    settings, commands = read_log(
        write(
            tmp_path / 'x.log',
            head,
            {'tick': 1, 'command': 'place', 'positions': places, 'orientations': TURNED},
            {'tick': 2, 'command': 'place', 'positions': places},
            {'tick': 3, 'command': 'strike', 'velocity': [1.0, 0.0], 'spin': spin},
            {'tick': 4, 'command': 'strike', 'velocity': [1.0, 0.0]},
        )
    )
    assert set(values_of(settings)) == set(parameters_of('ball'))
    assert np.array_equal(commands[0]['orientations'], TURNED)
    assert 'orientations' not in commands[1] and 'spin' not in commands[3]
    assert commands[2]['spin'] == spin


@pytest.mark.parametrize(
    ('command', 'words'),
    [
        ({'command': 'strike', 'velocity': [1, 0], 'spin': [1, 0]}, 'spin must be 3'),
        ({'command': 'strike', 'velocity': [1, 0], 'spin': [1, 0, float('nan')]}, 'spin must be 3'),
        ({'command': 'strike', 'velocity': [1, 0], 'wind': 1}, 'may have spin'),
        ({'command': 'strike', 'spin': [1, 0, 0]}, 'must have the keys'),
        ({**PLACE, 'orientations': TURNED[:3]}, '16 rows'),
        (
            {'command': 'place', 'positions': [[1, 2]] * 16, 'orientations': [[1, 1, 0, 0]] * 16},
            'unit',
        ),
        ({'command': 'reset', 'spin': [1, 0, 0]}, 'must have the keys'),
    ],
)
def test_a_wrong_command_is_named_with_its_line(tmp_path, head, command, words):
    with pytest.raises(LogError, match=f'line 2: .*{words}') as error:
        read_log(write(tmp_path / 'x.log', head, {'tick': 1, **command}))
    assert '\n' not in str(error.value)


def test_discs_have_no_spin_in_a_log(tmp_path):
    head = {**POOL, 'parameters': values_from({})}
    strike = {'tick': 1, 'command': 'strike', 'velocity': [1, 0], 'spin': [0, 0, 1]}
    with pytest.raises(LogError, match='line 2: strike must have the keys'):
        read_log(write(tmp_path / 'x.log', head, strike))


def test_a_header_must_have_the_parameters_of_its_motion(tmp_path, head):
    for change in ({'table.motion': 'disc'}, {'table.motion': 'x'}, {'table.motion': ['ball']}):
        wrong = {**head, 'parameters': {**head['parameters'], **change}}
        with pytest.raises(LogError, match='line 1: parameters'):
            read_log(write(tmp_path / 'x.log', wrong))
