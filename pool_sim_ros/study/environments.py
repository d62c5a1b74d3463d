"""The environments by name: what is seen, what is done, and what it earns."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from pool_sim_ros.extras import needs
from pool_sim_ros.study.starts import COUNT
from pool_sim_ros.study.tables import TableGiven, table_of
from pool_sim_ros.study.tasks import Place, Pot, Task

with needs('an environment', 'gym'):
    from gymnasium.vector import AutoresetMode

    from pool_sim_ros.study.single import TaskEnv
    from pool_sim_ros.study.vector import TaskVectorEnv

SPEED = 3.0
"""m/s: a ball of the report's that sets off so fast runs twice the length of its table."""

WITHIN = 0.1
"""m: nearly the diameter of the report's balls."""


def _place(
    table: TableGiven = 'report',
    *,
    ball: str = '9',
    place: ArrayLike | None = None,
    within: float = WITHIN,
    speed: float = SPEED,
    starts: int | ArrayLike = COUNT,
    threads: int | None = None,
) -> Task:
    return Place(table_of(table), speed, starts, threads, ball, place, within)


def _pot(
    table: TableGiven = '7ft',
    *,
    speed: float = SPEED,
    starts: int | ArrayLike = COUNT,
    threads: int | None = None,
) -> Task:
    return Pot(table_of(table), speed, starts, threads)


class PlaceEnv(TaskEnv):
    """``PoolSim/Place-v0``: bring a ball to a place. One step is one shot, until all balls rest.

    Parameters
    ----------
    table : Table or str, optional
        Or the name of one: 'report', '7ft', '8ft', '9ft', 'snooker', 'carom'.
    ball : str, optional
        The label of the ball.
    place : array_like of shape (2,), optional
        Where it is to come to rest, m; by default somewhere else in each start.
    within : float, optional
        How near, m.
    speed : float, optional
        Of the cue ball along x or y at most, m/s.
    starts : int or array_like of shape (k, n, 2), optional
        How many layouts are drawn at random, or the layouts themselves, m. An episode begins with
        one of these.
    threads : int, optional
        As in `simulate_many`.

    Raises
    ------
    ValueError
        Where one of these is out of range; names it.

    Notes
    -----
    **Observation**, float64 of shape (2 n + 2,), m: x and y of each ball in the order of
    ``table.balls``, then x and y of the place. A caught ball is at its pocket's centre.

    **Action**, float64, each -1 to 1, what is beyond counts as these: the velocity of the cue ball
    along x and y, as parts of `speed`. Where balls spin, two more: how far to the left of the
    middle and above it the tip of a level cue meets the ball, as parts of half a radius.

    **Reward**: by how much the ball came nearer to its place, m, and 1 more where it rests there.
    Where the cue ball or the ball is caught in a pocket, 1 less.

    **End**: terminated where the ball rests at its place, or cue ball or ball is caught. Truncated
    after 10 shots (`max_episode_steps` of `gymnasium.make`), or where the engine gives a shot up,
    which then moves nothing and earns 0.

    **Info**: `duration` of the shot in s, `first_hit`: the ball that the cue ball hit first, -1.

    The start of an episode depends on the seed and the number of the episode, nothing else.
    """

    def __init__(self, table: TableGiven = 'report', **options: Any) -> None:
        super().__init__(_place(table, **options))


class PotEnv(TaskEnv):
    """``PoolSim/Pot-v0``: pot all balls but the cue ball. One step is one shot.

    Parameters
    ----------
    table : Table or str, optional
        With pockets; or the name of one: '7ft', '8ft', '9ft', 'snooker'.
    speed, starts, threads
        As of `PlaceEnv`.

    Raises
    ------
    ValueError
        Where one of these is out of range; names it.

    Notes
    -----
    **Observation**, float64 of shape (2 n,), m: x and y of each ball, as of `PlaceEnv`.
    **Action**: as of `PlaceEnv`. **Reward**: the number of balls that the shot pots; where the cue
    ball is caught, 1 less. **End**: terminated where no ball but the cue ball is left, or the cue
    ball is caught. Truncated after 30 shots, or as of `PlaceEnv`. **Info**: as of `PlaceEnv`.
    """

    def __init__(self, table: TableGiven = '7ft', **options: Any) -> None:
        super().__init__(_pot(table, **options))


class PlaceVectorEnv(TaskVectorEnv):
    """Many `PlaceEnv` at once; environment i is, bit for bit, a single one of seed ``seed + i``.

    Parameters
    ----------
    num_envs : int
        How many.
    max_episode_steps : int or None, optional
        Shots after which an episode is truncated.
    autoreset_mode : AutoresetMode or str, optional
        'NextStep', 'SameStep' or 'Disabled'.
    table, **options
        As of `PlaceEnv`.

    Raises
    ------
    ValueError
        Where one of these is out of range; names it.
    """

    def __init__(
        self,
        num_envs: int,
        max_episode_steps: int | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        table: TableGiven = 'report',
        **options: Any,
    ) -> None:
        task = _place(table, **options)
        super().__init__(task, num_envs, max_episode_steps, autoreset_mode)


class PotVectorEnv(TaskVectorEnv):
    """Many `PotEnv` at once; as `PlaceVectorEnv`.

    Parameters
    ----------
    num_envs, max_episode_steps, autoreset_mode
        As of `PlaceVectorEnv`.
    table, **options
        As of `PotEnv`.

    Raises
    ------
    ValueError
        Where one of these is out of range; names it.
    """

    def __init__(
        self,
        num_envs: int,
        max_episode_steps: int | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        table: TableGiven = '7ft',
        **options: Any,
    ) -> None:
        task = _pot(table, **options)
        super().__init__(task, num_envs, max_episode_steps, autoreset_mode)
