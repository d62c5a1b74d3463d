"""The latest ball poses, fetched when they are wanted instead of delivered by an executor."""

from __future__ import annotations

from rclpy.context import Context

from pool_sim_ros.ros import SimulatorLink, interface


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
        self._link = SimulatorLink(context, simulator, 'web_poses', enable_rosout=False)
        self._subscription = self._link.subscribe(interface.BALL_POSES, lambda _: None, raw=True)

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
        self._link.close()
