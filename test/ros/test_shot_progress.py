"""The words that say what goes on during a shot."""

from types import SimpleNamespace

from geometry_msgs.msg import PoseArray
from std_msgs.msg import Float64MultiArray, MultiArrayDimension

from pool_sim_ros.ros import interface
from pool_sim_ros.ros.shot_progress import ShotProgress


def link_to(callbacks, left_out):
    return SimpleNamespace(
        subscribe=lambda topic, callback: callbacks.setdefault(topic.name, callback),
        unsubscribe=lambda subscription: None,
        left_out=left_out.append,
    )


def velocities(rows):
    message = Float64MultiArray(data=[float(v) for row in rows for v in row])
    message.layout.dim = [
        MultiArrayDimension(label=str(size), size=size) for size in (len(rows), len(rows[0]))
    ]
    return message


def poses(seconds):
    message = PoseArray()
    message.header.stamp.sec = seconds
    return message


def test_it_tells_how_many_balls_move_and_for_how_long():
    callbacks, words, left_out = {}, [], []
    progress = ShotProgress(link_to(callbacks, left_out), words.append)
    on_velocities = callbacks[interface.BALL_VELOCITIES.name]
    on_poses = callbacks[interface.BALL_POSES.name]
    on_poses(poses(7))
    progress.paused = True
    on_poses(poses(7))
    on_velocities(velocities([[0.0, 0.0, 0.0, 0.0, 2.0], [1.0, 0.0, 0.0, 0.0, 0.0], [0.0] * 5]))
    on_poses(poses(8))
    on_velocities(velocities([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]))
    on_poses(poses(11))
    on_velocities(Float64MultiArray())
    assert words == ['computing', 'paused', ' 0.0 s: 2 balls move', ' 3.0 s: 1 ball moves']
    assert len(left_out) == 1
    progress.close()
