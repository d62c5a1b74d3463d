"""Garbage, and whatever can be sent, done to one node, which then still plays as printed."""

import json
import struct
import uuid
from functools import cache

import pytest
from fuzzing import garbage_sender
from geometry_msgs.msg import Point, Pose, PoseArray, Quaternion, Twist, Vector3
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from process_harness import node_process
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from ros_harness import Observer, Ros
from std_msgs.msg import String
from survival import DECISIONS, FAST, Attacker, is_served, plays_as_printed

from pool_sim_ros.ros import interface
from pool_sim_ros.simulator import PARAMETERS, parameters_of


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


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
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


@pytest.mark.parametrize('seed', range(3))
def test_garbage_in_place_of_requests_to_services_ends_nothing(victim, seed):
    observer, _ = victim
    sender = garbage_sender(seed)
    while sender.poll() is None:
        is_served(observer)
    assert sender.wait() == 0
    is_served(observer)
    assert observer.call(interface.RESET).success
    assert observer.call(interface.SET_PAUSED, data=False).success


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


@settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
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


@pytest.mark.parametrize('name', sorted(parameters_of('disc')))
@pytest.mark.parametrize(
    'value',
    [float('nan'), float('inf'), -1.0, 0, 2**63 - 1, 'x' * 10_000, '', [], [1.5], True],
    ids=lambda value: repr(value)[:12],
)
def test_no_parameter_value_ends_anything(victim, name, value):
    observer, _ = victim
    ros, node = observer._ros, observer.node
    client = _parameter_client(node)
    ros.spin_until(client.service_is_ready, 'the parameter service')
    spec = PARAMETERS[name]
    for new in (value, spec.default):
        parameter = (
            Parameter(name, value=new)
            if new != []
            else Parameter(name, Parameter.Type.DOUBLE_ARRAY, [])
        )
        request = SetParameters.Request(parameters=[parameter.to_parameter_msg()])
        future = client.call_async(request)
        ros.spin_until(future.done, 'an answer')
        [result] = future.result().results
        assert result.successful or result.reason
    is_served(observer)


@cache
def _parameter_client(node):
    return node.create_client(SetParameters, '/pool_sim/set_parameters')
