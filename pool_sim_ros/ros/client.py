"""A client of the node: it sends requests over the topics and waits for their outcome."""

from __future__ import annotations

import math
import time
import uuid
from collections.abc import Callable
from typing import Any

import numpy as np
from geometry_msgs.msg import PoseArray
from rclpy.context import Context
from rclpy.subscription import Subscription
from std_msgs.msg import Float64MultiArray, String

from pool_sim_ros.console import CommandError
from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.simulator_link import SimulatorLink
from pool_sim_ros.simulator import (
    Phase,
    response_from_json,
    stamp_to_seconds,
    state_from_json,
)

NAP = 0.1
"""Longest time between two checks of what it waits for, s."""

RESEND = 1.0
"""Time in s after which a request that is not answered is sent again, with the same id."""

IDLE_STATES = 6
"""A shot is lost after so many states in a row, each of a later tick, without a shot and without a
pause. One is not enough: a shot begins one tick after it is computed, and the response that says it
is done may arrive late."""


class SimulatorError(CommandError):
    """The simulator did not do what was asked; the message is for the user."""


class ShotClient:
    """Plays shots on a simulator, one after another.

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
        self._link.subscribe_text(interface.STATE, state_from_json, self._on_state)
        self._id = ''
        self._answers: list[dict[str, Any]] = []
        self._idle_states = 0
        self._tick = -1
        self._paused = False
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

    def play(
        self,
        shot: int | None = None,
        velocity: tuple[float, float] | None = None,
        *,
        timeout: float,
        on_accepted: Callable[[dict[str, Any]], None] = lambda response: None,
        on_progress: Callable[[str], None] | None = None,
    ) -> dict[str, Any]:
        """Play one shot and wait until all balls rest.

        Parameters
        ----------
        shot : int, optional
            Number of a report shot.
        velocity : tuple of float, optional
            Of the cue ball, m/s; instead of `shot`.
        timeout : float
            Time without an answer, and then without a sign of life, after which to give up, s.
        on_accepted : callable, optional
            Called with the response once the request is accepted.
        on_progress : callable, optional
            Called for every frame, with words that say what goes on.

        Returns
        -------
        dict
            The last response, as `shot_request.Response` has it.

        Raises
        ------
        SimulatorError
            If the shot is rejected or preempted, or if the simulator falls silent.
        """
        self._id = uuid.uuid4().hex
        self._answers.clear()
        what = {'velocity': velocity} if shot is None else {'shot': shot}
        self._ask(messages.to_json_string({'id': self._id, **what}), timeout)
        self._warn_of_namesakes()
        if self._answers[0]['phase'] != Phase.REJECTED:
            on_accepted(self._answers[0])
            self._wait_for_rest(timeout, on_progress)
            self._warn_of_namesakes()  # one may have been found only now
        response = self._answers[-1]
        if response['phase'] != Phase.DONE:
            raise SimulatorError(f'{response["phase"]} ({response["code"]}): {response["reason"]}')
        return response

    def _ask(self, request: String, timeout: float) -> None:
        """Send a request until it is answered; the simulator plays it once."""
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

    def _warn_of_namesakes(self) -> None:
        count = self._link.count_simulators()
        if count > 1 and not self._warned:
            self._warned = True
            self._link.warn(
                f'{count} nodes are named {self.simulator}: each plays the shot, and any of them '
                'may answer; give each a name of its own'
            )

    def _wait_for_rest(self, timeout: float, on_progress: Callable[[str], None] | None) -> None:
        self._idle_states = 0
        watching = [] if on_progress is None else self._watch(on_progress)
        try:
            while self._answers[-1]['phase'] == Phase.ACCEPTED:
                self._spin()
                if time.monotonic() - self._last_sign > timeout:
                    raise SimulatorError(
                        f'{self.simulator} fell silent {timeout:g} s ago, in the middle of the shot'
                    )
                if self._idle_states >= IDLE_STATES:
                    raise SimulatorError(
                        f'{self.simulator} knows nothing of this shot any more; was it restarted?'
                    )
        finally:
            for subscription in watching:
                self._link.unsubscribe(subscription)

    def _watch(self, on_progress: Callable[[str], None]) -> list[Subscription]:
        times: list[int] = []
        moving = 0

        def on_velocities(message: Float64MultiArray) -> None:
            nonlocal moving
            try:
                rows = messages.from_rows(message)
            except ValueError as error:
                self._link.left_out(f'ball_velocities: {error}')
            else:
                moving = int(np.count_nonzero(rows.any(axis=1)))

        def on_poses(message: PoseArray) -> None:
            self._last_sign = time.monotonic()
            if not moving:
                on_progress('paused' if self._paused else 'computing')
                return
            times.append(messages.from_time(message.header.stamp))
            del times[1:-1]
            balls = '1 ball moves' if moving == 1 else f'{moving} balls move'
            on_progress(f'{stamp_to_seconds(times[-1] - times[0]):4.1f} s: {balls}')

        return [
            self._link.subscribe(interface.BALL_VELOCITIES, on_velocities),
            self._link.subscribe(interface.BALL_POSES, on_poses),
        ]

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

    def _on_state(self, state: dict[str, Any]) -> None:
        self._last_sign = time.monotonic()
        self._paused = state['paused']
        if state['paused'] or state['moving'] or state['computing']:
            self._idle_states = 0
        elif state['tick'] != self._tick:
            self._idle_states += 1
        self._tick = state['tick']
