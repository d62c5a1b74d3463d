"""The latest poses, fetched when they are wanted."""

import numpy as np
import pytest
from plain_messages import to_poses
from rclpy.serialization import serialize_message
from waiting import wait_until

from pool_sim_ros.ros import interface
from pool_sim_ros.web_view.frames import frame_positions, page_frame
from pool_sim_ros.web_view.poses import LatestPoses


@pytest.fixture
def poses(ros):
    poses = LatestPoses(ros.context, 'left')
    yield poses
    poses.close()


@pytest.fixture
def publisher(ros, poses):
    topic = interface.BALL_POSES
    publisher = ros.node('left').create_publisher(topic.type, topic.of('left'), topic.qos)
    wait_until(publisher.get_subscription_count, 'the match')
    return publisher


def publish(publisher, stamp):
    positions = np.full((2, 2), float(stamp))
    publisher.publish(serialize_message(to_poses('table', stamp, positions, [0.1, 0.1])))


def take_until(poses, stamp):
    """Return what was taken, up to the poses of a stamp."""
    taken = []

    def came():
        taken.extend(filter(None, [poses.take()]))
        return taken and frame_positions(page_frame(taken[-1]))[0, 0] == stamp

    wait_until(came, f'the poses of {stamp}')
    return taken


def test_nothing_came(poses):
    assert poses.take() is None


def test_each_is_taken_once_and_nobody_need_spin(poses, publisher):
    publish(publisher, 1)
    assert len(take_until(poses, 1)) == 1
    assert poses.take() is None
    publish(publisher, 2)
    assert len(take_until(poses, 2)) == 1


def test_of_those_that_came_meanwhile_only_the_latest_is_given(poses, publisher):
    for stamp in range(1, 200):
        publish(publisher, stamp)
    taken = take_until(poses, 199)
    assert len(taken) < 199
    assert poses.take() is None
