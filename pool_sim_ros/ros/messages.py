"""Messages to arrays, and numbers and texts to messages: pure functions."""

from __future__ import annotations

import json

import numpy as np
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseArray, Twist, Vector3
from std_msgs.msg import Float64MultiArray, String

from pool_sim_ros.simulator import SECOND_NS, Diagnosis


def to_time(stamp: int) -> Time:
    """Return a sim time in ns as a message."""
    seconds, nanoseconds = divmod(stamp, SECOND_NS)
    return Time(sec=seconds, nanosec=nanoseconds)


def from_time(time: Time) -> int:
    """Return the ns of a time."""
    stamp: int = time.sec * SECOND_NS + time.nanosec
    return stamp


def to_string(text: str) -> String:
    """Return a text as a message."""
    return String(data=text)


def to_json_string(fields: dict[str, object]) -> String:
    """Return fields as a message with JSON in it."""
    return String(data=json.dumps(fields, allow_nan=False))


def from_poses(message: PoseArray) -> np.ndarray:
    """Return the (n, 2) positions in m of a pose array; this ignores z and orientation."""
    places = [(pose.position.x, pose.position.y) for pose in message.poses]
    return np.array(places, dtype=float).reshape(-1, 2)


def from_rows(message: Float64MultiArray) -> np.ndarray:
    """Return the (k, c) rows of a message of `~/ball_velocities` or `~/collisions`."""
    rows, columns = (dimension.size for dimension in message.layout.dim)
    return np.array(message.data, dtype=float).reshape(rows, columns)


def to_diagnostics(name: str, stamp: int, diagnosis: Diagnosis) -> DiagnosticArray:
    """Return how the node of this full name is doing, at a sim time in ns."""
    status = DiagnosticStatus(
        level=DiagnosticStatus.WARN if diagnosis.warning else DiagnosticStatus.OK,
        name=f'{name}: simulation',
        message=diagnosis.warning or 'running',
        hardware_id=name,
        values=[KeyValue(key=key, value=value) for key, value in diagnosis.values.items()],
    )
    message = DiagnosticArray(status=[status])
    message.header.stamp = to_time(stamp)
    return message


def from_twist(twist: Twist) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the linear (m/s) and the angular (rad/s) part of a twist."""
    return _from_vector(twist.linear), _from_vector(twist.angular)


def _from_vector(vector: Vector3) -> tuple[float, float, float]:
    return vector.x, vector.y, vector.z
