"""The latest ball poses, fetched when they are wanted instead of delivered by an executor."""

from __future__ import annotations

import uuid

from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter

from pool_sim_ros import interface


class LatestPoses:
    """A subscription to `~/ball_poses` that is looked at now and then.

    Waking an executor for each of 60 messages in a second costs three times as much as this.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str
        Name of the node, relative to the namespace of this one or absolute.
    """

    def __init__(self, context: Context, simulator: str) -> None:
        # A node of its own, which no executor knows: that would take the messages away.
        self._node = Node(
            f'pool_web_poses_{uuid.uuid4().hex[:8]}',
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter('start_type_description_service', value=False)],
        )
        topic = interface.BALL_POSES
        self._subscription = self._node.create_subscription(
            topic.type, topic.of(simulator), lambda _: None, topic.qos, raw=True
        )

    def take(self) -> bytes | None:
        """Return the latest message, serialised; None where none has come since the last time."""
        latest = None
        subscription = self._subscription
        with subscription.handle:  # keeps it alive
            while taken := subscription.handle.take_message(subscription.msg_type, True):
                latest = taken[0]
        return latest

    def close(self) -> None:
        """Leave ROS."""
        self._node.destroy_node()
