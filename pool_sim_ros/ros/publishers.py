"""What the node sends, and in which order."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher

from pool_sim_ros.ros import cdr, interface, messages
from pool_sim_ros.ros.marker_publisher import MarkerPublisher
from pool_sim_ros.ros.namesakes import Namesakes
from pool_sim_ros.simulator import (
    COLLISION_COLUMNS,
    Block,
    Code,
    Diagnosis,
    Frame,
    Phase,
    Response,
    Settings,
    table_to_json,
    velocity_columns,
)


class Publishers:
    """The node's publishers and its log: the runner's `Output`.

    Parameters
    ----------
    node : Node
    settings : Settings
        Those at start-up.
    """

    def __init__(self, node: Node, settings: Settings) -> None:
        self.failed = False
        """Whether `fail` was called."""
        self._node = node
        self._namesakes = Namesakes(node)
        self._to_poses = cdr.PosesWriter(settings.frame_id, settings.table.radii.tolist())
        self._to_velocities = cdr.RowsWriter('ball', velocity_columns(settings.table.motion))
        self._to_collisions = cdr.RowsWriter('collision', COLLISION_COLUMNS)
        self._block: Block | None = None
        self._response = self._create(interface.SHOT_RESPONSE)
        self._poses = self._create(interface.BALL_POSES)
        self._velocities = self._create(interface.BALL_VELOCITIES)
        self._collisions = self._create(interface.COLLISIONS)
        self._state = self._create(interface.STATE)
        self._table = self._create(interface.TABLE)
        self._diagnostics = self._create(interface.DIAGNOSTICS)
        self._markers = MarkerPublisher(node, settings.table, settings.frame_id)
        self._clock = self._create(interface.CLOCK) if settings.publish_clock else None

    def prepare(self, block: Block) -> None:
        """Make the messages of the next ticks, so that `frame` only sends them."""
        if block is not self._block:
            self._block = block
            self._block_clocks = cdr.clock_bytes(block.stamps)
            self._block_poses = self._to_poses.write(
                block.stamps, block.positions, block.orientations, block.pocketed
            )
            self._block_velocities = self._to_velocities.write(block.velocities)
            self._block_collisions = {
                index: self._to_collisions.write(rows[np.newaxis])[0]
                for index, rows in enumerate(block.collisions)
                if len(rows)
            }

    def frame(self, frame: Frame) -> None:
        """Send a tick: the clock, the collisions up to it, then the balls."""
        self.prepare(frame.block)
        index = frame.index
        if self._clock is not None:
            self._clock.publish(self._block_clocks[index])
        if index in self._block_collisions:
            self._collisions.publish(self._block_collisions[index])
        self._poses.publish(self._block_poses[index])
        self._velocities.publish(self._block_velocities[index])
        self._markers.frame(frame)

    def clock(self, stamp: int) -> None:
        """Send the sim time in ns, if `publish_clock` is set; send all to a new viewer."""
        if self._clock is not None:
            self._clock.publish(*cdr.clock_bytes([stamp]))
        self._markers.look()

    def responses(self, responses: Sequence[Response]) -> None:
        """Send responses."""
        for response in responses:
            self._response.publish(messages.to_string(response.to_json()))
            # What a request got at once is told by whoever took it.
            told = (
                response.phase in (Phase.DONE, Phase.PREEMPTED) and response.code is not Code.RESET
            )
            if told and response.reason is not None:
                self._node.get_logger().warn(f'{response.phase.value}: {response.reason}')

    def state(self, state: dict[str, object]) -> None:
        """Send the state."""
        self._state.publish(messages.to_json_string(state))

    def table(self, settings: Settings) -> None:
        """Send the table as it is from the next strike on."""
        self._table.publish(messages.to_string(table_to_json(settings.table)))

    def diagnostics(self, stamp: int, diagnosis: Diagnosis) -> None:
        """Send how the node is doing, at a sim time in ns; warn of nodes with its name."""
        name = self._node.get_fully_qualified_name()
        self._diagnostics.publish(messages.to_diagnostics(name, stamp, diagnosis))
        self._namesakes.check()

    def tell(self, line: str) -> None:
        """Write to the log."""
        self._node.get_logger().info(line)

    def fail(self, line: str) -> None:
        """Write to the log, and shut ROS down."""
        self.failed = True
        self._node.get_logger().fatal(line)
        self._node.context.try_shutdown()

    def is_read(self) -> bool:
        """Return whether balls, velocities and collisions each have a reader."""
        frames = (self._poses, self._velocities, self._collisions)
        return all(publisher.get_subscription_count() for publisher in frames)

    def wait_for_delivery(self, timeout: Duration) -> None:
        """Wait until the readers have all frames, for each topic at most `timeout`."""
        for publisher in (self._poses, self._velocities, self._collisions):
            publisher.wait_for_all_acked(timeout)

    def is_open(self) -> bool:
        """Return whether ROS is up."""
        return self._node.context.ok()

    def _create(self, topic: interface.Topic) -> Publisher:
        return self._node.create_publisher(topic.type, topic.private, topic.qos)
