"""`replay` and a log that anybody may have written: one line and status 1, in time and memory."""

import json
import os

import pytest
from bounded_process import assert_one_line, run_bounded
from thinned import soak

from pool_sim_ros.simulator.command_log import FORMAT, VERSION
from pool_sim_ros.simulator.log_reader import MAX_LINE
from pool_sim_ros.simulator.parameter_table import default_values

VALUES = default_values()
HEADER = {'format': FORMAT, 'version': VERSION, 'parameters': VALUES}


def text_of(*lines):
    texts = [line if isinstance(line, str) else json.dumps(line) for line in lines]
    return ''.join(f'{text}\n' for text in texts)


def strike(x, y, tick=3):
    return {'tick': tick, 'command': 'strike', 'velocity': [x, y]}


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        (text_of(HEADER, {'tick': 10**400, 'command': 'end'}), ['line 2', 'tick']),
        (text_of(HEADER, strike(15.1, 0)), ['tick 3', 'max_cue_speed, 15 m/s']),
        (text_of(HEADER, '{"tick": 1, "command": ' + '[' * 4_000_000), ['line 2', 'deeply']),
        (text_of(HEADER) + ' ' * (3 * MAX_LINE), ['line 2', f'{MAX_LINE} bytes']),
        (text_of(HEADER | {'parameters': VALUES | {'max_cue_speed': True}}), ['max_cue_speed']),
        ('', ['empty']),
        *soak(
            (text_of(HEADER, {'tick': 10**18, 'command': 'end'}), ['line 2', 'tick']),
            (text_of(HEADER, {'tick': 10**9, 'command': 'end'}), ['line 2', 'tick']),
            (text_of(HEADER, strike(10**400, 0)), ['line 2', 'finite']),
            (text_of(HEADER, strike(True, 0)), ['line 2', 'numbers']),
            (text_of(HEADER, '[' + '{},' * 3_000_000 + '{}]'), ['line 2', 'object']),
            (text_of(HEADER, '"' + 'x' * MAX_LINE + '"'), ['line 2', f'{MAX_LINE} bytes']),
        ),
    ],
    ids=range(12),
)
def test_it_is_refused(domain, tmp_path, text, words):
    log = tmp_path / 'session.log'
    log.write_text(text)
    assert_one_line(run_bounded('cli.replay', log, '--digest'), [1], 'replay: ', *words)


def test_what_is_no_file_is_refused(domain, tmp_path):
    os.mkfifo(tmp_path / 'pipe')
    for file in (tmp_path, tmp_path / 'pipe', '/dev/zero'):
        assert_one_line(run_bounded('cli.replay', file), [1], f'replay: {file} cannot be read')


def test_a_log_of_a_recorder_that_was_killed_is_played_as_far_as_it_goes_and_told(domain, tmp_path):
    whole = tmp_path / 'whole.log'
    whole.write_text(text_of(HEADER, strike(-1.0, 0.1)))
    cut = tmp_path / 'cut.log'
    cut.write_text(text_of(HEADER, strike(-1.0, 0.1)) + json.dumps(strike(1.0, 0.0, 900))[:-9])
    first, second = (run_bounded('cli.replay', log, '--digest') for log in (whole, cut))
    assert first.returncode == second.returncode == 0
    assert first.stdout == second.stdout != '' and first.stderr == ''
    assert second.stderr == f'replay: {cut}, line 3 is cut off; what stands before it is played\n'
