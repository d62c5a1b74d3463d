"""The ROS side: a client of the simulator, with a thread of its own."""

from __future__ import annotations

import asyncio
import uuid
from collections.abc import Callable
from typing import Any, Protocol

from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.context import Context
from rclpy.parameter import Parameter

from pool_sim_ros.ros import SimulatorLink, interface, messages
from pool_sim_ros.simulator import response_from_json
from pool_sim_ros.web_view.poses import LatestPoses

SET_PARAMETERS = interface.Service('set_parameters', SetParameters, 'set parameters of the node')
GET_PARAMETERS = interface.Service('get_parameters', GetParameters, 'parameters of the node')
"""Services that every node has."""

SERVICES = (
    interface.RESET,
    interface.STEP,
    interface.SET_PAUSED,
    SET_PARAMETERS,
    GET_PARAMETERS,
)
"""The services that the pages use."""

PATIENCE = 6.0
"""Seconds to wait for a service; a step may itself wait 5 s for a shot that is being computed."""

RESEND = 1.0
"""Time in s after which a request that is not answered is sent again, with the same id."""


class NoAnswerError(Exception):
    """The simulator did not answer; the message is for the user."""


class Listener(Protocol):
    """Takes what the simulator sends, always within the event loop."""

    def on_collisions(self, message: Any) -> None:
        """Take a message of `~/collisions`."""

    def on_response(self, message: Any) -> None:
        """Take a message of `~/shot/response`."""

    def on_state(self, message: Any) -> None:
        """Take a message of `~/state`."""

    def on_table(self, message: Any) -> None:
        """Take a message of `~/table`."""


class Bridge:
    """Talks to one simulator. Its methods belong to the event loop in which it was made.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str
        Name of the node, relative to the namespace of this one or absolute.
    listener : Listener
    """

    def __init__(self, context: Context, simulator: str, listener: Listener) -> None:
        self._loop = asyncio.get_running_loop()
        self._link = SimulatorLink(context, simulator, 'web_view')
        self._requests = self._link.publisher(interface.SHOT_REQUEST)
        self._asked: dict[str, asyncio.Future[None]] = {}
        self._listener = listener
        self._poses = LatestPoses(context, simulator)
        for topic, callback in (
            (interface.COLLISIONS, listener.on_collisions),
            (interface.SHOT_RESPONSE, self._on_response),
            (interface.STATE, listener.on_state),
            (interface.TABLE, listener.on_table),
        ):
            past = topic is not interface.SHOT_RESPONSE  # of which there may be a thousand
            self._link.subscribe(topic, self._hand_to(callback), past=past)
        self._clients = {service: self._link.client(service) for service in SERVICES}
        self._link.start()

    @property
    def simulator(self) -> str:
        """Full name of the simulator."""
        return self._link.simulator

    def is_matched(self) -> bool:
        """Return whether the simulator hears requests from now on."""
        return self._requests.get_subscription_count() > 0 and all(
            client.service_is_ready() for client in self._clients.values()
        )

    def close(self) -> None:
        """Leave ROS."""
        self._link.close()
        self._poses.close()

    def latest_poses(self) -> bytes | None:
        """Return the latest message of `~/ball_poses`, serialised; None if none is new."""
        return self._poses.take()

    def left_out(self, error: Exception) -> None:
        """Write to the log that something from the simulator made no sense."""
        self._link.left_out(error)

    async def request(self, **fields: object) -> None:
        """Send a request, as `~/shot/request` takes it, under a new id until it is answered.

        The simulator plays it once, however often it is sent.

        Raises
        ------
        NoAnswerError
            If nobody answers.
        """
        request_id = uuid.uuid4().hex
        request = messages.to_json_string({'id': request_id, **fields})
        answered = self._asked[request_id] = self._loop.create_future()
        try:
            for _ in range(round(PATIENCE / RESEND)):
                self._requests.publish(request)
                await asyncio.wait([answered], timeout=RESEND)
                if answered.done():
                    return
        finally:
            del self._asked[request_id]
        raise NoAnswerError(f'{self.simulator} does not answer')

    async def call(self, service: interface.Service, **fields: object) -> tuple[bool, str]:
        """Call a service; return whether it succeeded, and its words.

        Raises
        ------
        NoAnswerError
            If nobody answers.
        """
        answer = await self._answer(service, **fields)
        return answer.success, answer.message

    async def set_parameter(self, name: str, value: object) -> tuple[bool, str]:
        """Set a parameter of the simulator; returns and raises as `call`."""
        parameter: ParameterMessage = Parameter(name, value=value).to_parameter_msg()
        answer = await self._answer(SET_PARAMETERS, parameters=[parameter])
        (result,) = answer.results
        return result.successful, result.reason

    async def number_parameter(self, name: str) -> float:
        """Return a parameter of the simulator that is a number; raises as `call`."""
        answer = await self._answer(GET_PARAMETERS, names=[name])
        (value,) = answer.values
        number: float = value.double_value
        return number

    async def _answer(self, service: interface.Service, **fields: object) -> Any:
        client = self._clients[service]
        nobody = f'{self.simulator} does not answer'
        if not client.service_is_ready():
            raise NoAnswerError(nobody)
        answered = self._loop.create_future()

        def hand_over() -> None:
            if answered.done():
                return
            try:
                answered.set_result(future.result())
            except Exception as error:
                answered.set_exception(NoAnswerError(f'{nobody}: {error}'))

        future = client.call_async(service.type.Request(**fields))
        future.add_done_callback(lambda _: self._in_loop(hand_over))
        try:
            return await asyncio.wait_for(answered, PATIENCE)
        except asyncio.TimeoutError:
            client.remove_pending_request(future)
            raise NoAnswerError(nobody) from None

    def _on_response(self, message: Any) -> None:
        answered = self._asked.get(response_from_json(message.data)['id'])
        if answered is not None and not answered.done():
            answered.set_result(None)
        self._listener.on_response(message)

    def _hand_to(self, callback: Callable[[Any], None]) -> Callable[[Any], None]:
        return lambda message: self._in_loop(self._hand_over, callback, message)

    def _hand_over(self, callback: Callable[[Any], None], message: object) -> None:
        try:
            callback(message)
        except Exception as error:  # anybody may send anything on these topics
            self.left_out(error)

    def _in_loop(self, callback: Callable[..., object], *args: object) -> None:
        # The loop may have ended meanwhile.
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(callback, *args)
