"""Many tables as one environment of gymnasium: a step is one call of `simulate_many`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from pool_sim_ros.study.checks import checked_actions, counted
from pool_sim_ros.study.seats import Seats
from pool_sim_ros.study.spaces import action_space, observation_space
from pool_sim_ros.study.tasks import Task, Turn

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Seed = int | Sequence[int | None] | None


class TaskVectorEnv(VectorEnv[Floats, Floats, NDArray[Any]]):
    """A task on many tables; `PlaceVectorEnv` and `PotVectorEnv` say what it is.

    Bit for bit what gymnasium's `SyncVectorEnv` makes of as many single ones.
    """

    def __init__(
        self,
        task: Task,
        num_envs: int,
        max_episode_steps: int | None,
        autoreset_mode: AutoresetMode | str,
    ) -> None:
        num_envs = counted('num_envs', num_envs)
        if max_episode_steps is not None:
            max_episode_steps = counted('max_episode_steps', max_episode_steps)
        self.num_envs = num_envs
        try:
            self._mode = AutoresetMode(autoreset_mode)
        except ValueError:
            known = ', '.join(repr(mode.value) for mode in AutoresetMode)
            raise ValueError(f'autoreset_mode: {autoreset_mode!r} must be one of {known}') from None
        self.metadata = {'render_modes': [], 'autoreset_mode': self._mode}
        self.single_observation_space = observation_space(task)
        self.single_action_space = action_space(task)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._seats = Seats(task, num_envs)
        self._most = max_episode_steps
        self._shots = np.zeros(num_envs, np.int64)
        self._over = np.zeros(num_envs, bool)
        self._any_over = self._has_begun = False

    def reset(
        self, *, seed: Seed = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Begin an episode in all environments, or in those of ``options['reset_mask']``.

        Parameters
        ----------
        seed : int or sequence of int or None, optional
            Environment i gets ``seed + i``, or the i-th.
        options : dict, optional
            ``reset_mask``: ndarray of shape (num_envs,), bool.

        Returns
        -------
        observations : ndarray of shape (num_envs, k)
            m.
        infos : dict
            Empty.

        Raises
        ------
        ValueError
            For a seed or a mask that is none.
        """
        chosen = self._chosen(options)
        seeds = self._seeds(seed)
        if seeds is None and not self._has_begun:
            super().reset(seed=None)
            seeds = self._seeds_from(self.np_random_seed or 0)
        if seeds is not None:
            given = np.array([k for k in chosen if seeds[k] is not None], np.int64)
            self._seats.seed(given, [seeds[k] for k in given])
        self._has_begun = True
        self._begin(chosen)
        self._over[chosen] = False
        self._any_over = bool(self._over.any())
        return self._seats.observations(), {}

    def step(self, actions: Floats) -> tuple[Floats, Floats, Flags, Flags, dict[str, Any]]:
        """Play one shot on each table.

        Parameters
        ----------
        actions : array_like of shape (num_envs, 2), where balls spin (num_envs, 4)
            Each -1 to 1.

        Returns
        -------
        observations : ndarray of shape (num_envs, k)
            m.
        rewards : ndarray of shape (num_envs,)
            As of the single environment.
        terminated, truncated : ndarray of shape (num_envs,)
            Whether each episode has ended, or was cut.
        infos : dict of ndarray
            As gymnasium's `SyncVectorEnv` has them.

        Raises
        ------
        ValueError
            For actions of another shape, or that are not finite; then nothing is played.
        ResetNeeded
            Before the first reset, and with `DISABLED` where an episode is over.
        """
        if not self._has_begun:
            raise ResetNeeded('no episode has begun: call reset()')
        given = checked_actions(actions, self.action_space.shape)
        asleep = None
        if self._any_over:
            if self._mode is AutoresetMode.DISABLED:
                raise ResetNeeded(
                    f'environment {int(self._over.argmax())} is at its end: call '
                    "reset(options={'reset_mask': ...})"
                )
            asleep = self._over.nonzero()[0]
            self._begin(asleep)
            # The step on which an episode begins is not one of its shots.
            self._shots[asleep] = -1
        turn = self._seats.play(given, asleep)
        self._shots += 1
        rewards, terminated, truncated = turn.rewards, turn.ended, turn.failed
        if self._most is not None:
            truncated = self._shots >= self._most
            truncated |= turn.failed
        if asleep is not None:
            rewards[asleep] = 0.0
            terminated[asleep] = truncated[asleep] = False
        infos = self._infos(turn, asleep)
        over = terminated | truncated
        self._any_over = bool(over.any())
        self._over = over
        if self._any_over and self._mode is AutoresetMode.SAME_STEP:
            infos = self._begin_anew(over, infos)
        return self._seats.observations(), rewards, terminated, truncated, infos

    def _begin(self, chosen: NDArray[np.int64]) -> None:
        self._seats.begin(chosen)
        self._shots[chosen] = 0

    def _infos(self, turn: Turn, asleep: NDArray[np.int64] | None) -> dict[str, Any]:
        """Return what gymnasium makes of the infos of single environments."""
        duration, first_hit = turn.outcomes.durations, turn.outcomes.first_hit
        there = np.ones(self.num_envs, bool)
        if asleep is not None:
            if len(asleep) == self.num_envs:
                return {}
            # A table on which nothing moves has a duration of 0.
            there[asleep], first_hit[asleep] = False, 0
        return {
            'duration': duration,
            '_duration': there,
            'first_hit': first_hit,
            '_first_hit': there.copy(),
        }

    def _begin_anew(self, over: Flags, infos: dict[str, Any]) -> dict[str, Any]:
        """Begin episodes where others are over, and put their ends into the infos."""
        ends = np.full(self.num_envs, None, dtype=object)
        seen = self._seats.observations()
        rows = np.flatnonzero(over)
        for row in rows:
            ends[row] = seen[row].copy()
        last: dict[str, Any] = {}
        goes_on: dict[str, Any] = {}
        for name in ('duration', 'first_hit'):
            value = infos[name]
            last[name] = np.where(over, value, 0).astype(value.dtype)
            last[f'_{name}'] = over.copy()
            if not over.all():
                value[over] = 0
                goes_on[name], goes_on[f'_{name}'] = value, ~over
        self._begin(rows)
        self._any_over = False
        self._over = np.zeros(self.num_envs, bool)
        return goes_on | {
            'final_obs': ends,
            '_final_obs': over.copy(),
            'final_info': last,
            '_final_info': over.copy(),
        }

    def _chosen(self, options: dict[str, Any] | None) -> NDArray[np.int64]:
        if options is not None and not isinstance(options, dict):
            raise ValueError(f'options: {options!r} must be a dict')
        mask = (options or {}).get('reset_mask')
        if mask is None:
            return np.arange(self.num_envs)
        right = isinstance(mask, np.ndarray) and mask.dtype == np.bool_
        if not right or mask.shape != (self.num_envs,) or not mask.any():
            raise ValueError(
                f'reset_mask: must be an array of {self.num_envs} bool, of which one is True'
            )
        if not self._has_begun and not mask.all():
            raise ValueError('reset_mask: no episode has begun yet; reset all environments first')
        return np.flatnonzero(mask)

    def _seeds(self, seed: Seed) -> list[Any] | None:
        if seed is None:
            return None
        if not isinstance(seed, (Sequence, np.ndarray)) or isinstance(seed, str):
            first = counted('seed', seed, 0)
            super().reset(seed=first)
            return self._seeds_from(first)
        if len(seed) != self.num_envs:
            raise ValueError(f'seed: {len(seed)} seeds must be {self.num_envs}')
        seeds = [each if each is None else counted('seed', each, 0) for each in seed]
        if self._has_begun:
            return seeds
        others = self._seeds_from(self.np_random_seed or 0)
        return [others[k] if each is None else each for k, each in enumerate(seeds)]

    def _seeds_from(self, first: int) -> list[Any]:
        return [first + k for k in range(self.num_envs)]
