"""Record and replay without ROS: the same frames, bit for bit."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from fakes import Recorder
from waiting import wait_until

from pool_sim_ros.ros.digest import digests
from pool_sim_ros.simulator.command_log import CommandLog, LogError, read_log
from pool_sim_ros.simulator.replay import replay_frames
from pool_sim_ros.simulator.runner import Runner
from pool_sim_ros.simulator.settings import build_settings, default_values, values_of
from pool_sim_ros.simulator.shot_request import Phase

SETTINGS = replace(
    build_settings(default_values()), report_integrator='event', real_time_factor=1000.0
)
ELSEWHERE = SETTINGS.table.positions * [1.0, 0.98]


def record(path, settings, play):
    """Return the frames of a runner that `play` has driven."""
    output = Recorder()
    runner = Runner(settings, output, CommandLog(str(path), settings))
    try:
        play(runner, output)
    finally:
        runner.stop(60.0)
    return output.all('frame')


def done(output, response):
    wait_until(
        lambda: any(
            r.id == response.id and r.phase is not Phase.ACCEPTED for r in output.all('response')
        ),
        'the end of the shot',
    )


def strike(runner, output, x, y):
    done(output, runner.strike((x, y, 0.0), (0.0, 0.0, 0.0)))


def varied_session(runner, output):
    done(output, runner.request('1'))
    strike(runner, output, -2.0, 0.3)
    runner.apply(replace(SETTINGS, table=replace(SETTINGS.table, e_cue_ball=0.95)))
    runner.apply(replace(SETTINGS, integrator='time_slice', time_slice=1e-5))
    strike(runner, output, 0.1 + 0.2, -1.7)
    assert runner.place(ELSEWHERE) is None
    strike(runner, output, -3.0, -0.7)
    runner.apply(replace(SETTINGS, real_time_factor=1.0))
    runner.request('{"velocity": [-5, 1]}')
    wait_until(lambda: output.all('frame')[-1].velocities.any(), 'motion')
    runner.set_paused(True)
    runner.reset()
    runner.apply(SETTINGS)
    assert runner.place(ELSEWHERE * 1.001) is None
    response = runner.request('3')
    runner.step()
    runner.set_paused(False)
    done(output, response)
    runner.reset()
    seen = len(output.all('frame'))
    wait_until(lambda: len(output.all('frame')) > seen + 10, 'frames after the reset')


def assert_same(played, recorded):
    assert len(played) == len(recorded)
    for one, other in zip(played, recorded, strict=True):
        assert (one.tick, one.stamp) == (other.tick, other.stamp)
        for name in ('positions', 'velocities', 'collisions'):
            assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), one.tick
    assert digests(SETTINGS, iter(played)) == digests(SETTINGS, iter(recorded))


def test_a_session_is_replayed_bit_for_bit(tmp_path):
    log = tmp_path / 'session.log'
    recorded = record(log, SETTINGS, varied_session)
    settings, commands = read_log(log)
    assert settings == SETTINGS
    names = [command['command'] for command in commands]
    assert names == [
        'shot', 'strike', 'set', 'strike', 'place', 'strike', 'set', 'strike', 'place', 'set',
        'shot', 'reset', 'end',
    ]  # fmt: skip
    assert sum(len(frame.collisions) for frame in recorded) > 20
    assert_same(list(replay_frames(settings, commands)), recorded)


def test_what_is_rejected_overtaken_or_too_long_leaves_no_line(tmp_path):
    log = tmp_path / 'session.log'

    def play(runner, output):
        runner.request('9')
        runner.strike((np.nan, 0.0, 0.0), (0.0, 0.0, 0.0))
        runner.place(ELSEWHERE[:3])
        runner.apply(replace(SETTINGS, max_shot_duration=0.01))
        done(output, runner.request('1'))
        runner.apply(SETTINGS)
        strike(runner, output, 1.0, 0.0)

    recorded = record(log, SETTINGS, play)
    settings, commands = read_log(log)
    assert [command['command'] for command in commands] == ['strike', 'end']
    assert_same(list(replay_frames(settings, commands)), recorded)


def test_of_many_resets_in_a_tick_one_line_is_left(tmp_path):
    log = tmp_path / 'session.log'

    def play(runner, output):
        runner.set_paused(True)
        for _ in range(1000):
            runner.reset()
        runner.step()

    record(log, SETTINGS, play)
    assert [command['command'] for command in read_log(log)[1]] == ['reset', 'end']


def test_after_a_kill_the_last_shot_is_played_to_its_end(tmp_path):
    log = tmp_path / 'session.log'
    recorded = record(log, SETTINGS, lambda *args: strike(*args, -4.0, 0.1))
    lines = log.read_text().splitlines(keepends=True)
    log.write_text(''.join(lines[:-1]) + '{"tick": 99999, "comma')
    played = list(replay_frames(*read_log(log)))
    assert_same(played, recorded[: len(played)])
    assert not played[-1].velocities.any()


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
        ([HEADER, {'tick': 7, 'command': 'shot', 'shot': 5}], ['tick 7', '5']),
        ([HEADER, {'tick': 7, 'command': 'place', 'positions': [[1, 1]]}], ['tick 7', '11']),
        ([HEADER, {'tick': 7, 'command': 'set', 'parameters': {'publish_rate': 9}}], ['tick 7']),
        ([HEADER, *[{'tick': 7, 'command': 'shot', 'shot': 1}] * 2], ['tick 7', 'moving']),
    ],
)
def test_a_wrong_line_is_named_in_one_line(tmp_path, lines, words):
    log = tmp_path / 'session.log'
    texts = [line if isinstance(line, str) else json.dumps(line) for line in lines]
    log.write_text(''.join(f'{text}\n' for text in texts))
    with pytest.raises(LogError) as error:
        settings, commands = read_log(log)
        for _ in replay_frames(settings, commands):
            pass
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
