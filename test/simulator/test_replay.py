"""Record and replay without ROS: the same frames, bit for bit."""

from dataclasses import replace

import numpy as np
import pytest
from fakes import Recorder
from waiting import PATIENCE, wait_until

from pool_sim_ros.ros.digest import digests
from pool_sim_ros.simulator.command_log import CommandLog, LogError
from pool_sim_ros.simulator.log_reader import read_log
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.replay import replay_frames
from pool_sim_ros.simulator.runner import Runner
from pool_sim_ros.simulator.settings import build_settings
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
    assert runner.step().result(PATIENCE)[0]
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
        assert runner.step().result(PATIENCE)[0]

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


def frames_of(*commands, settings=SETTINGS):
    return list(replay_frames(settings, commands))


def test_without_commands_there_is_one_frame():
    [frame] = frames_of()
    assert np.array_equal(frame.positions, SETTINGS.table.positions) and not frame.moving


def test_the_end_is_the_tick_after_the_last_frame():
    assert [frame.tick for frame in frames_of({'tick': 3, 'command': 'end'})] == [0, 1, 2]


def test_a_shot_starts_in_the_tick_of_its_command():
    frames = frames_of({'tick': 5, 'command': 'strike', 'velocity': (1.0, 0.0)})
    assert [frame.tick for frame in frames if frame.started] == [5]
    assert frames[-1].finished and [frame.tick for frame in frames] == list(range(len(frames)))


def test_balls_are_placed_in_the_middle_of_a_shot_as_after_a_reset_in_the_same_tick():
    frames = frames_of(
        {'tick': 0, 'command': 'shot', 'shot': 1},
        {'tick': 20, 'command': 'place', 'positions': ELSEWHERE},
        {'tick': 22, 'command': 'end'},
    )
    assert all(frame.moving for frame in frames[:20])
    assert not any(frame.moving for frame in frames[20:])
    assert np.array_equal(frames[20].positions, ELSEWHERE)


def test_a_strike_above_the_limit_that_counts_at_its_tick_is_refused():
    slow = replace(SETTINGS, max_cue_speed=0.5)
    strike = {'tick': 0, 'command': 'strike', 'velocity': (0.3, 0.1)}
    change = {'tick': 90, 'command': 'set', 'parameters': {'max_cue_speed': 0.2}}
    again = {'tick': 600, 'command': 'strike', 'velocity': (0.2, 0.1)}
    frames = frames_of(strike, again, settings=slow)
    assert [frame.tick for frame in frames if frame.started] == [0, 600]
    with pytest.raises(LogError, match=r'^tick 600, strike: .* max_cue_speed, 0\.2 m/s'):
        frames_of(strike, change, again, settings=slow)


@pytest.mark.parametrize(
    ('commands', 'words'),
    [
        ([{'command': 'shot', 'shot': 5}], ['5']),
        ([{'command': 'place', 'positions': np.ones((1, 2))}], ['11']),
        ([{'command': 'place', 'positions': np.ones((11, 3))}], ['two numbers']),
        ([{'command': 'place', 'positions': np.ones((11, 2))}], ['overlap']),
        ([{'command': 'set', 'parameters': {'publish_rate': 9}}], ['publish_rate', 'start-up']),
        ([{'command': 'shot', 'shot': 1}] * 2, ['moving']),
        ([{'command': 'strike', 'velocity': (1e7, 0.0)}], ['max_cue_speed']),
        (
            [
                {'command': 'set', 'parameters': {'max_shot_duration': 0.5}},
                {'command': 'strike', 'velocity': (4.0, 0.0)},
            ],
            ['max_shot_duration', '0.5'],
        ),
    ],
)
def test_a_command_that_cannot_be_carried_out_is_named_in_one_line(commands, words):
    with pytest.raises(LogError) as error:
        frames_of(*[{'tick': 7, **command} for command in commands])
    assert str(error.value).startswith(f'tick 7, {commands[-1]["command"]}: ')
    assert '\n' not in str(error.value)
    for word in words:
        assert word in str(error.value)
