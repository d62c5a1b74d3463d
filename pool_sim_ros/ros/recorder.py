"""Keeps what a simulator publishes, as serialised bytes with their sim time."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from geometry_msgs.msg import PoseArray
from rclpy.context import Context
from rclpy.serialization import deserialize_message
from rclpy.subscription import Subscription
from std_msgs.msg import String

from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.sim_stamps import Heard, Recorded, in_sim_time
from pool_sim_ros.ros.simulator_client import SimulatorError
from pool_sim_ros.ros.simulator_link import SimulatorLink
from pool_sim_ros.simulator import response_from_json, seconds_to_stamp

TOPICS = (
    interface.TABLE,
    interface.STATE,
    interface.MARKERS,
    interface.SHOT_REQUEST,
    interface.SHOT_RESPONSE,
    interface.BALL_VELOCITIES,
    interface.COLLISIONS,
    interface.BALL_POSES,
)
"""The topics that are recorded, beside `/clock` if it is published.

The simulator learns of the subscriptions in this order. The last comes with every tick: once it
arrives, the others do too.
"""

_AT_ONCE = (interface.TABLE, interface.STATE, interface.MARKERS, interface.BALL_POSES)
"""The topics that come without a shot: latched, or with every tick."""

_DEPTH = 5000
"""Depth of the queues, in messages."""


class Recorder:
    """Listens from its creation until `close`.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str
        Name of the node, relative to the namespace of this one or absolute.
    """

    def __init__(self, context: Context, simulator: str) -> None:
        self._heard: list[Heard] = []
        self._link = SimulatorLink(context, simulator, 'recorder')
        self._listen(interface.CLOCK)
        self._subscriptions = [self._listen(topic) for topic in TOPICS]
        self._link.start()

    @property
    def messages(self) -> list[Recorded]:
        """All messages so far, with their sim time and in its order."""
        return in_sim_time(list(self._heard))

    def close(self) -> None:
        """Listen no more."""
        self._link.close()

    def wait_for_topics(self, timeout: float) -> None:
        """Wait until everything that is published arrives.

        Parameters
        ----------
        timeout : float
            s.

        Raises
        ------
        SimulatorError
            If a topic is missing after that time.
        """
        self._wait(self._hears_all, timeout, 'did not publish all its topics')

    def wait_for_end(self, response: dict[str, Any], timeout: float) -> None:
        """Wait until everything of a shot has arrived.

        That is the last response to its request, and two frames that show its end. The executor
        takes from each topic in turn, so that with the second frame it has taken whatever was
        published with the first, or before.

        Parameters
        ----------
        response : dict
            The last response, as `shot_request.Response` has it.
        timeout : float
            s.

        Raises
        ------
        SimulatorError
            If something is missing after that time.
        """
        end = seconds_to_stamp(response['t_end'])

        def came() -> bool:
            stamps = [messages.from_time(pose.header.stamp) for pose in self._last_poses(2)]
            if len(stamps) < 2 or stamps[0] < end:
                return False
            answers = [answer for answer in self._answers() if answer['id'] == response['id']]
            return bool(answers) and answers[-1]['phase'] == response['phase']

        self._wait(came, timeout, 'did not send the end of the shot')

    def _last_poses(self, count: int) -> list[PoseArray]:
        """Return the last frames, in order; what is none is left out."""
        poses: list[PoseArray] = []
        for message in reversed(self._heard):
            if len(poses) == count:
                break
            if message.topic is interface.BALL_POSES:
                try:
                    poses.insert(0, deserialize_message(message.data, PoseArray))
                except Exception as error:  # whatever rclpy makes of bytes that are no message
                    self._link.left_out(f'ball_poses: {error}')
        return poses

    def _answers(self) -> Iterator[dict[str, Any]]:
        """Yield the responses, in order; what is none is left out."""
        for message in list(self._heard):
            if message.topic is interface.SHOT_RESPONSE:
                try:
                    yield response_from_json(deserialize_message(message.data, String).data)
                except Exception as error:  # the same
                    self._link.left_out(f'shot/response: {error}')

    def _hears_all(self) -> bool:
        heard = {message.name for message in self._heard}
        return heard >= {self._link.full_name(topic) for topic in _AT_ONCE} and all(
            subscription.get_publisher_count() for subscription in self._subscriptions
        )

    def _listen(self, topic: interface.Topic) -> Subscription:
        name = self._link.full_name(topic)

        def keep(data: bytes, info: Mapping[str, int]) -> None:
            self._heard.append(Heard(info['source_timestamp'], topic, name, bytes(data)))

        past = topic is not interface.SHOT_RESPONSE  # of which there may be a thousand
        return self._link.subscribe(topic, keep, depth=_DEPTH, past=past, raw=True)

    def _wait(self, condition: Callable[[], bool], timeout: float, otherwise: str) -> None:
        end = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > end:
                raise SimulatorError(f'{self._link.simulator} {otherwise} within {timeout:g} s')
            time.sleep(0.01)
