"""Writing and reading the command log."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

from pool_sim_ros.simulator.command_log import CommandLog, LogError, read_log
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.settings import build_settings, values_of

SETTINGS = build_settings(default_values())


def test_what_is_written_is_read_back_bit_for_bit(tmp_path):
    path = tmp_path / 'x.log'
    positions = SETTINGS.table.positions * [1.0, 0.1 + 0.2]
    velocity = (0.1 + 0.2, -1e-300)
    changed = build_settings({**default_values(), 'table.e_cue_ball': 0.1 + 0.2})
    log = CommandLog(str(path), SETTINGS)
    log.layout(2, positions)
    log.strike(2, SETTINGS, None, velocity)
    log.layout(5, None)
    log.strike(7, changed, 3, (-1.0, 0.5))
    log.strike(9, changed, None, velocity)
    log.close(11)
    settings, commands = read_log(path)
    assert settings == SETTINGS
    place = commands.pop(0)
    assert np.array_equal(place.pop('positions'), positions)
    assert place == {'tick': 2, 'command': 'place'}
    assert commands == [
        {'tick': 2, 'command': 'strike', 'velocity': velocity},
        {'tick': 5, 'command': 'reset'},
        {'tick': 7, 'command': 'set', 'parameters': {'table.e_cue_ball': 0.1 + 0.2}},
        {'tick': 7, 'command': 'shot', 'shot': 3},
        {'tick': 9, 'command': 'strike', 'velocity': velocity},
        {'tick': 11, 'command': 'end'},
    ]


def test_each_line_is_in_the_file_at_once(tmp_path):
    path = tmp_path / 'x.log'
    log = CommandLog(str(path), SETTINGS)
    log.layout(4, None)
    assert read_log(path)[1] == [{'tick': 4, 'command': 'reset'}]
    log.close(5)


def test_a_line_that_was_cut_off_is_left_out(tmp_path):
    path = tmp_path / 'x.log'
    log = CommandLog(str(path), SETTINGS)
    log.layout(4, None)
    log.layout(9, None)
    log.close(10)
    path.write_text(path.read_text()[:-25])
    assert [command['tick'] for command in read_log(path)[1]] == [4, 9]


def test_a_log_is_not_overwritten(tmp_path):
    log = tmp_path / 'session.log'
    log.write_text('precious')
    with pytest.raises(LogError, match='exists'):
        CommandLog(str(log), SETTINGS)
    assert log.read_text() == 'precious'


@pytest.mark.parametrize('name', ['no/such/folder/x.log', 'nul\0byte'])
def test_a_log_that_cannot_be_made(tmp_path, name):
    with pytest.raises(LogError, match='cannot be written'):
        CommandLog(str(tmp_path / name), SETTINGS)


def test_a_full_disk_ends_the_log_with_words_and_not_the_session(tmp_path, monkeypatch):
    words = []
    path = tmp_path / 'x.log'
    log = CommandLog(str(path), SETTINGS, words.append)

    def write(_):
        raise OSError(28, 'No space left on device')

    monkeypatch.setattr(log, '_file', SimpleNamespace(write=write))
    for tick in range(3):
        log.layout(tick, None)
    log.close(3)
    assert len(words) == 1 and 'No space left' in words[0] and 'x.log' in words[0]


HEADER = {'format': 'pool_sim_ros command log', 'version': 1, 'parameters': values_of(SETTINGS)}


@pytest.mark.parametrize(
    ('lines', 'words'),
    [
        ([], ['line 1']),
        (['hello'], ['line 1', 'JSON']),
        ([{'format': 'other'}], ['line 1', 'command log']),
        ([HEADER | {'version': 2}], ['line 1', 'version']),
        ([HEADER | {'parameters': {}}], ['line 1', 'parameters']),
        ([HEADER, '[]'], ['line 2', 'object']),
        ([HEADER, {'tick': 1, 'command': 'jump'}], ['line 2', 'command']),
        ([HEADER, {'tick': -1, 'command': 'reset'}], ['line 2', 'tick']),
        ([HEADER, {'tick': 1.5, 'command': 'reset'}], ['line 2', 'tick']),
        ([HEADER, {'tick': 5, 'command': 'reset'}, {'tick': 4, 'command': 'reset'}], ['line 3']),
        ([HEADER, {'tick': 1, 'command': 'end'}, {'tick': 4, 'command': 'reset'}], ['line 3']),
        ([HEADER, {'tick': 1, 'command': 'shot'}], ['line 2', 'keys']),
        ([HEADER, {'tick': 1, 'command': 'strike', 'velocity': [1]}], ['line 2', 'velocity']),
        ([HEADER, {'tick': 1, 'command': 'strike', 'velocity': 'x'}], ['line 2', 'numbers']),
        ([HEADER, '{"tick": 1, "command": "strike", "velocity": [NaN, 1]}'], ['line 2', 'finite']),
        ([HEADER, {'tick': 1, 'command': 'set', 'parameters': {'speed': 1}}], ['line 2', 'speed']),
        ([HEADER, {'tick': 1, 'command': 'set', 'parameters': {'step_ticks': 0}}], ['step_ticks']),
        ([HEADER, {'tick': 1, 'command': 'shot', 'shot': '1'}], ['line 2', 'whole number']),
        ([HEADER, {'tick': 1, 'command': 'shot', 'shot': [1]}], ['line 2', 'whole number']),
        (
            [HEADER, {'tick': 1, 'command': 'strike', 'velocity': [10**400, 1]}],
            ['line 2', 'finite'],
        ),
        (
            [HEADER, {'tick': 1, 'command': 'set', 'parameters': {'max_cue_speed': 10**400}}],
            ['line 2', 'max_cue_speed'],
        ),
    ],
)
def test_a_wrong_line_is_named_in_one_line(tmp_path, lines, words):
    log = tmp_path / 'session.log'
    texts = [line if isinstance(line, str) else json.dumps(line) for line in lines]
    log.write_text(''.join(f'{text}\n' for text in texts))
    with pytest.raises(LogError) as error:
        read_log(log)
    assert '\n' not in str(error.value)
    for word in words:
        assert word in str(error.value)


def test_a_file_that_is_no_text(tmp_path):
    log = tmp_path / 'session.log'
    log.write_bytes(bytes(range(256)))
    with pytest.raises(LogError, match='cannot be read'):
        read_log(log)
    with pytest.raises(LogError, match='cannot be read'):
        read_log(tmp_path / 'none.log')
