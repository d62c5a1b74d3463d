"""What the node sends, and in what order."""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.node import Node

from pool_sim_ros import conversions, interface
from pool_sim_ros.playback import Frame
from pool_sim_ros.protocol import Response
from pool_sim_ros.settings import Settings
from pool_sim_ros.table_json import table_to_json


class Publishers:
    """The node's publishers and its log: the `player.Output` of a node.

    Parameters
    ----------
    node : Node
    settings : Settings
        As at start-up.
    """

    def __init__(self, node: Node, settings: Settings) -> None:
        self.failed = False
        """Whether `fail` was called."""
        self._node = node
        self._frame_id = settings.frame_id
        self._radii = settings.table.radii.tolist()
        self._response = self._create(interface.SHOT_RESPONSE)
        self._poses = self._create(interface.BALL_POSES)
        self._velocities = self._create(interface.BALL_VELOCITIES)
        self._collisions = self._create(interface.COLLISIONS)
        self._state = self._create(interface.STATE)
        self._table = self._create(interface.TABLE)
        self._clock = self._create(interface.CLOCK) if settings.publish_clock else None

    def frame(self, frame: Frame) -> None:
        """Send a tick: the clock, the collisions up to it, then the balls."""
        self.clock(frame.stamp)
        if len(frame.collisions):
            self._collisions.publish(conversions.to_collisions(frame.collisions))
        self._poses.publish(
            conversions.to_poses(self._frame_id, frame.stamp, frame.positions, self._radii)
        )
        self._velocities.publish(conversions.to_velocities(frame.velocities))

    def clock(self, stamp: int) -> None:
        """Send the sim time in ns, where this is wanted."""
        if self._clock is not None:
            self._clock.publish(conversions.to_clock(stamp))

    def responses(self, responses: Sequence[Response]) -> None:
        """Send responses."""
        for response in responses:
            self._response.publish(conversions.to_string(response.to_json()))

    def state(self, state: dict[str, object]) -> None:
        """Send the state."""
        self._state.publish(conversions.to_json_string(state))

    def table(self, settings: Settings) -> None:
        """Send the table that counts from the next strike."""
        self._table.publish(conversions.to_string(table_to_json(settings.table)))

    def tell(self, line: str) -> None:
        """Write to the log."""
        self._node.get_logger().info(line)

    def fail(self, line: str) -> None:
        """Write to the log, and shut ROS down."""
        self.failed = True
        self._node.get_logger().fatal(line)
        self._node.context.try_shutdown()

    def is_open(self) -> bool:
        """Return whether ROS is up."""
        return self._node.context.ok()

    def _create(self, topic: interface.Topic):
        return self._node.create_publisher(topic.type, topic.private, topic.qos)
