"""When markers are sent: what changes while somebody looks, and all of it to whoever comes."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray
from rclpy.node import Node
from visualization_msgs.msg import MarkerArray

from pool_sim_ros.physics import Table
from pool_sim_ros.ros import interface
from pool_sim_ros.ros.markers import Markers
from pool_sim_ros.simulator import Frame, start_layout

LOOK_PERIOD = 0.1
"""Seconds between two looks for viewers; a look costs as much as a message."""


class MarkerPublisher:
    """Publishes `~/markers`.

    A message holds either what a frame changes or all there is. At rest the last one holds all, and
    whoever comes is sent all: so no viewer needs more than the last message, whatever its depth.

    Parameters
    ----------
    node : Node
    table : Table
    frame_id : str
    """

    def __init__(self, node: Node, table: Table, frame_id: str) -> None:
        topic = interface.MARKERS
        self._markers = Markers(table, frame_id)
        self._publisher = node.create_publisher(topic.type, topic.private, topic.qos)
        self._viewers = 0
        self._next_look = 0.0
        self._missed = False
        self._frame: Frame | None = None
        start = start_layout(table)
        everything = self._markers.everything(start.positions, start.orientations, start.pocketed)
        self._publisher.publish(everything)

    def frame(self, frame: Frame) -> None:
        """Send what a tick has changed.

        While nobody looks, a rolling ball costs nothing. A viewer that comes then sees no trail of
        what it missed.
        """
        came = self._look_for_viewers()
        seen, self._frame = self._frame, frame
        if frame.moving and not self._viewers:
            self._missed = True
            return
        resting = seen is not None and frame.block.positions is seen.block.positions
        if resting and not (frame.block.moving or came or self._missed):
            return
        self._show(frame, came)

    def look(self) -> None:
        """Send all there is to a viewer that has come while no frames are shown."""
        frame = self._frame
        if frame is None or not self._look_for_viewers():
            return
        if self._missed:
            self._changes(frame, frame.collisions[:0], started=False, rolling=False)
            self._missed = False
        self._publisher.publish(self._everything(frame))

    def _show(self, frame: Frame, came: bool) -> None:
        rolling = (frame.moving or frame.finished) and not self._missed
        changes = self._changes(frame, frame.collisions, started=frame.started, rolling=rolling)
        self._missed = False
        if came or frame.started or (changes is not None and not frame.moving):
            self._publisher.publish(self._everything(frame))
        elif changes is not None and self._viewers:
            self._publisher.publish(changes)

    def _everything(self, frame: Frame) -> MarkerArray:
        return self._markers.everything(frame.positions, frame.orientations, frame.pocketed)

    def _changes(
        self, frame: Frame, collisions: NDArray[np.float64], *, started: bool, rolling: bool
    ) -> MarkerArray | None:
        return self._markers.changes(
            frame.positions,
            collisions,
            started=started,
            rolling=rolling,
            turned=frame.orientations,
            pocketed=frame.pocketed,
        )

    def _look_for_viewers(self) -> bool:
        """Return whether somebody has come since the last look; False if it is too early."""
        now = time.monotonic()
        if now < self._next_look:
            return False
        self._next_look = now + LOOK_PERIOD
        before, self._viewers = self._viewers, self._publisher.get_subscription_count()
        return self._viewers > before
