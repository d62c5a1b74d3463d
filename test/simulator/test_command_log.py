"""Writing and reading the command log."""

import json
import os
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from pool_sim_ros.simulator import command_log, log_reader
from pool_sim_ros.simulator.command_log import MAX_TICK, CommandLog, LogError
from pool_sim_ros.simulator.layout import Layout
from pool_sim_ros.simulator.log_reader import MAX_LINE, read_log
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.settings import build_settings, values_of

SETTINGS = build_settings(default_values())


def test_what_is_written_is_read_back_bit_for_bit(tmp_path):
    path = tmp_path / 'x.log'
    positions = SETTINGS.table.positions * [1.0, 0.1 + 0.2]
    velocity = (0.1 + 0.2, -1e-300)
    changed = build_settings({**default_values(), 'table.e_cue_ball': 0.1 + 0.2})
    log = CommandLog(str(path), SETTINGS)
    log.layout(2, Layout(positions))
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


def test_a_last_line_that_was_cut_off_is_left_out_with_a_note(tmp_path):
    path = tmp_path / 'x.log'
    log = CommandLog(str(path), SETTINGS)
    log.layout(4, None)
    log.layout(9, None)
    log.close(10)
    text = path.read_text()
    for length in range(text.rindex('{') + 1, len(text) - 1):
        path.write_text(text[:length])
        notes = []
        assert [command['tick'] for command in read_log(path, notes.append)[1]] == [4, 9]
        assert notes == [f'{path}, line 4 is cut off; what stands before it is played']
    for whole in (text[:-1], text):
        path.write_text(whole)
        notes = []
        assert [command['tick'] for command in read_log(path, notes.append)[1]] == [4, 9, 10]
        assert notes == []


@pytest.mark.parametrize(
    'last',
    [
        '{"tick": 1000000000000000000, "command": "reset"}',
        '{"tick": 9, "command": "jump"}',
        '{"tick": 9, "tick": 9, "command": "reset"}',
        '{"tick": 9, "command": "place", "positions": ' + '[' * 100_000,
        'hello',
        '[]',
    ],
    ids=lambda value: repr(value)[:20],
)
def test_a_wrong_last_line_is_not_taken_for_one_that_was_cut_off(tmp_path, last):
    path = tmp_path / 'x.log'
    CommandLog(str(path), SETTINGS).layout(4, None)
    with path.open('a') as file:
        file.write(last)
    with pytest.raises(LogError, match='line 3: '):
        read_log(path)


def test_a_log_ends_in_time_to_be_read(tmp_path, monkeypatch):
    monkeypatch.setattr(command_log, 'MAX_LOG', 4000)
    words, path = [], tmp_path / 'x.log'
    log = CommandLog(str(path), SETTINGS, words.append)
    for tick in range(100):
        log.layout(tick, None)
    assert path.stat().st_size <= 4000 and len(words) == 1 and '4000 bytes,' in words[0]
    commands = read_log(path)[1]
    assert [command['tick'] for command in commands] == list(range(len(commands))) != []


def test_a_log_of_too_many_lines_ends_and_is_not_read(tmp_path, monkeypatch):
    monkeypatch.setattr(command_log, 'MAX_LINES', 5)
    monkeypatch.setattr(log_reader, 'MAX_LINES', 5)
    words, path = [], tmp_path / 'x.log'
    log = CommandLog(str(path), SETTINGS, words.append)
    for tick in range(9):
        log.layout(tick, None)
    assert len(words) == 1 and '5 lines' in words[0]
    assert [command['tick'] for command in read_log(path)[1]] == [0, 1, 2, 3]
    with path.open('a') as file:
        file.write('{"tick": 9, "command": "end"}\n')
    with pytest.raises(LogError, match='line 6: a log has at most 5 lines'):
        read_log(path)


def test_a_log_ends_before_a_tick_that_is_not_read(tmp_path):
    words, path = [], tmp_path / 'x.log'
    log = CommandLog(str(path), SETTINGS, words.append)
    for tick in (MAX_TICK, MAX_TICK + 1, MAX_TICK + 2):
        log.layout(tick, None)
    assert len(words) == 1 and f'{MAX_TICK} ticks' in words[0]
    assert [command['tick'] for command in read_log(path)[1]] == [MAX_TICK]


@pytest.mark.parametrize(('before', 'end'), [('\ufeff', '\n'), ('', '\r\n')])
def test_marks_and_line_ends_of_other_systems_do_no_harm(tmp_path, before, end):
    path = tmp_path / 'x.log'
    CommandLog(str(path), SETTINGS).close(3)
    path.write_bytes((before + path.read_text().replace('\n', end)).encode())
    assert read_log(path) == (SETTINGS, [{'tick': 3, 'command': 'end'}])


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


VALUES = values_of(SETTINGS)
HEADER = {'format': 'pool_sim_ros command log', 'version': 2, 'parameters': VALUES}


@pytest.mark.parametrize(
    ('lines', 'words'),
    [
        ([], ['line 1']),
        (['hello'], ['line 1', 'JSON']),
        ([{'format': 'other'}], ['line 1', 'command log']),
        ([HEADER | {'version': 3}], ['line 1', 'version']),
        ([HEADER | {'version': 1}], ['line 1', 'version 1']),
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
        ([HEADER | {'version': True}], ['line 1', 'version']),
        ([HEADER | {'version': 1.0}], ['line 1', 'version']),
        ([HEADER, HEADER], ['line 2', 'command']),
        ([HEADER, {'tick': 10**18, 'command': 'reset'}], ['line 2', 'tick', f'{MAX_TICK}']),
        ([HEADER, {'tick': MAX_TICK + 1, 'command': 'end'}], ['line 2', 'tick']),
        ([HEADER, {'tick': 10**400, 'command': 'reset'}], ['line 2', 'tick']),
        ([HEADER, {'tick': True, 'command': 'reset'}], ['line 2', 'tick']),
        ([HEADER, {'tick': '1', 'command': 'reset'}], ['line 2', 'tick']),
        ([HEADER, '{"tick": NaN, "command": "reset"}'], ['line 2', 'tick']),
        ([HEADER, '{"tick": 1, "tick": 2, "command": "reset"}'], ['line 2', '"tick"', 'twice']),
        ([HEADER, {'tick': 1, 'command': ['reset']}], ['line 2', 'command']),
        ([HEADER, {'tick': 1, 'command': 'shot', 'shot': True}], ['line 2', 'whole number']),
        ([HEADER, {'tick': 1, 'command': 'set', 'parameters': []}], ['line 2', 'object']),
        (
            [HEADER, {'tick': 1, 'command': 'set', 'parameters': {'time_slice': True}}],
            ['line 2', 'time_slice'],
        ),
        ([HEADER | {'parameters': VALUES | {'table.length': True}}], ['line 1', 'table.length']),
        ([HEADER | {'parameters': VALUES | {'balls.radii': [True] * 11}}], ['line 1', 'radii']),
        ([HEADER | {'parameters': VALUES | {'start_paused': 1}}], ['line 1', 'start_paused']),
        ([HEADER, {'tick': 1, 'command': 'strike', 'velocity': [True, 0]}], ['numbers']),
        ([HEADER, {'tick': 1, 'command': 'strike', 'velocity': ['1', 0]}], ['numbers']),
        ([HEADER, {'tick': 1, 'command': 'strike', 'velocity': {'x': 1}}], ['numbers']),
        ([HEADER, {'tick': 1, 'command': 'place', 'positions': [[True, 0.5]] * 11}], ['numbers']),
        ([HEADER, {'tick': 1, 'command': 'place', 'positions': [[1, 2, 3]] * 11}], ['numbers']),
        ([HEADER, {'tick': 1, 'command': 'place', 'positions': [[1, 2]] * 10}], ['11 rows']),
        ([HEADER, {'tick': 1, 'command': 'place', 'positions': {}}], ['11 rows']),
        ([HEADER, '{"tick": 1, "command": "place", "positions": ' + '[' * 10**6], ['deeply']),
        ([HEADER, '{"a": ' * 10**6], ['line 2', 'deeply']),
        ([HEADER, ' ' * (MAX_LINE + 1)], ['line 2', f'{MAX_LINE} bytes']),
        ([HEADER, '', {'tick': 1, 'command': 'end'}], ['line 2', 'JSON']),
        ([HEADER, '\0\0\0'], ['line 2', 'JSON']),
        ([{'tick': 1, 'command': 'reset'}, HEADER], ['line 1', 'command log']),
    ],
    ids=lambda value: str(value[-1])[:20] if value else 'none',
)
def test_a_wrong_line_is_named_in_one_line(tmp_path, lines, words):
    log = tmp_path / 'session.log'
    texts = [line if isinstance(line, str) else json.dumps(line) for line in lines]
    log.write_text(''.join(f'{text}\n' for text in texts))
    with pytest.raises(LogError) as error:
        read_log(log)
    assert '\n' not in str(error.value) and len(str(error.value)) < 500
    for word in words:
        assert word in str(error.value)


def test_a_file_that_is_no_log(tmp_path):
    log = tmp_path / 'session.log'
    log.write_bytes(bytes(range(256)))
    with pytest.raises(LogError, match='line 1: .*cannot be read'):
        read_log(log)
    log.write_bytes(json.dumps(HEADER).encode() + b'\n\xff\xfe\n')
    with pytest.raises(LogError, match='line 2: this cannot be read as UTF-8 text'):
        read_log(log)
    log.write_bytes(b'')
    with pytest.raises(LogError, match='line 1: the file is empty'):
        read_log(log)
    log.write_text(json.dumps(HEADER)[:-50])
    with pytest.raises(LogError, match='line 1: '):
        read_log(log)
    os.mkfifo(tmp_path / 'pipe')
    for file in (tmp_path, tmp_path / 'pipe', Path('/dev/zero')):
        with pytest.raises(LogError, match='cannot be read: '):
            read_log(file)
    with pytest.raises(LogError, match='cannot be read'):
        read_log(tmp_path / 'none.log')
    with log.open('wb') as file:
        file.truncate(10**10)
    with pytest.raises(LogError, match='cannot be read: it has 10000000000 bytes'):
        read_log(log)
