"""Words that say what goes on while a shot is played."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from geometry_msgs.msg import PoseArray
from std_msgs.msg import Float64MultiArray

from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.simulator_link import SimulatorLink
from pool_sim_ros.simulator import stamp_to_seconds


class ShotProgress:
    """Watches the balls of a simulator until `close`.

    Parameters
    ----------
    link : SimulatorLink
    on_progress : callable
        Called for every frame, with words.

    Attributes
    ----------
    paused : bool
        Whether the simulator is paused; set from outside.
    last_sign : float
        When the last frame came, by `time.monotonic`, s.
    """

    def __init__(self, link: SimulatorLink, on_progress: Callable[[str], None]) -> None:
        self.paused = False
        self.last_sign = time.monotonic()
        self._link = link
        self._on_progress = on_progress
        self._stamps: list[int] = []
        self._moving = 0
        self._subscriptions = [
            link.subscribe(interface.BALL_VELOCITIES, self._on_velocities),
            link.subscribe(interface.BALL_POSES, self._on_poses),
        ]

    def close(self) -> None:
        """Watch no more."""
        for subscription in self._subscriptions:
            self._link.unsubscribe(subscription)

    def _on_velocities(self, message: Float64MultiArray) -> None:
        try:
            rows = messages.from_rows(message)
        except ValueError as error:
            self._link.left_out(f'ball_velocities: {error}')
        else:
            self._moving = int(np.count_nonzero(rows.any(axis=1)))

    def _on_poses(self, message: PoseArray) -> None:
        self.last_sign = time.monotonic()
        if not self._moving:
            self._on_progress('paused' if self.paused else 'computing')
            return
        self._stamps.append(messages.from_time(message.header.stamp))
        del self._stamps[1:-1]
        balls = '1 ball moves' if self._moving == 1 else f'{self._moving} balls move'
        elapsed = stamp_to_seconds(self._stamps[-1] - self._stamps[0])
        self._on_progress(f'{elapsed:4.1f} s: {balls}')
