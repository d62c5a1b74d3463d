"""Steps of a paused table; while a shot is being computed they wait, and all else goes on."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future

from pool_sim_ros.simulator.simulation import Simulation

STEP_PATIENCE = 5.0
"""Seconds for which a step waits for the shot that is being computed, to show it."""

MOST_STEPS = 100
"""Steps that wait; a further one is refused at once."""

LOOK_PERIOD = 0.005
"""Seconds between two looks at whether the shot is computed."""

Stepped = tuple[bool, str]
"""Whether a step was done, and a message."""


class Steps:
    """Carries out steps in their order, and answers each once; for one thread at a time.

    Parameters
    ----------
    simulation : Simulation
    show_next_frame : callable
        Goes on by one tick.
    """

    def __init__(self, simulation: Simulation, show_next_frame: Callable[[], None]) -> None:
        self._simulation = simulation
        self._show_next_frame = show_next_frame
        self._waiting: deque[tuple[float, Future[Stepped]]] = deque()

    @property
    def wait(self) -> float:
        """Seconds until `serve` should be called again; inf where no step waits."""
        return LOOK_PERIOD if self._waiting else math.inf

    def add(self) -> Future[Stepped]:
        """Take a step: carry it out at once, or let it wait for the shot that is being computed."""
        answer: Future[Stepped] = Future()
        if not (self._waiting or self._must_wait):
            answer.set_result(self._carry_out())
        elif len(self._waiting) < MOST_STEPS:
            self._waiting.append((time.monotonic() + STEP_PATIENCE, answer))
        else:
            answer.set_result((False, f'{MOST_STEPS} steps wait for a shot to be computed already'))
        return answer

    def serve(self) -> None:
        """Carry out the oldest step that waits, if it need not wait, or give it up after a while.

        Only one, since it may have many ticks: others want the table too.
        """
        if self._waiting and not (self._must_wait and time.monotonic() < self._waiting[0][0]):
            _, answer = self._waiting.popleft()
            answer.set_result(self._carry_out())

    def close(self) -> None:
        """Refuse all that wait."""
        while self._waiting:
            _, answer = self._waiting.popleft()
            answer.set_result((False, 'the simulator stops'))

    @property
    def _must_wait(self) -> bool:
        return self._simulation.paused and self._simulation.computing

    def _carry_out(self) -> Stepped:
        if self._must_wait:
            return False, 'a shot is still being computed; step again once state says it is not'
        if not self._simulation.paused:
            return False, 'only a paused table can be stepped; call set_paused first'
        for _ in range(self._simulation.settings.step_ticks):
            self._show_next_frame()
        return True, f'at tick {self._simulation.tick}'
