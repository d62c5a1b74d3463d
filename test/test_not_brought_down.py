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
from geometry_msgs.msg import Point, Pose, PoseArray, Quaternion, Twist, Vector3
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from ros_harness import Observer, Process, Ros, node_process
from std_msgs.msg import String

from pool_sim_ros import interface
from pool_sim_ros.report.log import published_final_positions
from pool_sim_ros.settings import PARAMETERS

FAST = {'real_time_factor': 20.0}
INPUTS = (interface.CUE_VELOCITY, interface.SHOT_REQUEST, interface.SET_BALL_POSES)
DECISIONS = ('accepted', 'rejected')

STALLED_READER = """
import sys
import rclpy
from rclpy.qos import QoSProfile
from pool_sim_ros import interface
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


class Attacker:
    """Publishers on every input of the node."""

    def __init__(self, ros):
        node = ros.node('attacker')
        self._publishers = {
            topic.name: node.create_publisher(topic.type, topic.of('pool_sim'), topic.qos)
            for topic in INPUTS
        }
        ros.spin_until(
            lambda: all(p.get_subscription_count() for p in self._publishers.values()), 'a match'
        )

    def send(self, name, message):
        self._publishers[name].publish(message)

    def send_raw(self, name, data):
        """Return whether the sender's own middleware let these bytes pass."""
        try:
            self._publishers[name].publish(data)
        except Exception as error:
            assert 'cannot publish data' in str(error)
            return False
        return True


def plays_as_printed(observer):
    """Reset, play shot 1 and compare with the print; no answer may come twice."""
    observer.call(interface.SET_PAUSED, data=False)
    observer.call(interface.RESET)
    asked = observer.ask(shot=1)
    done = observer.wait_for_phase(asked, 'done')
    assert {k: tuple(v) for k, v in done['final_positions_in'].items()} == (
        published_final_positions()[1]
    )
    assert observer.phases(asked) == ['accepted', 'done']


def is_served(observer):
    asked = observer.ask(shot=9)
    assert observer.wait_for_phase(asked, 'rejected')['code'] == 'UNKNOWN_SHOT'


@pytest.fixture(scope='module')
def victim(domain):
    """A node that all fuzzing is done to, and who does it."""
    with Ros(domain) as ros, node_process(**FAST):
        observer = Observer(ros).wait_for_match()
        yield observer, Attacker(ros)
        plays_as_printed(observer)


GOOD_BYTES = {
    'cue_velocity': serialize_message(Twist(linear=Vector3(x=-3.0))),
    'shot/request': serialize_message(String(data='{"id": "a", "shot": 9}')),
    'set_ball_poses': serialize_message(PoseArray(poses=[Pose()] * 11)),
}
"""A serialized message for each input."""


@st.composite
def garbage(draw):
    """Bytes that are a message, cut, grown or changed, or no message at all; at least one."""
    name = draw(st.sampled_from(sorted(GOOD_BYTES)))
    good = GOOD_BYTES[name]
    kind = draw(st.sampled_from(['cut', 'grown', 'changed', 'length', 'any']))
    if kind == 'cut':
        return name, good[: draw(st.integers(1, len(good) - 1))]
    if kind == 'grown':
        return name, good + draw(st.binary(min_size=1, max_size=5000))
    if kind == 'changed':
        data = bytearray(good)
        for _ in range(draw(st.integers(1, 8))):
            data[draw(st.integers(0, len(data) - 1))] = draw(st.integers(0, 255))
        return name, bytes(data)
    if kind == 'length':
        lie = struct.pack('<I', draw(st.integers(0, 2**32 - 1)))
        return name, good[:4] + lie + good[8:]
    return name, draw(st.binary(min_size=1, max_size=200))


@settings(
    max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.lists(garbage(), min_size=1, max_size=5))
def test_garbage_under_the_right_type_ends_nothing(victim, messages):
    observer, attacker = victim
    for name, data in messages:
        attacker.send_raw(name, data)
    is_served(observer)
    mark = uuid.uuid4().hex  # what the attacker sends does arrive
    attacker.send('shot/request', String(data=json.dumps({'id': mark, 'shot': 9})))
    observer.wait_for_phase(mark, 'rejected')


@pytest.mark.parametrize('name', sorted(GOOD_BYTES))
@pytest.mark.parametrize('data', [b'', b'\0', b'\0\1\0\0', b'\xff' * 40], ids=repr)
def test_no_message_at_all_ends_nothing(victim, name, data):
    observer, _ = victim
    attacker = Attacker(observer._ros)  # DDS serves one no more that has sent an empty message
    attacker.send_raw(name, data)
    is_served(observer)


FLOATS = st.floats(width=64)
VECTORS = st.builds(Vector3, x=FLOATS, y=FLOATS, z=FLOATS)
POSES = st.builds(
    Pose,
    position=st.builds(Point, x=FLOATS, y=FLOATS, z=FLOATS),
    orientation=st.builds(Quaternion, x=FLOATS, y=FLOATS, z=FLOATS, w=FLOATS),
)
TEXTS = st.text(st.characters(codec='utf-8', exclude_characters='\0'), max_size=50)
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | TEXTS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(
        st.sampled_from(['id', 'shot', 'velocity', 'x']), inner, max_size=4
    ),
)  # fmt: skip
MESSAGES = st.one_of(
    st.tuples(st.just('cue_velocity'), st.builds(Twist, linear=VECTORS, angular=VECTORS)),
    st.tuples(st.just('shot/request'), st.builds(String, data=TEXTS | JSON.map(json.dumps))),
    st.tuples(
        st.just('set_ball_poses'),
        st.builds(PoseArray, poses=st.lists(POSES, max_size=3) | st.lists(
            POSES, min_size=11, max_size=11)),
    ),
)  # fmt: skip


@settings(
    max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.lists(MESSAGES, min_size=1, max_size=5))
def test_any_message_is_answered_and_ends_nothing(victim, messages):
    observer, attacker = victim
    before = sum(response['phase'] in DECISIONS for response in observer.responses)
    asking = 0
    for name, message in messages:
        attacker.send(name, message)
        asking += name != 'set_ball_poses'
    observer._ros.spin_until(
        lambda: sum(r['phase'] in DECISIONS for r in observer.responses) >= before + asking,
        'an answer to each',
    )
    is_served(observer)


@pytest.mark.parametrize('name', sorted(PARAMETERS))
@pytest.mark.parametrize(
    'value', [float('nan'), float('inf'), -1.0, 0, 2**63 - 1, 'x' * 10_000, '', [], [1.5], True],
    ids=lambda value: repr(value)[:12],
)
def test_no_parameter_value_ends_anything(victim, name, value):
    observer, _ = victim
    ros, node = observer._ros, observer.node
    client = _parameter_client(node)
    ros.spin_until(client.service_is_ready, 'the parameter service')
    spec = PARAMETERS[name]
    for new in (value, spec.default):
        parameter = Parameter(name, value=new) if new != [] else Parameter(
            name, Parameter.Type.DOUBLE_ARRAY, [])
        request = SetParameters.Request(parameters=[parameter.to_parameter_msg()])
        future = client.call_async(request)
        ros.spin_until(future.done, 'an answer')
        [result] = future.result().results
        assert result.successful or result.reason
    is_served(observer)


def _parameter_client(node, _made={}):  # noqa: B006 - one client for all
    if node not in _made:
        _made[node] = node.create_client(SetParameters, '/pool_sim/set_parameters')
    return _made[node]


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
                attacker.send('shot/request', String(
                    data=json.dumps({'id': ids[-1], 'shot': random.randint(1, 5)})))
        observer._ros.executor.spin_once(0.0)
    return ids


def survives_a_flood(ros, observer, seconds):
    flood(observer, Attacker(ros), seconds)
    after = Observer(ros).wait_for_match()  # the other one has thousands of answers to look through
    is_served(after)
    after.call(interface.RESET)
    is_served(after)
    assert_answered_once(observer)


def assert_answered_once(observer):
    counts = Counter((r['id'], r['phase'] in DECISIONS) for r in observer.responses)
    assert max(counts.values()) == 1
    accepted = {r['id'] for r in observer.responses if r['phase'] == 'accepted'}
    over = {r['id'] for r in observer.responses if r['phase'] in ('done', 'preempted')}
    assert accepted == over


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


def test_a_reader_that_stops_reading(ros):
    with node_process(**FAST):
        observer = Observer(ros).wait_for_match()
        reader = subprocess.Popen(
            [sys.executable, '-c', STALLED_READER], stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
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
    with node_process(**FAST) as process:
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


def test_killed_and_restarted_while_a_client_waits(domain):
    with node_process() as node, Process('shot', '1', '--timeout', '4') as client:
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


def resident(process):
    pages = int(Path(f'/proc/{process._popen.pid}/statm').read_text().split()[1])
    return pages * os.sysconf('SC_PAGE_SIZE')
