"""What strangers, crowds and accidents do to the node; after each it still plays as printed.

The long versions run with `python -m pytest -m soak`.
"""

import json
import os
import random
import signal
import struct
import subprocess
import sys
import time
import uuid
from collections import Counter
from pathlib import Path

import pytest
from geometry_msgs.msg import Pose, PoseArray, Quaternion, Twist, Vector3
from process_harness import Process, node_process
from rclpy.serialization import deserialize_message, serialize_message
from ros_harness import Observer, Ros
from std_msgs.msg import String
from survival import (
    DECISIONS,
    FAST,
    Attacker,
    Listener,
    is_served,
    plays_as_printed,
    resident,
)

from pool_sim_ros.ros import interface

STALLED_READER = """
import sys
import rclpy
from rclpy.qos import QoSProfile
from pool_sim_ros.ros import interface
rclpy.init(args=[])
node = rclpy.create_node('stalled')
topics = (interface.BALL_POSES, interface.COLLISIONS, interface.SHOT_RESPONSE, interface.STATE)
readers = [node.create_subscription(t.type, t.of('/pool_sim'), print, t.qos) for t in topics]
while not all(reader.get_publisher_count() for reader in readers):
    rclpy.spin_once(node, timeout_sec=0.1)
sys.stderr.write('matched')
sys.stderr.flush()
sys.stdin.read()
"""


def flood(observer, attacker, seconds, rate=5000):
    """Send so many commands a second; return the ids of those that have one."""
    ids, start, sent = [], time.monotonic(), 0
    while (elapsed := time.monotonic() - start) < seconds:
        while sent < elapsed * rate:
            sent += 1
            if sent % 2:
                attacker.send('cue_velocity', Twist(linear=Vector3(x=random.uniform(-5, 5))))
            else:
                ids.append(uuid.uuid4().hex)
                attacker.send(
                    'shot/request',
                    String(data=json.dumps({'id': ids[-1], 'shot': random.randint(1, 5)})),
                )
        observer._ros.executor.spin_once(0.0)
    return ids


def survives_a_flood(ros, observer, seconds):
    flood(observer, Attacker(ros), seconds)
    after = Observer(ros).wait_for_match()  # the other one has thousands of answers to look through
    is_served(after)
    after.call(interface.RESET)
    is_served(after)
    last = after.ask(shot=9)
    observer.wait_for_phase(last, 'rejected')  # so it has heard all before
    assert_answered_once(observer)


def assert_answered_once(observer):
    counts = Counter((r['id'], r['phase'] in DECISIONS) for r in observer.responses)
    assert max(counts.values()) == 1
    accepted = {r['id'] for r in observer.responses if r['phase'] == 'accepted'}
    over = {r['id'] for r in observer.responses if r['phase'] in ('done', 'preempted')}
    assert accepted == over


@pytest.mark.soak
def test_a_flood_of_commands(ros):
    with node_process(report_integrator='event', **FAST):
        observer = Observer(ros).wait_for_match()
        survives_a_flood(ros, observer, 1.0)


def test_readers_that_come_and_go(ros, domain):
    with node_process(**FAST):
        observer = Observer(ros).wait_for_match()
        asked = observer.ask(shot=1)
        for _ in range(10):
            with Ros(domain) as other:
                Observer(other)
                other.executor.spin_once(0.0)
                ros.executor.spin_once(0.0)
        observer.wait_for_phase(asked, 'done')
        plays_as_printed(observer)


@pytest.mark.soak
def test_a_reader_that_stops_reading(ros):
    with node_process(**FAST):
        observer = Observer(ros).wait_for_match()
        reader = subprocess.Popen(
            [sys.executable, '-c', STALLED_READER],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            assert reader.stderr.read(7) == 'matched'
            reader.send_signal(signal.SIGSTOP)
            seen = len(observer.stamps)
            ros.spin_until(lambda: len(observer.stamps) > seen + 2000, 'frames for the others')
            plays_as_printed(observer)
        finally:
            reader.kill()
            reader.communicate()
        plays_as_printed(observer)


def test_a_second_node_of_the_same_name(ros):
    with node_process(**FAST):
        observer = Observer(ros).wait_for_match()
        with node_process(**FAST):
            both = Observer(ros).wait_for_match()
            asked = both.ask(shot=3)
            ros.spin_until(lambda: both.phases(asked).count('done') >= 1, 'an end')
        ros.spin_until(
            lambda: observer.node.count_publishers('/pool_sim/state') == 1, 'the second to go'
        )
        plays_as_printed(Observer(ros).wait_for_match())


def stop_and_continue(ros, seconds):
    with node_process() as process:  # a frame that is lost on the way can be sent again for 166 ms
        observer = Observer(ros).wait_for_match()
        seen = len(observer.stamps)
        ros.spin_until(lambda: len(observer.stamps) > seen, 'a frame')
        os.kill(process._popen.pid, signal.SIGSTOP)
        ros.spin_until(lambda: stopped(process), 'the stop')
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            ros.executor.spin_once(0.1)
        seen = len(observer.stamps)
        os.kill(process._popen.pid, signal.SIGCONT)
        ros.spin_until(lambda: len(observer.stamps) > seen + 60, 'frames afterwards')
        ticks = [round(stamp * 60e-9) for stamp in observer.stamps]
        assert ticks == list(range(ticks[0], ticks[0] + len(ticks)))
        plays_as_printed(observer)


def stopped(process):
    status = Path(f'/proc/{process._popen.pid}/stat').read_text()
    return status.rsplit(')', 1)[1].split()[0] == 'T'


def test_stopped_and_continued(ros):
    stop_and_continue(ros, 1.0)


def peak(process):
    """Return the most memory that a process has had, in bytes."""
    status = Path(f'/proc/{process._popen.pid}/status').read_text()
    return 1024 * int(status.partition('VmHWM:')[2].split()[0])


def layout_of(poses):
    """Return the bytes of a layout of so many poses, without making them."""
    one = serialize_message(PoseArray(poses=[Pose()]))
    assert one[-64:-60] == struct.pack('<I', 1)  # how many; then a gap before the first
    return one[:-64] + struct.pack('<II', poses, 0) + bytes(56 * poses)


def test_a_layout_of_a_million_poses_is_refused_undecoded_in_a_line(ros):
    assert (
        deserialize_message(layout_of(3), PoseArray).poses
        == [Pose(orientation=Quaternion(w=0.0))] * 3
    )
    with node_process(**FAST) as process:
        observer, attacker = Listener(ros).wait_for_match(), Attacker(ros)
        before, data = peak(process), layout_of(1_000_000)
        attacker.send_raw('set_ball_poses', data)
        process.wait_for('set_ball_poses was rejected: 1000000 positions; the table has 11 balls')
        is_served(observer)
        assert process.stderr.count('1000000 positions') == 1
        assert peak(process) - before < 5 * len(data)  # the middleware has it three times
        plays_as_printed(observer)


def test_a_request_of_a_million_characters_many_times_is_refused_each_time(ros):
    with node_process(**FAST) as process:
        observer, attacker = Listener(ros).wait_for_match(), Attacker(ros)
        before = peak(process)
        for _ in range(20):
            attacker.send('shot/request', String(data='[' * 1_000_000))
        observer._ros.spin_until(lambda: len(observer.responses) >= 20, 'the refusals')
        assert {(r['code'], r['id']) for r in observer.responses} == {('BAD_REQUEST', None)}
        assert peak(process) - before < 100 * 2**20
        plays_as_printed(observer)


def test_shots_that_were_reset_take_neither_memory_nor_time(ros):
    slow = {'integrator': 'time_slice', 'time_slice': 1e-7, 'table.mu_ball_surface': 1e-4}
    with node_process(max_shot_duration=1e5, **slow, **FAST) as process:
        observer, attacker = Listener(ros).wait_for_match(), Attacker(ros)
        before, end = resident(process), time.monotonic() + 3.0
        while time.monotonic() < end:
            attacker.send('cue_velocity', Twist(linear=Vector3(x=-4.0)))
            observer.call(interface.RESET)
        observer.responses.clear()
        asked = time.monotonic()
        shot = observer.ask(velocity=[0.001, 0.0])  # 10^7 slices
        observer.wait_for_phase(shot, 'done')
        assert time.monotonic() - asked < 10.0  # one of those before would take hours
        assert resident(process) - before < 30 * 2**20


def test_killed_and_restarted_while_a_client_waits(domain):
    with node_process() as node, Process('cli.shot', '1', '--timeout', '30') as client:
        client.wait_for('accepted')
        node.signal(signal.SIGKILL)
        node.wait()
        with node_process() as fresh, Ros(domain) as ros:
            client._forget()
            assert client.wait() == 1
            assert client.stderr.count('\n') == 1 and 'Traceback' not in client.stderr
            assert 'restarted' in client.stderr or 'silent' in client.stderr
            assert 'C:' not in client.stdout
            observer = Observer(ros).wait_for_match()
            assert [r['phase'] for r in observer.responses] == []
            plays_as_printed(observer)
            assert fresh.stderr.count('Traceback') == 0


@pytest.mark.soak
def test_soak_half_a_minute_of_5000_commands_a_second(ros):
    with node_process(report_integrator='event', **FAST):
        observer = Observer(ros).wait_for_match()
        survives_a_flood(ros, observer, 30.0)


@pytest.mark.soak
def test_soak_fifty_readers_come_and_go(ros, domain):
    with node_process(**FAST):
        observer = Observer(ros).wait_for_match()
        for _ in range(50):
            with Ros(domain) as other:
                Observer(other).wait_for_match()
        plays_as_printed(observer)


@pytest.mark.soak
def test_soak_stopped_for_five_seconds(ros):
    stop_and_continue(ros, 5.0)


@pytest.mark.soak
def test_soak_an_hour_of_sim_time_takes_no_more_memory(ros, capsys):
    with node_process(report_integrator='event', real_time_factor=0.0) as process:
        observer = HourObserver(ros).wait_for_match()
        sizes, played = [], 0
        while not sizes or observer.state['sim_time'] < 3600.0:
            done = observer.wait_for_phase(observer.ask(shot=1 + played % 4), 'done')
            played += 1
            if done['t_end'] > 360.0 * (len(sizes) + 1):
                sizes.append(resident(process))
            observer.responses.clear()
            for heard in observer.heard.values():
                del heard[:-1]
        with capsys.disabled():
            print(f'\n{played} shots; MiB each tenth: {[round(s / 2**20, 1) for s in sizes]}')
        assert sizes[-1] - sizes[1] < 2**20 * 5
        plays_as_printed_by_event = observer.ask(shot=1)
        observer.wait_for_phase(plays_as_printed_by_event, 'done')


class HourObserver(Observer):
    TOPICS = (interface.SHOT_RESPONSE, interface.STATE, interface.TABLE)
