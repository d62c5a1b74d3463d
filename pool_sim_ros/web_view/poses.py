"""The latest ball poses, fetched on demand instead of delivered by an executor."""

from __future__ import annotations

from rclpy.context import Context

from pool_sim_ros.ros import SimulatorLink, interface


class LatestPoses:
    """A subscription to `~/ball_poses`, for a reader that looks now and then.

    An executor that wakes for each of 60 messages a second costs three times as much.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str
        Name of the node, relative to the namespace of this one or absolute.
    """

    def __init__(self, context: Context, simulator: str) -> None:
        # A node of its own, which no executor knows: an executor would take the messages away.
        self._link = SimulatorLink(context, simulator, 'web_poses', enable_rosout=False)
        self._subscription = self._link.subscribe(interface.BALL_POSES, lambda _: None, raw=True)

    def take(self) -> bytes | None:
        """Return the latest message, serialised; None if none has come since the last call."""
        latest = None
        subscription = self._subscription
        with subscription.handle:  # keeps it alive
            while taken := subscription.handle.take_message(subscription.msg_type, True):
                latest = taken[0]
        return latest

    def close(self) -> None:
        """Leave ROS."""
        self._link.close()
