"""The latest ball poses, fetched on demand instead of delivered by an executor."""

from __future__ import annotations

from rclpy.context import Context

from pool_sim_ros.ros import Inbox, SimulatorLink, interface


class LatestPoses:
    """The latest message of `~/ball_poses`, for a reader that looks now and then.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str
        Name of the node, relative to the namespace of this one or absolute.
    """

    def __init__(self, context: Context, simulator: str) -> None:
        self._link = SimulatorLink(context, simulator, 'web_poses', enable_rosout=False)
        self._inbox = Inbox(self._link, interface.BALL_POSES, raw=True)

    def take(self) -> bytes | None:
        """Return the latest message, serialised; None if none has come since the last call."""
        found = self._inbox.take()
        return found[-1][0] if found else None

    def close(self) -> None:
        """Leave ROS."""
        self._link.close()
