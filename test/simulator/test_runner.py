import threading
import time
import weakref
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from fakes import Recorder
from waiting import PATIENCE, wait_until

from pool_sim_ros.simulator import runner as runner_module
from pool_sim_ros.simulator import steps as steps_module
from pool_sim_ros.simulator.job import Job
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.runner import Runner
from pool_sim_ros.simulator.settings import build_settings
from pool_sim_ros.simulator.shot_request import Code, Phase

SETTINGS = replace(
    build_settings(default_values()), report_integrator='event', real_time_factor=100.0
)


@pytest.fixture
def start():
    """Make runners, and stop them in the end."""
    runners = []

    def make(**changes):
        output = Recorder()
        runners.append(Runner(replace(SETTINGS, **changes), output))
        return runners[-1], output

    yield make
    for runner in runners:
        runner.stop(0.0)


@pytest.fixture
def slow_shots(monkeypatch):
    """Hold the computing of every shot until the event is set."""
    go_on = threading.Event()
    run = Job.run

    def wait_and_run(job):
        assert go_on.wait(60.0)
        return run(job)

    monkeypatch.setattr(Job, 'run', wait_and_run)
    yield go_on
    go_on.set()


def wait_for_phase(output, phase):
    wait_until(lambda: phase in [r.phase for r in output.all('response')], phase)
    return next(r for r in output.all('response') if r.phase is phase)


def test_everything_is_sent_in_the_order_that_readers_rely_on(start):
    runner, output = start()
    accepted = runner.request('1')
    done = wait_for_phase(output, Phase.DONE)
    runner.stop(0.0)
    sent = output.sent
    kinds = [kind for kind, _ in sent]
    assert kinds[0] == 'table'

    frames = output.all('frame')
    assert [f.tick for f in frames] == list(range(len(frames)))
    started = next(f for f in frames if f.started)
    finished = next(f for f in frames if f.finished)
    place = {id(item): index for index, (_, item) in enumerate(sent)}
    assert place[id(accepted)] < place[id(started)] < place[id(finished)] < place[id(done)]
    assert done.t_start == pytest.approx(started.stamp * 1e-9)
    states = [(kind, item) for kind, item in sent if kind == 'state']
    moving = [state['moving'] for _, state in states]
    assert moving.count(True) >= 1 and not moving[-1]
    assert place[id(states[-1][1])] > place[id(finished)]


def test_frames_go_on_at_rest_while_a_shot_is_computed(start, slow_shots):
    runner, output = start()
    response = runner.request('{"velocity": [-4, 0]}')
    assert response.phase is Phase.ACCEPTED
    wait_until(lambda: output.all('frame'), 'a frame')
    first = output.all('frame')[-1].tick
    wait_until(lambda: output.all('frame')[-1].tick > first + 50, 'frames while computing')
    frames = output.all('frame')
    assert not any(f.started for f in frames)
    assert all(np.array_equal(f.positions, SETTINGS.table.positions) for f in frames)
    assert output.all('state')[-1]['computing']
    assert runner.request('1').code is Code.BUSY
    slow_shots.set()
    wait_for_phase(output, Phase.DONE)
    assert all(b.tick == a.tick + 1 for a, b in pairwise(output.all('frame')))


def test_a_reset_while_computing_answers_at_once_and_the_result_is_dropped(start, slow_shots):
    runner, output = start()
    runner.request('1')
    assert runner.reset() is True
    assert [r.phase for r in output.all('response')] == [Phase.ACCEPTED, Phase.PREEMPTED]
    second = runner.request('2')
    slow_shots.set()
    done = wait_for_phase(output, Phase.DONE)
    assert done.id == second.id
    assert len(output.all('response')) == 4
    assert runner.reset() is False


def test_of_many_shots_that_were_reset_only_the_last_one_is_computed(start, monkeypatch):
    runs, go_on = [], threading.Event()
    run = Job.run

    def wait_and_run(job):
        runs.append(job)
        assert go_on.wait(PATIENCE)
        return run(job)

    runner, output = start()
    assert runner.ready.wait(PATIENCE)
    monkeypatch.setattr(Job, 'run', wait_and_run)
    runner.request('1')
    wait_until(lambda: runs, 'the first shot')
    jobs = []
    for _ in range(1000):
        runner.reset()
        assert runner.request('{"velocity": [-1, 0]}').phase is Phase.ACCEPTED
        jobs.append(weakref.ref(runner._simulation._shot.job))
    assert sum(job() is not None for job in jobs) == 1
    go_on.set()
    wait_for_phase(output, Phase.DONE)
    assert len(runs) == 2


def test_a_reset_ends_the_computing_of_a_shot_that_would_take_hours(start):
    table = replace(SETTINGS.table, mu_ball_surface=1e-4)
    runner, output = start(
        report_integrator='time_slice', time_slice=1e-7, max_shot_duration=1e5, table=table
    )
    assert runner.ready.wait(PATIENCE)
    for _ in range(3):
        runner.request('1')
        wait_until(lambda: output.all('state')[-1]['computing'], 'the computing')
        runner.reset()
    runner.apply(replace(SETTINGS, table=table))
    runner.request('{"velocity": [0.01, 0]}')
    wait_for_phase(output, Phase.DONE)


def test_a_stop_ends_the_computing_too(start):
    table = replace(SETTINGS.table, mu_ball_surface=1e-4)
    runner, _ = start(
        report_integrator='time_slice', time_slice=1e-7, max_shot_duration=1e5, table=table
    )
    assert runner.ready.wait(PATIENCE)
    runner.request('1')
    assert runner.stop(PATIENCE) is True


def test_others_are_served_while_steps_wait(start, slow_shots):
    runner, output = start(start_paused=True, step_ticks=2)
    assert runner.ready.wait(PATIENCE)
    runner.request('1')
    steps = [runner.step() for _ in range(5)]
    assert runner.request('2').code is Code.BUSY
    assert not any(step.done() for step in steps) and output.all('frame') == []
    slow_shots.set()
    assert [step.result(PATIENCE) for step in steps] == [
        (True, f'at tick {tick}') for tick in (1, 3, 5, 7, 9)
    ]


def test_a_reset_lets_waiting_steps_go_on(start, slow_shots):
    runner, output = start(start_paused=True)
    assert runner.ready.wait(PATIENCE)
    runner.request('1')
    stepped = runner.step()
    runner.reset()
    assert stepped.result(PATIENCE) == (True, 'at tick 0')
    assert not output.all('frame')[0].started


def test_a_stop_answers_the_steps_that_wait(start, slow_shots):
    runner, _ = start(start_paused=True)
    assert runner.ready.wait(PATIENCE)
    runner.request('1')
    stepped = runner.step()
    runner.stop(0.0)
    assert stepped.result(PATIENCE)[0] is False


def test_a_command_that_was_refused_unread_is_counted(start):
    runner, output = start()
    runner.refuse('set_ball_poses: too long')
    wait_until(
        lambda: any(d.values['rejected commands'] == '1' for _, d in output.all('diagnostics')),
        'the count',
    )
    assert output.all('diagnostics')[-1][1].values['last rejection'] == 'set_ball_poses: too long'


def test_as_fast_as_possible_still_answers_in_between(start):
    for_hours = replace(
        SETTINGS.table,
        mu_ball_surface=1e-4,
        mu_ball_ball=0.0,
        mu_ball_cushion=0.0,
        e_cue_ball=1.0,
        e_ball_ball=1.0,
        e_ball_cushion=1.0,
    )
    runner, output = start(real_time_factor=0.0, max_shot_duration=1e5, table=for_hours)
    runner.request('{"velocity": [3, 1]}')
    wait_until(lambda: any(f.velocities.any() for f in output.all('frame')[-1:]), 'motion')
    tick = output.all('frame')[-1].tick
    for _ in range(20):
        assert runner.request('1').code is Code.BUSY
    assert not output.all('frame')[-1].finished
    wait_until(lambda: output.all('frame')[-1].tick > tick + 500, 'many frames')
    assert runner.reset() is True


def test_a_late_output_slips_and_leaves_no_frame_out(start, monkeypatch):
    runner, output = start(real_time_factor=1000.0)
    stall = threading.Event()
    keep = output.frame

    def frame(item):
        if not stall.is_set() and item.tick == 20:
            stall.wait(0.5)
        keep(item)

    monkeypatch.setattr(output, 'frame', frame)
    wait_until(lambda: len(output.all('frame')) > 200, 'frames after the stall')
    assert [f.tick for f in output.all('frame')][:200] == list(range(200))


def test_paused_shows_no_frames_but_takes_a_strike_that_begins_on_resume(start):
    runner, output = start(start_paused=True)
    wait_until(lambda: len(output.all('clock')) >= 2, 'the clock while paused')
    assert output.all('frame') == []
    assert output.all('state')[-1]['paused']
    assert runner.request('1').phase is Phase.ACCEPTED
    wait_until(lambda: not output.all('state')[-1]['computing'], 'the result')
    assert output.all('frame') == [] and set(output.all('clock')) == {0}
    runner.set_paused(False)
    done = wait_for_phase(output, Phase.DONE)
    assert (done.t_start, output.all('frame')[0].started) == (0.0, True)


def test_a_step_waits_for_the_result_and_advances_step_ticks(start, slow_shots):
    runner, output = start(start_paused=True, step_ticks=3)
    assert runner.ready.wait(PATIENCE)
    runner.request('1')
    stepped = runner.step()
    assert not stepped.done()
    slow_shots.set()
    assert stepped.result(PATIENCE) == (True, 'at tick 2')
    assert [f.tick for f in output.all('frame')] == [0, 1, 2]
    assert output.all('frame')[0].started


def test_a_step_gives_up_on_a_result_that_does_not_come(start, slow_shots, monkeypatch):
    monkeypatch.setattr(steps_module, 'STEP_PATIENCE', 0.01)
    runner, output = start(start_paused=True)
    runner.request('1')
    stepped, words = runner.step().result(PATIENCE)
    assert not stepped and 'computed' in words
    assert output.all('frame') == []


def test_a_step_while_playing_is_an_error(start):
    runner, _ = start()
    stepped, words = runner.step().result(PATIENCE)
    assert not stepped and 'set_paused' in words


def test_new_settings_are_announced_and_counted(start):
    runner, output = start()
    table = replace(SETTINGS.table, e_cue_ball=0.9)
    runner.apply(replace(SETTINGS, table=table, real_time_factor=50.0))
    assert output.all('table')[-1] == table
    assert output.all('state')[-1]['real_time_factor'] == 50.0
    tables = len(output.all('table'))
    runner.apply(replace(SETTINGS, table=table, real_time_factor=60.0))
    assert len(output.all('table')) == tables


def test_a_shot_that_fails_is_preempted_and_the_next_one_played(start, monkeypatch):
    runner, output = start()
    with monkeypatch.context() as patch:
        patch.setattr(Job, 'run', lambda job: 1 / 0)
        runner.request('1')
        preempted = wait_for_phase(output, Phase.PREEMPTED)
    assert preempted.code is Code.FAILED and 'division' in preempted.reason
    runner.request('1')
    wait_for_phase(output, Phase.DONE)


def test_kernels_that_cannot_be_compiled_end_the_process_with_the_reason(start, monkeypatch):
    def fail(_):
        raise RuntimeError('no compiler')

    monkeypatch.setattr(runner_module, 'compile_kernels', fail)
    runner, output = start()
    wait_until(lambda: output.all('fail'), 'the failure')
    assert 'no compiler' in output.all('fail')[0] and 'compiled' in output.all('fail')[0]
    assert not runner.ready.is_set()


def test_a_result_that_cannot_be_taken_over_ends_the_process_with_the_reason(start, slow_shots):
    runner, output = start(max_shot_duration=0.01)
    runner.request('1')

    def fail(_):
        raise OSError('no room')

    output.responses = fail
    slow_shots.set()
    wait_until(lambda: output.all('fail'), 'the failure')
    assert 'taken over' in output.all('fail')[0] and 'no room' in output.all('fail')[0]


def test_a_failing_output_is_reported_once_and_ends_the_playback(start, monkeypatch):
    runner, output = start()

    def fail(_):
        raise OSError('no room')

    monkeypatch.setattr(output, 'frame', fail)
    wait_until(lambda: not output.open, 'the failure')
    assert len(output.all('fail')) == 1 and 'no room' in output.all('fail')[0]


def test_a_closed_output_ends_the_playback_without_a_word(start, monkeypatch):
    runner, output = start()
    wait_until(lambda: output.all('frame'), 'a frame')

    def closed(_):
        output.open = False
        raise OSError('closed')

    monkeypatch.setattr(output, 'frame', closed)
    wait_until(lambda: not output.open, 'the end')
    runner.stop(0.0)
    assert output.all('fail') == []


def test_stop_leaves_a_shot_behind_that_cannot_be_interrupted(start, slow_shots):
    runner, output = start()
    assert runner.ready.wait(300.0)
    runner.request('1')
    assert runner.stop(0.0) is False
    sent = len(output.sent)
    slow_shots.set()
    assert runner.stop(60.0) is True
    assert len(output.sent) == sent


def test_it_says_that_it_is_ready_and_what_it_waits_for(start, monkeypatch):
    monkeypatch.setattr(runner_module, 'COMPILE_NOTICE', 0.01)
    go_on = threading.Event()
    monkeypatch.setattr(runner_module, 'compile_kernels', lambda table: go_on.wait(60.0))
    runner, output = start()
    wait_until(lambda: output.all('tell'), 'the notice')
    assert 'compiling' in output.all('tell')[0] and not runner.ready.is_set()
    go_on.set()
    assert runner.ready.wait(60.0)
    assert output.all('tell')[-1] == 'ready'


@pytest.mark.parametrize('real_time_factor', [0.02, 1.0, 15.0, 25.0, 100.0, 1e4])
def test_state_and_diagnostics_go_on_at_any_speed(start, monkeypatch, real_time_factor):
    monkeypatch.setattr(runner_module, 'STATE_PERIOD', 0.01)
    monkeypatch.setattr(runner_module, 'HEALTH_PERIOD', 0.01)
    runner, output = start(real_time_factor=real_time_factor)
    for kind in ('state', 'diagnostics'):
        count = len(output.all(kind))
        wait_until(lambda k=kind, c=count: len(output.all(k)) >= c + 3, kind)


class FakeTime:
    """Time that only sleeping lets pass."""

    now = 0.0

    def monotonic(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds
        time.sleep(1e-5)


def test_while_paused_the_clock_comes_ten_times_a_second(start, monkeypatch):
    fake = FakeTime()
    monkeypatch.setattr(runner_module, 'time', fake)
    runner, output = start(start_paused=True)
    wait_until(lambda: fake.now > 20.0, 'twenty seconds')
    runner.stop(0.0)
    assert len(output.all('clock')) == pytest.approx(10.0 * fake.now, rel=0.02)


@pytest.mark.parametrize('real_time_factor', [0.5, 1.0, 20.0])
def test_no_frame_is_shown_before_it_is_due(start, monkeypatch, real_time_factor):
    due = []

    def shown(pacer):
        due.append(pacer._clock() - pacer._due())
        original(pacer)

    original = runner_module.Pacer.shown
    monkeypatch.setattr(runner_module.Pacer, 'shown', shown)
    runner, output = start(real_time_factor=real_time_factor)
    wait_until(lambda: len(output.all('frame')) >= 20, 'frames')
    runner.stop(0.0)
    assert min(due) >= 0.0


def test_what_is_done_between_frames_takes_its_time_from_the_nap(start, monkeypatch):
    """A sign of life that takes 12 ms of the 17 between two frames delays none."""
    told, excess, nap = threading.Event(), [], runner_module.nap

    def diagnostics(*_):
        time.sleep(12e-3)
        told.set()

    def noted(wait, busy):
        if told.is_set():
            told.clear()
            excess.append(wait - (runner._pacer._due() - time.monotonic()))
        return nap(wait, busy)

    monkeypatch.setattr(runner_module, 'HEALTH_PERIOD', 0.05)
    monkeypatch.setattr(Recorder, 'diagnostics', diagnostics)
    monkeypatch.setattr(runner_module, 'nap', noted)
    runner, _ = start(real_time_factor=1.0)
    wait_until(lambda: len(excess) >= 5, 'naps')
    assert min(excess[1:]) < 4e-3
