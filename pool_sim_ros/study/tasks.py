"""What is to be done on the table, and what a shot earns: plain arrays, one row an environment."""

from __future__ import annotations

import abc
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics import Outcomes, Table, simulate_many
from pool_sim_ros.study.checks import positive
from pool_sim_ros.study.starts import starts_of
from pool_sim_ros.study.strikes import Strikes

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


class State(NamedTuple):
    """How m tables are.

    `positions` is (m, n, 2) in m; `goals` is (m, g), what an environment is to reach; `scores` is
    (m,), what has been reached.
    """

    positions: Floats
    goals: Floats
    scores: Floats


class Turn(NamedTuple):
    """What came of one shot on each of m tables.

    `rewards`, `ended` and `failed` are (m,): a shot that the engine gives up moves nothing.
    """

    state: State
    rewards: Floats
    ended: Flags
    failed: Flags
    outcomes: Outcomes


class Task(abc.ABC):
    """A table, where its balls may start, and what is to be done.

    Parameters
    ----------
    table : Table
    speed : float
        Of the cue ball along x or y at most, m/s.
    starts : int or array_like of shape (k, n, 2)
        How many layouts are drawn, or these layouts, m.
    threads : int or None
        As in `simulate_many`.

    Raises
    ------
    ValueError
        Where nothing stops the balls, or a value is out of range.
    """

    def __init__(
        self, table: Table, speed: float, starts: int | ArrayLike, threads: int | None
    ) -> None:
        if not isinstance(table, Table):
            raise ValueError(f'table: {table!r} must be a Table or the name of one')
        if not table.comes_to_rest:
            raise ValueError('table: nothing stops the balls on it; friction must not be 0')
        self.table = table
        self.strikes = Strikes(table, speed)
        layouts = starts_of(table, starts)
        self._threads = threads
        goals = self.new_goals(layouts)
        pocketed = self._play(np.zeros((len(layouts), 2)), None, layouts).pocketed
        self.starts = State(layouts, goals, self.scores(layouts, goals, pocketed))

    @abc.abstractmethod
    def new_goals(self, layouts: Floats) -> Floats:
        """Return a goal for each start, (k, g)."""

    @abc.abstractmethod
    def goal_limits(self) -> tuple[Floats, Floats]:
        """Return the least and the most of each number of a goal, (g,) both."""

    @abc.abstractmethod
    def scores(self, positions: Floats, goals: Floats, pocketed: NDArray[np.int64]) -> Floats:
        """Return what has been reached, (m,); a shot earns what it adds."""

    @abc.abstractmethod
    def verdicts(self, scores: Floats, pocketed: NDArray[np.int64]) -> tuple[Flags, Flags | None]:
        """Return which tables are done, and which are lost, (m,) both; None: no table can be."""

    bonus = 0.0
    """What it earns to be done."""

    def play(self, state: State, actions: Floats, asleep: NDArray[np.int64] | None = None) -> Turn:
        """Play one shot on each table but those that are `asleep`, if any.

        `actions` is (m, a), as `Strikes` has them.
        """
        velocities, spins = self.strikes.of(actions)
        if asleep is not None:
            velocities[asleep] = 0.0
            if spins is not None:
                spins[asleep] = 0.0
        outcomes = self._play(velocities, spins, state.positions)
        positions, goals, failed = outcomes.finals, state.goals, outcomes.failed.view(np.bool_)
        broken = failed.any()
        if broken:
            failed = outcomes.failed != 0
            positions[failed] = state.positions[failed]
        scores = self.scores(positions, goals, outcomes.pocketed)
        done, lost = self.verdicts(scores, outcomes.pocketed)
        rewards = scores - state.scores
        if self.bonus:
            np.add(rewards, self.bonus, out=rewards, where=done)
        ended = done
        if lost is not None:
            rewards -= lost
            ended = done | lost
        if broken:
            scores[failed] = state.scores[failed]
            rewards[failed] = 0.0
            ended[failed] = False
        return Turn(State(positions, goals, scores), rewards, ended, failed, outcomes)

    def _play(self, velocities: Floats, spins: Floats | None, positions: Floats) -> Outcomes:
        return simulate_many(
            self.table,
            velocities,
            spins=spins,
            positions=positions,
            errors='mark',
            threads=self._threads,
        )


class Place(Task):
    """Bring a ball to a place.

    Parameters
    ----------
    table, speed, starts, threads
        As in `Task`.
    ball : str
        Its label.
    place : array_like of shape (2,) or None
        m; None: another one in each start, anywhere on the cloth.
    within : float
        How near the ball must come to rest, m.
    """

    bonus = 1.0

    def __init__(
        self,
        table: Table,
        speed: float,
        starts: int | ArrayLike,
        threads: int | None,
        ball: str,
        place: ArrayLike | None,
        within: float,
    ) -> None:
        if isinstance(table, Table):
            self._ball = table.index(ball)
            if self._ball == 0:
                raise ValueError(f'ball: {ball!r} is the cue ball; name another one')
        self._place, self._within = place, positive('within', within, 'm')
        super().__init__(table, speed, starts, threads)

    def goal_limits(self) -> tuple[Floats, Floats]:
        radius = self.table.radii[self._ball]
        return np.full(2, radius), np.array([self.table.length, self.table.width]) - radius

    def new_goals(self, layouts: Floats) -> Floats:
        low, high = self.goal_limits()
        if self._place is not None:
            try:
                place = np.asarray(self._place, dtype=float)
            except (TypeError, ValueError):
                place = np.empty(0)
            if place.shape != (2,) or not ((low <= place) & (place <= high)).all():
                raise ValueError(
                    f'place: {self._place!r} must be x and y on the cloth, from {low.tolist()} to '
                    f'{high.tolist()} m'
                )
            return np.tile(place, (len(layouts), 1))
        rng = np.random.default_rng(len(layouts))
        goals = np.empty((len(layouts), 2))
        rows = np.arange(len(layouts))
        # Nothing would be left to do where the ball lies at its place. On a table that is hardly
        # larger than that, so be it.
        for _ in range(100):
            goals[rows] = rng.uniform(low, high, (len(rows), 2))
            rows = rows[self._distances(layouts[rows], goals[rows]) <= self._within]
            if not len(rows):
                break
        return goals

    def scores(self, positions: Floats, goals: Floats, pocketed: NDArray[np.int64]) -> Floats:
        return -self._distances(positions, goals)

    def verdicts(self, scores: Floats, pocketed: NDArray[np.int64]) -> tuple[Flags, Flags | None]:
        done = scores >= -self._within
        if not len(self.table.pockets):
            return done, None
        lost = (pocketed[:, 0] >= 0) | (pocketed[:, self._ball] >= 0)
        return done & ~lost, lost

    def _distances(self, positions: Floats, goals: Floats) -> Floats:
        apart = positions[:, self._ball] - goals
        apart *= apart
        return np.sqrt(apart[:, 0] + apart[:, 1])


class Pot(Task):
    """Bring all balls but the cue ball into pockets; other parameters as in `Task`."""

    def __init__(
        self, table: Table, speed: float, starts: int | ArrayLike, threads: int | None
    ) -> None:
        if isinstance(table, Table):
            if not len(table.pockets):
                raise ValueError("table: it has no pockets; '7ft', '8ft', '9ft' and 'snooker' have")
            if len(table.balls) < 2:
                raise ValueError('table: it has the cue ball alone; there is nothing to pot')
        super().__init__(table, speed, starts, threads)

    def goal_limits(self) -> tuple[Floats, Floats]:
        return np.empty(0), np.empty(0)

    def new_goals(self, layouts: Floats) -> Floats:
        return np.empty((len(layouts), 0))

    def scores(self, positions: Floats, goals: Floats, pocketed: NDArray[np.int64]) -> Floats:
        return (pocketed[:, 1:] >= 0).sum(axis=1, dtype=float)

    def verdicts(self, scores: Floats, pocketed: NDArray[np.int64]) -> tuple[Flags, Flags]:
        lost = pocketed[:, 0] >= 0
        return (scores == len(self.table.balls) - 1) & ~lost, lost
