"""Episodes of many environments: which start each has, and what its next one will be."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.study.streams import WORD, draws, mixed
from pool_sim_ros.study.tasks import State, Task, Turn


class Seats:
    """The state of m environments that do the same task.

    Each has its own seed. So what one draws does not depend on how many there are.

    Parameters
    ----------
    task : Task
    count : int
        m.

    Attributes
    ----------
    state : State
    """

    def __init__(self, task: Task, count: int) -> None:
        self._task = task
        self._seeds = np.zeros(count, np.uint64)
        self._episodes = np.zeros(count, np.uint64)
        positions, goals, scores = task.starts
        self.state = State(
            *(np.zeros((count, *part.shape[1:])) for part in (positions, goals, scores))
        )

    def seed(self, seats: NDArray[np.int64], seeds: Sequence[int]) -> None:
        """Give some environments seeds; their next episode is the first of these."""
        self._seeds[seats] = mixed(np.array([seed % WORD for seed in seeds], np.uint64))
        self._episodes[seats] = 0

    def begin(self, seats: NDArray[np.int64]) -> None:
        """Begin the next episode of some environments."""
        chosen = draws(self._seeds[seats], self._episodes[seats], len(self._task.starts.scores))
        self._episodes[seats] += np.uint64(1)
        for part, starts in zip(self.state, self._task.starts, strict=True):
            part[seats] = starts[chosen]

    def play(self, actions: NDArray[np.float64], asleep: NDArray[np.bool_] | None) -> Turn:
        """Play a shot in each that is not asleep, (m,)."""
        turn = self._task.play(self.state, actions, asleep)
        self.state = turn.state
        return turn

    def observations(self) -> NDArray[np.float64]:
        """Return positions and goals, (m, 2 n + g) in m; an array of its own."""
        positions, goals, _ = self.state
        m, n, _ = positions.shape
        seen = np.empty((m, 2 * n + goals.shape[1]))
        seen[:, : 2 * n] = positions.reshape(m, 2 * n)
        seen[:, 2 * n :] = goals
        return seen
