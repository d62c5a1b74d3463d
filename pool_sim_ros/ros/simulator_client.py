"""A client of the node: it sends requests, calls services, and waits for the answers."""

from __future__ import annotations

import math
import time
import uuid
from collections.abc import Callable
from typing import Any

from rclpy.context import Context

from pool_sim_ros.console import CommandError
from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.simulator_link import SimulatorLink
from pool_sim_ros.simulator import Phase, response_from_json

NAP = 0.1
"""Longest time between two checks of what it waits for, s."""

RESEND = 1.0
"""Time in s after which a request that is not answered is sent again, with the same id."""


class SimulatorError(CommandError):
    """The simulator did not do what was asked; the message is for the user."""


class SimulatorClient:
    """Asks a simulator for one thing after another.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str, optional
        Name of the node, relative to the client's namespace or absolute.
    has_ended : callable, optional
        Returns whether the simulator has certainly ended, so that waiting is useless.
    """

    def __init__(
        self,
        context: Context,
        simulator: str = interface.NODE_NAME,
        has_ended: Callable[[], bool] = lambda: False,
    ) -> None:
        self._has_ended = has_ended
        self._link = SimulatorLink(context, simulator, 'client')
        self._requests = self._link.publisher(interface.SHOT_REQUEST)
        self._responses = self._link.subscribe_text(
            interface.SHOT_RESPONSE, response_from_json, self._on_response
        )
        self._id = ''
        self._answers: list[dict[str, Any]] = []
        self._last_sign = time.monotonic()
        self._warned = False

    @property
    def simulator(self) -> str:
        """Full name of the simulator."""
        return self._link.simulator

    def close(self) -> None:
        """Leave ROS."""
        self._link.close()

    def wait_for_simulator(self, timeout: float) -> None:
        """Wait until somebody takes requests and the answers of the simulator arrive.

        Who takes requests need not be the simulator yet: `play` sends until it is answered.

        Parameters
        ----------
        timeout : float
            s.

        Raises
        ------
        SimulatorError
            If no simulator answers in that time.
        """

        def matched() -> bool:
            return (
                self._requests.get_subscription_count() > 0
                and self._responses.get_publisher_count() > 0
            )

        self._wait(
            matched,
            timeout,
            f'no simulator answers as {self.simulator} (waited for {timeout:g} s); '
            'is sim_node running, with the same ROS_DOMAIN_ID?',
        )
        self._warn_of_namesakes()

    def table_json(self, timeout: float) -> str:
        """Return the JSON of `~/table`, which `simulator.table_from_json` reads.

        Parameters
        ----------
        timeout : float
            s.

        Raises
        ------
        SimulatorError
            If no table comes in that time.
        """
        from pool_sim_ros.simulator import table_from_json  # loads the physics

        def read(text: str) -> str:
            table_from_json(text)
            return text

        texts: list[str] = []
        # Deep, so that what others send does not push it out before it is read.
        subscription = self._link.subscribe_text(interface.TABLE, read, texts.append, depth=100)
        try:
            self._wait(
                lambda: bool(texts),
                timeout,
                f'{self.simulator} announced no table within {timeout:g} s',
            )
        finally:
            self._link.unsubscribe(subscription)
        return texts[-1]

    def call(self, service: interface.Service, *, timeout: float, **fields: object) -> str:
        """Call a service: `interface.RESET`, `STEP`, or `SET_PAUSED` with ``data=True``.

        Parameters
        ----------
        service : Service
        timeout : float
            Time after which to give up, s.
        **fields
            Of the request.

        Returns
        -------
        str
            What the simulator says of it.

        Raises
        ------
        SimulatorError
            If this is refused, or if the simulator does not answer.
        """
        client = self._link.client(service)
        silent = f'{self.simulator} did not answer {service.name} within {timeout:g} s'
        self._wait(client.service_is_ready, timeout, silent)
        answer = client.call_async(service.type.Request(**fields))
        self._wait(answer.done, timeout, silent)
        response = answer.result()
        if not response.success:
            raise SimulatorError(response.message)
        return str(response.message)

    def _outcome(self) -> dict[str, Any]:
        response = self._answers[-1]
        if response['phase'] != Phase.DONE:
            raise SimulatorError(f'{response["phase"]} ({response["code"]}): {response["reason"]}')
        return response

    def _ask(self, timeout: float, **fields: object) -> None:
        """Send a request until it is answered; the simulator plays it once."""
        self._id = uuid.uuid4().hex
        self._answers.clear()
        request = messages.to_json_string({'id': self._id, **fields})
        last = -math.inf

        def answered() -> bool:
            nonlocal last
            if not self._answers and time.monotonic() - last > RESEND:
                last = time.monotonic()
                self._requests.publish(request)
            return bool(self._answers)

        self._wait(
            answered,
            timeout,
            f'{self.simulator} did not answer the request within {timeout:g} s',
        )
        self._warn_of_namesakes()

    def _warn_of_namesakes(self) -> None:
        count = self._link.count_simulators()
        if count > 1 and not self._warned:
            self._warned = True
            self._link.warn(
                f'{count} nodes are named {self.simulator}: each plays the shot, and any of them '
                'may answer; give each a name of its own'
            )

    def _wait(self, condition: Callable[[], bool], timeout: float, otherwise: str) -> None:
        end = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > end:
                raise SimulatorError(otherwise)
            self._spin()

    def _spin(self) -> None:
        if self._has_ended():
            raise SimulatorError('the simulator has ended')
        self._link.spin_once(NAP)

    def _on_response(self, response: dict[str, Any]) -> None:
        self._last_sign = time.monotonic()
        if response['id'] == self._id:
            self._answers.append(response)
