"""Messages to arrays and back, as pure functions."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import Pose, PoseArray, Twist, Vector3
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64MultiArray, MultiArrayDimension, String

from pool_sim_ros.simulator import COLLISION_COLUMNS, SECOND_NS, VELOCITY_COLUMNS, Diagnosis


def to_time(stamp: int) -> Time:
    """Return a sim time in ns as a message."""
    seconds, nanoseconds = divmod(stamp, SECOND_NS)
    return Time(sec=seconds, nanosec=nanoseconds)


def from_time(time: Time) -> int:
    """Return the ns of a time."""
    return time.sec * SECOND_NS + time.nanosec


def to_clock(stamp: int) -> Clock:
    """Return a sim time in ns as the message of `/clock`."""
    return Clock(clock=to_time(stamp))


def to_string(text: str) -> String:
    """Return a text as a message."""
    return String(data=text)


def to_json_string(fields: dict[str, object]) -> String:
    """Return fields as a message with JSON in it."""
    return String(data=json.dumps(fields, allow_nan=False))


def to_poses(frame_id: str, stamp: int, positions: np.ndarray, radii: Sequence[float]) -> PoseArray:
    """Return the balls' centres as poses.

    Parameters
    ----------
    frame_id : str
    stamp : int
        ns.
    positions : ndarray of shape (n, 2)
        m.
    radii : sequence of n floats
        m; a ball's centre is as high as its radius.
    """
    message = PoseArray()
    message.header.frame_id = frame_id
    message.header.stamp = to_time(stamp)
    for (x, y), radius in zip(positions.tolist(), radii, strict=True):
        pose = Pose()
        pose.position.x, pose.position.y, pose.position.z = x, y, float(radius)
        message.poses.append(pose)
    return message


def from_poses(message: PoseArray) -> np.ndarray:
    """Return the (n, 2) positions in m of a pose array; z and orientation are left out."""
    places = [(pose.position.x, pose.position.y) for pose in message.poses]
    return np.array(places, dtype=float).reshape(-1, 2)


def to_velocities(velocities: np.ndarray) -> Float64MultiArray:
    """Return (n, 2) velocities in m/s as a message."""
    return _to_rows(velocities, 'ball', VELOCITY_COLUMNS)


def to_collisions(rows: np.ndarray) -> Float64MultiArray:
    """Return (k, 10) rows of `COLLISION_COLUMNS` as a message."""
    return _to_rows(rows, 'collision', COLLISION_COLUMNS)


def from_rows(message: Float64MultiArray) -> np.ndarray:
    """Return the rows of a message that `to_velocities` or `to_collisions` made."""
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


def _to_rows(rows: np.ndarray, name: str, columns: Sequence[str]) -> Float64MultiArray:
    message = Float64MultiArray()
    message.layout.dim = [
        MultiArrayDimension(label=name, size=len(rows), stride=rows.size),
        MultiArrayDimension(label=','.join(columns), size=len(columns), stride=len(columns)),
    ]
    message.data = np.ascontiguousarray(rows, dtype=float).ravel().tolist()
    return message
