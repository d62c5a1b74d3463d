"""Commands as bytes: what is too long is not decoded, what is no message is refused."""

import pytest
from geometry_msgs.msg import Pose, PoseArray, Twist, Vector3
from rclpy.serialization import serialize_message
from std_msgs.msg import Header, String

from pool_sim_ros.ros import commands
from pool_sim_ros.simulator import MAX_REQUEST_LENGTH


@pytest.fixture
def read():
    """Return what becomes of bytes: ('taken', message) or ('refused', reason)."""

    def read(kind, most, data):
        heard = []
        commands.reader(
            kind,
            most,
            lambda message: heard.append(('taken', message)),
            lambda reason: heard.append(('refused', reason)),
        )(data)
        [outcome] = heard
        return outcome

    return read


@pytest.mark.parametrize(
    ('message', 'most'),
    [
        (Twist(linear=Vector3(x=-3.0)), commands.TWIST_BYTES),
        (String(data='\U0001f3b1' * MAX_REQUEST_LENGTH), commands.REQUEST_BYTES),
        (PoseArray(poses=[Pose()] * 11), commands.layout_bytes(11)),
    ],
)
def test_the_longest_that_makes_sense_is_taken(read, message, most):
    assert read(type(message), most, serialize_message(message)) == ('taken', message)


@pytest.mark.parametrize('kind', [Twist, String, PoseArray])
@pytest.mark.parametrize('data', [b'', b'\0\1\0\0', b'\xff' * 60], ids=repr)
def test_what_is_no_message_is_refused_with_its_length_and_the_type(read, kind, data):
    what, reason = read(kind, 5000, data)
    assert what == 'refused' and f'{len(data)} bytes' in reason and kind.__name__ in reason
    assert '\n' not in reason


@pytest.mark.parametrize('size', [101, 1_000_000])
def test_what_is_too_long_is_refused_undecoded(read, monkeypatch, size):
    def decode(*_):
        raise AssertionError('decoded')

    monkeypatch.setattr(commands, 'deserialize_message', decode)
    what, reason = read(PoseArray, 100, bytes(size))
    assert what == 'refused' and str(size) in reason and '100' in reason


def test_a_length_that_lies_is_refused(read):
    data = bytearray(serialize_message(PoseArray(poses=[Pose()] * 3)))
    start = len(data) - 3 * 56 - 4
    for lie in (4, 100, 10_000_000, 2**32 - 1):
        for place in range(start - 8, start + 1):
            lying = bytearray(data)
            lying[place : place + 4] = lie.to_bytes(4, 'little')
            what, found = read(PoseArray, 10_000, bytes(lying))
            assert what == 'refused' or len(found.poses) <= 3


@pytest.mark.parametrize('count', [1, 11, 5000])
@pytest.mark.parametrize('frame_id', ['', 'a', 'map', 'table', 'x' * 1001])
def test_the_poses_are_counted_in_the_bytes(count, frame_id):
    message = PoseArray(header=Header(frame_id=frame_id), poses=[Pose()] * count)
    data = serialize_message(message)
    assert commands.count_poses(data) == count
    for other in (data[:-1], data + b'\0', b'', data[:10], b'\xff' * 100):
        assert commands.count_poses(other) is None


def test_bytes_that_are_too_many_are_described(read):
    heard = []
    commands.reader(PoseArray, 100, print, heard.append, lambda data: f'{len(data)} of them')(
        bytes(101)
    )
    assert heard == ['101 of them']
