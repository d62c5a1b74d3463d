"""One table as an environment of gymnasium."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded
from numpy.typing import NDArray

from pool_sim_ros.study.checks import checked_actions
from pool_sim_ros.study.seats import Seats
from pool_sim_ros.study.spaces import action_space, observation_space
from pool_sim_ros.study.tasks import Task

SEAT = np.zeros(1, np.int64)


class TaskEnv(gymnasium.Env[NDArray[np.float64], NDArray[np.float64]]):
    """A task as an environment; `PlaceEnv` and `PotEnv` say what it is."""

    metadata: dict[str, Any] = {'render_modes': []}

    def __init__(self, task: Task) -> None:
        self._seats = Seats(task, 1)
        self._goes_on = self._seeded = False
        self.observation_space = observation_space(task)
        self.action_space = action_space(task)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float64], dict[str, Any]]:
        """Begin an episode; with a seed, the first of that seed.

        Parameters
        ----------
        seed : int, optional
            Without one, the next episode of the seed before.
        options : dict, optional
            Not used.

        Returns
        -------
        observation : ndarray of shape (k,)
            As the class says, m.
        info : dict
            Empty.
        """
        super().reset(seed=seed)
        if seed is not None or not self._seeded:
            self._seats.seed(SEAT, [self.np_random_seed])
            self._seeded = True
        self._seats.begin(SEAT)
        self._goes_on = True
        return self._seats.observations()[0], {}

    def step(
        self, action: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], float, bool, bool, dict[str, Any]]:
        """Play one shot.

        Parameters
        ----------
        action : array_like of shape (2,), where balls spin (4,)
            Each -1 to 1; the class says what they are.

        Returns
        -------
        observation : ndarray of shape (k,)
            As the class says, m.
        reward : float
            As the class says.
        terminated, truncated : bool
            Whether the episode has ended, or was cut.
        info : dict
            As the class says.

        Raises
        ------
        ValueError
            For an action of another shape, or that is not finite; then nothing is played.
        ResetNeeded
            Before the first reset, and where the episode is over.
        """
        if not self._goes_on:
            raise ResetNeeded('the episode is at its end, or none has begun: call reset()')
        actions = checked_actions(action, self.action_space.shape)[np.newaxis]
        turn = self._seats.play(actions, None)
        ended, failed = bool(turn.ended[0]), bool(turn.failed[0])
        self._goes_on = not (ended or failed)
        info = {
            'duration': float(turn.outcomes.durations[0]),
            'first_hit': int(turn.outcomes.first_hit[0]),
        }
        return self._seats.observations()[0], float(turn.rewards[0]), ended, failed, info
