"""What the node sends, as message objects: the plain twin of `ros.cdr`."""

import numpy as np
from geometry_msgs.msg import Pose, PoseArray
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64MultiArray, MultiArrayDimension

from pool_sim_ros.ros import messages
from pool_sim_ros.simulator import COLLISION_COLUMNS, VELOCITY_COLUMNS


def to_clock(stamp):
    """Return the message of `/clock` for a sim time in ns."""
    return Clock(clock=messages.to_time(stamp))


def to_poses(frame_id, stamp, positions, radii):
    """Return the balls' centres as poses: sim time in ns, (n, 2) positions and n radii in m."""
    message = PoseArray()
    message.header.frame_id = frame_id
    message.header.stamp = messages.to_time(stamp)
    for (x, y), radius in zip(positions.tolist(), radii, strict=True):
        pose = Pose()
        pose.position.x, pose.position.y, pose.position.z = x, y, float(radius)
        message.poses.append(pose)
    return message


def to_velocities(velocities):
    """Return (n, 2) velocities in m/s as a message."""
    return _to_rows(velocities, 'ball', VELOCITY_COLUMNS)


def to_collisions(rows):
    """Return (k, 10) rows of `COLLISION_COLUMNS` as a message."""
    return _to_rows(rows, 'collision', COLLISION_COLUMNS)


def _to_rows(rows, name, columns):
    message = Float64MultiArray()
    message.layout.dim = [
        MultiArrayDimension(label=name, size=len(rows), stride=rows.size),
        MultiArrayDimension(label=','.join(columns), size=len(columns), stride=len(columns)),
    ]
    message.data = np.ascontiguousarray(rows, dtype=float).ravel().tolist()
    return message
