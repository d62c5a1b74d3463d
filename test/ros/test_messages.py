"""Messages to arrays and back; `plain_messages` makes those that the node writes as bytes."""

import json

import numpy as np
import plain_messages
import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Twist, Vector3
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Float64MultiArray

from pool_sim_ros.ros import messages
from pool_sim_ros.simulator import Diagnosis


def through_the_wire(message):
    return deserialize_message(serialize_message(message), type(message))


@pytest.mark.parametrize('stamp', [0, 1, 999_999_999, 1_000_000_000, 123_456_789_012_345])
def test_times_are_exact_to_the_nanosecond(stamp):
    time = through_the_wire(plain_messages.to_clock(stamp)).clock
    assert 0 <= time.nanosec < 1_000_000_000
    assert time.sec * 1_000_000_000 + time.nanosec == stamp == messages.from_time(time)


def test_poses_hold_the_positions_bit_for_bit():
    positions = np.array([[0.1, 0.2], [1 / 3, 2 / 7]])
    message = plain_messages.to_poses('table', 16_666_666, positions, [0.05, 0.03])
    assert np.array_equal(messages.from_poses(through_the_wire(message)), positions)


def test_no_poses_are_no_positions():
    message = plain_messages.to_poses('table', 0, np.empty((0, 2)), [])
    assert messages.from_poses(message).shape == (0, 2)


def test_rows_are_read_in_their_shape():
    rows = np.arange(30.0).reshape(3, 10) / 7
    message = through_the_wire(plain_messages.to_collisions(rows))
    assert np.array_equal(messages.from_rows(message), rows)


def test_a_message_without_a_layout_is_not_rows():
    with pytest.raises(ValueError):
        messages.from_rows(Float64MultiArray(data=[1.0, 2.0]))


def test_twist():
    twist = Twist(linear=Vector3(x=1.0, y=2.0, z=3.0), angular=Vector3(x=4.0, y=5.0, z=6.0))
    assert messages.from_twist(twist) == ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))


def test_json_is_strict():
    text = messages.to_json_string({'id': 'a', 'velocity': [1.0, -2.5]}).data
    assert json.loads(text) == {'id': 'a', 'velocity': [1.0, -2.5]}
    with pytest.raises(ValueError):
        messages.to_json_string({'velocity': float('nan')})


@pytest.mark.parametrize(
    ('warning', 'level', 'words'),
    [('', DiagnosticStatus.OK, 'running'), ('late', DiagnosticStatus.WARN, 'late')],
)
def test_diagnostics_tell_of_a_warning_and_every_value(warning, level, words):
    diagnosis = Diagnosis(warning, {'speed': '1.0', 'ticks behind': '0'})
    message = through_the_wire(messages.to_diagnostics('/hall/left', 1_500_000_000, diagnosis))
    (status,) = message.status
    assert (status.level, status.message) == (level, words)
    assert status.name == '/hall/left: simulation' and status.hardware_id == '/hall/left'
    assert {item.key: item.value for item in status.values} == diagnosis.values
    assert messages.from_time(message.header.stamp) == 1_500_000_000
