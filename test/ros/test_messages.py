import numpy as np
import pytest
from geometry_msgs.msg import Twist, Vector3
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Float64MultiArray

from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import messages
from pool_sim_ros.simulator import COLLISION_COLUMNS, table_from_json, table_to_json


def through_the_wire(message):
    return deserialize_message(serialize_message(message), type(message))


@pytest.mark.parametrize('stamp', [0, 1, 999_999_999, 1_000_000_000, 123_456_789_012_345])
def test_times_are_exact_to_the_nanosecond(stamp):
    time = through_the_wire(messages.to_clock(stamp)).clock
    assert 0 <= time.nanosec < 1_000_000_000
    assert time.sec * 1_000_000_000 + time.nanosec == stamp == messages.from_time(time)


def test_poses_hold_the_positions_bit_for_bit_at_the_height_of_the_radius():
    positions = np.array([[0.1, 0.2], [1 / 3, 2 / 7]])
    message = through_the_wire(messages.to_poses('table', 16_666_666, positions, [0.05, 0.03]))
    assert message.header.frame_id == 'table'
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (0, 16_666_666)
    assert [p.position.z for p in message.poses] == [0.05, 0.03]
    assert all(p.orientation.w == 1.0 and p.orientation.x == 0.0 for p in message.poses)
    assert np.array_equal(messages.from_poses(message), positions)


def test_no_poses_are_no_positions():
    message = messages.to_poses('table', 0, np.empty((0, 2)), [])
    assert messages.from_poses(message).shape == (0, 2)


def test_rows_say_their_shape_and_columns():
    rows = np.arange(30.0).reshape(3, 10) / 7
    message = through_the_wire(messages.to_collisions(rows))
    first, second = message.layout.dim
    assert (first.size, first.stride, second.size, second.stride) == (3, 30, 10, 10)
    assert second.label.split(',') == list(COLLISION_COLUMNS)
    assert np.array_equal(messages.from_rows(message), rows)
    velocities = messages.to_velocities(rows[:, :2])
    assert velocities.layout.dim[1].label == 'vx,vy'
    assert list(velocities.data) == rows[:, :2].ravel().tolist()


def test_a_message_without_a_layout_is_not_rows():
    with pytest.raises(ValueError):
        messages.from_rows(Float64MultiArray(data=[1.0, 2.0]))


def test_twist():
    twist = Twist(linear=Vector3(x=1.0, y=2.0, z=3.0), angular=Vector3(x=4.0, y=5.0, z=6.0))
    assert messages.from_twist(twist) == ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))


def test_a_table_survives_json():
    table = report_table()
    assert table_from_json(table_to_json(table)) == table


@pytest.mark.parametrize('text', ['', '[]', '{}', '{"balls": [{}]}', '{"balls": 3}'])
def test_what_is_no_table_is_refused(text):
    with pytest.raises(ValueError):
        table_from_json(text)
