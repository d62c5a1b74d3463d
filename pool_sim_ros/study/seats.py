"""Episodes of many environments: which start each has, and what its next one will be."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.study.streams import WORD, draws, mixed
from pool_sim_ros.study.tasks import State, Task, Turn

AHEAD = 32
"""Episodes whose starts are drawn at once: one draw costs as much as all of them."""


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
        # The first episode of those ahead, how many of them have begun, and their starts.
        self._first = np.zeros(count, np.uint64)
        self._begun = np.zeros(count, np.int64)
        self._ahead = np.zeros((count, AHEAD), np.int64)
        positions, goals, scores = task.starts
        self.state = State(
            *(np.zeros((count, *part.shape[1:])) for part in (positions, goals, scores))
        )

    def seed(self, seats: NDArray[np.int64], seeds: Sequence[int]) -> None:
        """Give some environments seeds; their next episode is the first of these."""
        self._seeds[seats] = mixed(np.array([seed % WORD for seed in seeds], np.uint64))
        self._first[seats] = 0
        self._look_ahead(seats)

    def begin(self, seats: NDArray[np.int64]) -> None:
        """Begin the next episode of some environments."""
        begun = self._begun[seats]
        chosen = self._ahead[seats, begun]
        begun += 1
        self._begun[seats] = begun
        if len(seats) and begun.max() == AHEAD:
            through = seats[begun == AHEAD]
            self._first[through] += np.uint64(AHEAD)
            self._look_ahead(through)
        for part, starts in zip(self.state, self._task.starts, strict=True):
            part[seats] = starts.take(chosen, axis=0)

    def _look_ahead(self, seats: NDArray[np.int64]) -> None:
        """Draw the starts of the episodes to come."""
        episodes = np.add.outer(self._first[seats], np.arange(AHEAD, dtype=np.uint64))
        below = len(self._task.starts.scores)
        self._ahead[seats] = draws(self._seeds[seats][:, np.newaxis], episodes, below)
        self._begun[seats] = 0

    def play(self, actions: NDArray[np.float64], asleep: NDArray[np.int64] | None) -> Turn:
        """Play a shot in each but those that are asleep, if any."""
        turn = self._task.play(self.state, actions, asleep)
        self.state = turn.state
        return turn

    def observations(self) -> NDArray[np.float64]:
        """Return positions and goals, (m, 2 n + g) in m; an array of its own."""
        positions, goals, _ = self.state
        return np.concatenate([positions.reshape(len(positions), -1), goals], axis=1)
