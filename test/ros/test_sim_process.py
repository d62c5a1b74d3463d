"""The node as users run it: a process of its own, over real topics."""

import json
import uuid
from itertools import groupby, pairwise
from pathlib import Path

import numpy as np
import pytest
from process_harness import node_process
from ros_harness import Observer, Ros

from pool_sim_ros.me212.log import published_final_positions
from pool_sim_ros.me212.shots import SHOT_NUMBERS, cue_velocity
from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.ros import interface, messages

REPORT_YAML = Path(__file__).resolve().parents[2] / 'config' / 'report.yaml'


class Recording:
    """What was heard while the four report shots were played at real time, one after another."""

    def __init__(self, domain):
        file = str(REPORT_YAML)
        with Ros(domain) as ros, node_process('--ros-args', '--params-file', file, anew=True):
            observer = Observer(ros).wait_for_match()
            self.done = {}
            self.accepted_at = {}
            for number in SHOT_NUMBERS:
                request_id = observer.ask(shot=number)
                observer.wait_for_phase(request_id, 'accepted')
                self.accepted_at[number] = len(observer.stamps)
                self.done[number] = observer.wait_for_phase(request_id, 'done')
                # Frames come on a topic of their own, perhaps after it.
                observer.wait_for_frame_at(self.done[number]['t_end'])
            last = len(observer.stamps)
            ros.spin_until(lambda: len(observer.stamps) > last + 3, 'the frames after the last')
            self.responses = observer.responses
            self.stamps = observer.stamps
            self.positions = [messages.from_poses(m) for m in observer.heard['ball_poses']]
            self.velocities = [messages.from_rows(m) for m in observer.heard['ball_velocities']]
            self.collisions = observer.collisions

    def frame_at(self, time):
        """Return the index of the first frame at or after a sim time in s."""
        return next(i for i, stamp in enumerate(self.stamps) if stamp >= time * 1e9 - 0.5)


@pytest.fixture(scope='module')
def recording(domain):
    return Recording(domain)


@pytest.fixture(scope='module')
def trajectories():
    table = report_table()
    return {
        number: simulate(table, cue_velocity(number, table), integrator='time_slice')
        for number in SHOT_NUMBERS
    }


@pytest.mark.parametrize('number', SHOT_NUMBERS)
def test_a_report_shot_ends_at_the_printed_positions(recording, number):
    done = recording.done[number]
    printed = published_final_positions()[number]
    assert {k: tuple(v) for k, v in done['final_positions_in'].items()} == printed
    assert done['as_printed'] is True and done['integrator'] == 'time_slice'
    frame = recording.positions[recording.frame_at(done['t_end'])]
    assert np.array_equal(frame, list(done['final_positions'].values()))


def test_every_request_is_accepted_once_and_done_once(recording):
    phases = [response['phase'] for response in recording.responses]
    assert phases == ['accepted', 'done'] * 4


def test_stamps_are_exact_and_none_is_missing(recording):
    first = round(recording.stamps[0] * 60 / 1e9)
    ticks = range(first, first + len(recording.stamps))
    assert recording.stamps == [k * 10**9 // 60 for k in ticks]


@pytest.mark.parametrize('number', SHOT_NUMBERS)
def test_frames_show_the_trajectory_at_their_stamps(recording, trajectories, number):
    done, shot = recording.done[number], trajectories[number]
    start = recording.frame_at(done['t_start'])
    end = recording.frame_at(done['t_end'])
    times = [(stamp - recording.stamps[start]) * 1e-9 for stamp in recording.stamps[start:end]]
    assert recording.stamps[start] == pytest.approx(done['t_start'] * 1e9, abs=1.0)
    assert done['t_end'] - done['t_start'] == pytest.approx(shot.duration, abs=1e-9)
    assert np.allclose(recording.positions[start:end], shot.positions(times), rtol=0, atol=1e-12)
    assert np.array_equal(recording.positions[start], report_table().positions)


def test_balls_roll_in_exactly_the_frames_of_each_shot(recording):
    rolling = [bool(velocities.any()) for velocities in recording.velocities]
    runs = [len(list(group)) for rolls, group in groupby(rolling) if rolls]
    assert runs == [
        recording.frame_at(done['t_end']) - recording.frame_at(done['t_start'])
        for done in recording.done.values()
    ]


@pytest.mark.parametrize('number', SHOT_NUMBERS)
def test_frames_at_rest_go_on_between_the_shots(recording, number):
    start = recording.frame_at(recording.done[number]['t_start'])
    waiting = recording.positions[recording.accepted_at[number] : start]
    before = recording.done.get(number - 1)
    resting = list(before['final_positions'].values()) if before else report_table().positions
    assert all(np.array_equal(positions, resting) for positions in waiting)


def test_every_collision_is_told_once_with_its_time(recording, trajectories):
    seqs = recording.collisions[:, 0].tolist()
    assert seqs == list(range(len(seqs)))
    expected = []
    for number in SHOT_NUMBERS:
        contacts = trajectories[number].events
        contacts = contacts[contacts['kind'] != 2]
        rows = np.column_stack([contacts[name] for name in contacts.dtype.names])
        rows[:, 0] += recording.done[number]['t_start']
        expected.append(rows)
    assert np.allclose(recording.collisions[:, 1:], np.concatenate(expected), rtol=0, atol=1e-9)


def test_each_of_a_burst_is_answered_exactly_once(ros):
    with node_process():
        observer = Observer(ros).wait_for_match()
        ids = [uuid.uuid4().hex for _ in range(1000)]
        for request_id in ids:
            observer.request(json.dumps({'id': request_id, 'shot': 3}))
        observer.wait_for_settled(1000)
        decisions = [r for r in observer.responses if r['phase'] in ('accepted', 'rejected')]
        assert sorted(r['id'] for r in decisions) == sorted(ids)
        accepted = [r['id'] for r in decisions if r['phase'] == 'accepted']
        done = [r['id'] for r in observer.responses if r['phase'] == 'done']
        assert accepted and sorted(accepted) == sorted(done)


def test_name_and_namespace_can_be_changed(ros):
    with node_process('--ros-args', '-r', '__node:=left', '-r', '__ns:=/hall') as process:
        observer = Observer(ros, '/hall/left').wait_for_match()
        shot = observer.ask(shot=7)
        assert observer.wait_for_phase(shot, 'rejected')['code'] == 'UNKNOWN_SHOT'
        process.interrupt()
        assert process.wait() == 0


def test_a_reset_frees_the_table_while_a_shot_is_computed(ros):
    with node_process(time_slice='0.0000001'):
        observer = Observer(ros).wait_for_match()
        shot = observer.ask(shot=1)
        observer.wait_for_phase(shot, 'accepted')
        assert observer.call(interface.RESET).success
        assert observer.wait_for_phase(shot, 'preempted')['code'] == 'RESET'
        stamps = observer.stamps
        assert all(b > a for a, b in pairwise(stamps))
