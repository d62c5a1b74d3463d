"""Messages read as bytes say what ROS says of them, and foreign bytes are refused."""

import struct

import numpy as np
import pytest
from geometry_msgs.msg import Point, Pose, PoseArray
from rclpy.serialization import serialize_message

from pool_sim_ros.ros.cdr_reader import CdrReader, read_poses


def poses(count, frame_id='table'):
    message = PoseArray(
        poses=[Pose(position=Point(x=0.1 * k, y=-1.5, z=9.0)) for k in range(count)]
    )
    message.header.stamp.sec, message.header.stamp.nanosec = 3, 4
    message.header.frame_id = frame_id
    return message


@pytest.mark.parametrize('frame_id', ['', 'table', 'abcdefgh', 'ü'])
@pytest.mark.parametrize('count', [0, 1, 11])
def test_poses_are_read_as_ros_wrote_them(count, frame_id):
    stamp, frame, positions = read_poses(serialize_message(poses(count, frame_id)))
    assert (stamp, frame) == (3_000_000_004, frame_id)
    expected = [[0.1 * k, -1.5] for k in range(count)]
    assert np.array_equal(positions, np.reshape(expected, (count, 2)))


def test_the_other_byte_order_is_read_too():
    numbers = struct.pack('>iI', 3, 4) + struct.pack('>I', 1) + b'\0' + bytes(3)
    numbers += struct.pack('>I', 1) + bytes(4) + struct.pack('>7d', *range(1, 8))
    stamp, _, positions = read_poses(b'\0\0\0\0' + numbers)
    assert stamp == 3_000_000_004 and positions.tolist() == [[1.0, 2.0]]


def test_foreign_bytes_are_refused():
    whole = serialize_message(poses(2))
    for data in [whole[:end] for end in range(0, len(whole) - 3)]:
        with pytest.raises(ValueError, match=f'^{len(data)} bytes are no geometry_msgs'):
            read_poses(data)
    wrong = poses(2)
    wrong.poses[1].position.x = float('nan')
    with pytest.raises(ValueError, match='not finite'):
        read_poses(serialize_message(wrong))


def test_a_text_has_an_end_within_the_message():
    for data in (b'', b'\5\0\0\0abcd', b'\0\0\0\0', b'\3\0\0\0abc', b'\xff\xff\xff\xff\0'):
        with pytest.raises((ValueError, struct.error)):
            CdrReader(b'\0\1\0\0' + data).text()
