"""When markers are sent: the table once, the rest when it changes and somebody looks."""

from __future__ import annotations

import time

import numpy as np
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from pool_sim_ros.physics import Table
from pool_sim_ros.ros import interface
from pool_sim_ros.ros.markers import Markers
from pool_sim_ros.simulator import Frame

LATCHED_CHANGES = 5
"""Messages about moving things that a late viewer receives. Together with the table they must fit
into the ten that a viewer usually keeps: it counts the messages of all publishers of a topic, and
would otherwise drop the table."""

LOOK_PERIOD = 0.1
"""Seconds between two looks for viewers; a look costs as much as a message."""


class MarkerPublisher:
    """Publishes `~/markers`.

    Parameters
    ----------
    node : Node
    table : Table
    frame_id : str
    """

    def __init__(self, node: Node, table: Table, frame_id: str) -> None:
        topic = interface.MARKERS
        self._markers = Markers(table, frame_id)
        moving = QoSProfile(depth=LATCHED_CHANGES, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        # Two publishers of one topic, so that moving things do not push the latched table out.
        self._once = node.create_publisher(topic.type, topic.private, topic.qos)
        self._often = node.create_publisher(topic.type, topic.private, moving)
        self._viewers = 0
        self._next_look = 0.0
        self._missed = False
        self._seen: np.ndarray | None = None
        self._once.publish(self._markers.table())
        self._often.publish(self._markers.everything(table.positions))

    def frame(self, frame: Frame) -> None:
        """Send what a tick has changed.

        While nobody looks, a rolling ball costs nothing. A viewer that comes then sees no trail of
        what it missed.
        """
        came = self._look_for_viewers()
        if frame.moving and not self._viewers:
            self._missed = True
            return
        if not (frame.block.moving or came) and frame.block.positions is self._seen:
            return
        self._seen = frame.block.positions
        changes = self._markers.changes(
            frame.positions,
            frame.collisions,
            started=frame.started,
            rolling=(frame.moving or frame.finished) and not self._missed,
        )
        self._missed = False
        if changes is None and not came:
            return
        if changes is not None and self._viewers:
            self._often.publish(changes)
        # All of it, and after the changes: a late viewer receives only the last messages.
        resting = changes is not None and not frame.moving
        if resting or frame.started or came:
            self._often.publish(self._markers.everything(frame.positions))

    def _look_for_viewers(self) -> bool:
        """Return whether somebody has come since the last look; False if it is too early."""
        now = time.monotonic()
        if now < self._next_look:
            return False
        self._next_look = now + LOOK_PERIOD
        before, self._viewers = self._viewers, self._often.get_subscription_count()
        return self._viewers > before
