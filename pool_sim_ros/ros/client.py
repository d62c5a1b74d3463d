"""A client of the node: it plays shots, places balls, and waits for the outcome."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

from rclpy.context import Context

from pool_sim_ros.ros import interface
from pool_sim_ros.ros.shot_progress import ShotProgress
from pool_sim_ros.ros.simulator_client import SimulatorClient, SimulatorError
from pool_sim_ros.simulator import Phase, state_from_json

IDLE_STATES = 6
"""A shot is lost after so many states in a row, each of a later tick, without a shot and without a
pause. One is not enough: a shot begins one tick after it is computed, and the response that says it
is done may arrive late."""


class ShotClient(SimulatorClient):
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
        super().__init__(context, simulator, has_ended)
        self._link.subscribe_text(interface.STATE, state_from_json, self._on_state)
        self._idle_states = 0
        self._tick = -1
        self._paused = False

    def play(
        self,
        shot: int | None = None,
        velocity: tuple[float, float] | None = None,
        *,
        spin: tuple[float, float, float] | None = None,
        cue: dict[str, float] | None = None,
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
        spin : tuple of float, optional
            Of the cue ball, with `velocity`, where balls spin, rad/s.
        cue : dict, optional
            speed, azimuth, elevation, side, above, as `physics.cue_strike` has them; instead of
            `velocity`.
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
        asked = {'shot': shot, 'velocity': velocity, 'spin': spin, 'cue': cue}
        self._ask(timeout, **{key: value for key, value in asked.items() if value is not None})
        if self._answers[0]['phase'] != Phase.REJECTED:
            on_accepted(self._answers[0])
            self._wait_for_rest(timeout, on_progress)
            self._warn_of_namesakes()  # one may have been found only now
        return self._outcome()

    def place(self, places: Mapping[str, tuple[float, float]], *, timeout: float) -> dict[str, Any]:
        """Put single balls elsewhere, while all rest.

        Parameters
        ----------
        places : mapping
            Label -> (x, y), m.
        timeout : float
            Time without an answer after which to give up, s.

        Returns
        -------
        dict
            The last response, as `shot_request.Response` has it.

        Raises
        ------
        SimulatorError
            If this is rejected, or if the simulator does not answer.
        """
        self._ask(timeout, place={label: list(place) for label, place in places.items()})
        self._wait(
            lambda: self._answers[-1]['phase'] != Phase.ACCEPTED,
            timeout,
            f'{self.simulator} did not place the balls within {timeout:g} s',
        )
        return self._outcome()

    def _wait_for_rest(self, timeout: float, on_progress: Callable[[str], None] | None) -> None:
        self._idle_states = 0
        watching = None if on_progress is None else ShotProgress(self._link, on_progress)
        try:
            while self._answers[-1]['phase'] == Phase.ACCEPTED:
                self._spin()
                if watching is not None:
                    watching.paused = self._paused
                    self._last_sign = max(self._last_sign, watching.last_sign)
                if time.monotonic() - self._last_sign > timeout:
                    raise SimulatorError(
                        f'{self.simulator} fell silent {timeout:g} s ago, in the middle of the shot'
                    )
                if self._idle_states >= IDLE_STATES:
                    raise SimulatorError(
                        f'{self.simulator} knows nothing of this shot any more; was it restarted?'
                    )
        finally:
            if watching is not None:
                watching.close()

    def _on_state(self, state: dict[str, Any]) -> None:
        self._last_sign = time.monotonic()
        self._paused = state['paused']
        if state['paused'] or state['moving'] or state['computing']:
            self._idle_states = 0
        elif state['tick'] != self._tick:
            self._idle_states += 1
        self._tick = state['tick']
