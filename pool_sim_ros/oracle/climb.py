"""Moves aims to the best places near them, and finds the best of them.

Shots from a wider normal, weighted by importance, give the chance of every aim nearby. All shots
that were played round an aim count: an aim that moves keeps those from before.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.space import FINEST, Space
from pool_sim_ros.oracle.trials import Trials

WIDER = 1.6
"""Standard deviations of the shots in that of the noise: the weights stay below 3 a dimension."""

REACHES = (1.2, 0.4)
"""Standard deviations between an aim and the ends of a grid of aims nearby; then between the best
of those and the ends of a finer one."""

POINTS = {2: 17, 4: 5}
"""Of such a grid in each dimension, by the number of dimensions."""

ROUNDS = ((8, 1), (4, 2), (2, 4), (2, 4))
"""Aims that climb, and parts of the shots that each gets."""

DIFFERENT = 2.0
"""Standard deviations between two shots of an answer: closer ones are the same shot."""


class Climber:
    """An aim and all shots that were played round it.

    Parameters
    ----------
    trials : Trials
    space : Space
    aim : ndarray of shape (5,)
        Where it begins.
    """

    def __init__(self, trials: Trials, space: Space, aim: NDArray[np.float64]) -> None:
        self.trials, self.space, self.begin = trials, space, aim
        columns = space.searched
        self.noise = trials.spread.copy()
        self.noise[columns] = np.maximum(self.noise[columns], FINEST[columns])
        self.place = np.zeros(len(columns))
        self.chance = 0.0
        self.centres: list[tuple[NDArray[np.float64], int]] = []
        self.successes = np.empty((0, len(columns)))

    @property
    def aim(self) -> NDArray[np.float64]:
        """Where it is, (5,)."""
        return self.space.within(self._away(self.place))

    def climb(self, shots: int, rng: np.random.Generator) -> None:
        """Play so many shots and move to the best aim nearby."""
        columns = self.space.searched
        normals = rng.standard_normal((shots, 5))
        normals[:, columns] *= WIDER
        centre = np.tile(self._away(self.place), (shots, 1))
        strokes = self.trials.executed(centre, normals, self.noise)
        met = self.trials.play(strokes, self.trials.layouts.draw(shots, rng)).met
        self.successes = np.concatenate([self.successes, self.place + normals[met][:, columns]])
        self.centres.append((self.place, shots))
        weights = importance(self.successes, self.centres)
        for reach in REACHES:
            axes = self._axes(reach)
            found = chances(self.successes, weights, axes)
            places = np.stack(np.meshgrid(*axes, indexing='ij'), axis=-1).reshape(-1, len(axes))
            found[~self._allowed(places)] = 0.0
            best = int(np.argmax(found))
            if found[best] > 0.0:
                self.place, self.chance = places[best], float(found[best])

    def _away(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the aims, (..., 5), at places in standard deviations from the beginning."""
        aims = np.broadcast_to(self.begin, (*places.shape[:-1], 5)).copy()
        aims[..., self.space.searched] += self.noise[self.space.searched] * places
        return aims

    def _axes(self, reach: float) -> list[NDArray[np.float64]]:
        """Return the lines of the grid round the place, from slow to fast not beyond the speeds."""
        points = POINTS[len(self.place)]
        axes = [middle + reach * np.linspace(-1.0, 1.0, points) for middle in self.place]
        slow, fast = (np.array(self.space.speeds) - self.begin[0]) / self.noise[0]
        axes[0] = np.clip(axes[0], slow, fast)
        return axes

    def _allowed(self, places: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return at which places, (k, d), the tip is in the space."""
        tips = self._away(places)[:, 3:]
        return np.asarray(np.hypot(*tips.T) <= self.space.offset + 1e-12)


def climb_best(
    trials: Trials,
    space: Space,
    aims: NDArray[np.float64],
    budget: tuple[int, int],
    seed: int,
    late: Callable[[], bool],
) -> NDArray[np.float64]:
    """Return where the best aims climb, (k, 5), best first.

    In each round fewer climb, and each plays more shots.

    Parameters
    ----------
    trials : Trials
    space : Space
    aims : ndarray of shape (k, 5)
        Best first.
    budget : (int, int)
        Shots to play, and aims that are wanted.
    seed : int
    late : callable
        Asked after each round.
    """
    shots, wanted = budget
    climbers = [Climber(trials, space, aim) for aim in aims]
    climbers = different(climbers, trials, space)[: max(ROUNDS[0][0], wanted)]
    part = shots / sum(most * parts for most, parts in ROUNDS)
    left: list[Climber] = []
    for number, (most, parts) in enumerate(ROUNDS):
        if number > 0:
            left, climbers = climbers[most:] + left, climbers[:most]
        each = max(int(part * parts), 64)
        for k, climber in enumerate(climbers):
            climber.climb(each, np.random.default_rng([seed, 4, number, k]))
        climbers.sort(key=lambda climber: -climber.chance)
        climbers = different(climbers, trials, space)
        if late():
            break
    ranked = different(climbers + left, trials, space)
    return np.array([climber.aim for climber in ranked[:wanted]])


def different(climbers: list[Climber], trials: Trials, space: Space) -> list[Climber]:
    """Return the climbers, best first, without those in the place of a better one."""
    apart = DIFFERENT * np.maximum(trials.spread, FINEST)
    aims = np.array([climber.aim for climber in climbers])
    kept = space.distinct(aims, np.arange(len(aims)), len(aims), apart)
    return [climbers[k] for k in kept]


def importance(
    successes: NDArray[np.float64], centres: list[tuple[NDArray[np.float64], int]]
) -> NDArray[np.float64]:
    """Return how many shots were played per volume where each success fell, inverted, (m,).

    Parameters
    ----------
    successes : ndarray of shape (m, d)
        In standard deviations.
    centres : list of (ndarray of shape (d,), int)
        Of the normals, `WIDER` than the noise, that the shots are from; and how many were.
    """
    density = np.zeros(len(successes))
    for centre, shots in centres:
        away = ((successes - centre) ** 2).sum(axis=1)
        density += shots * np.exp(-0.5 / WIDER**2 * away)
    scale = WIDER ** successes.shape[1]
    return np.asarray(scale / density)


def chances(
    successes: NDArray[np.float64],
    weights: NDArray[np.float64],
    axes: list[NDArray[np.float64]],
) -> NDArray[np.float64]:
    """Return the chance of each aim of a grid: how much of its noise falls on successes.

    Parameters
    ----------
    successes : ndarray of shape (m, d)
        Where the shots fell that met the goal, in standard deviations.
    weights : ndarray of shape (m,)
        Of each, as `importance` returns them.
    axes : list of ndarray of shape (p,)
        The lines of the grid in each of the d dimensions, which are even in number.

    Returns
    -------
    ndarray of shape (p^d,)
        The last dimension varies fastest.
    """
    # A normal of d dimensions is a product of d: so two matrices do, instead of p^d exponentials.
    factors = [
        np.exp(-0.5 * (axis[:, np.newaxis] - successes[:, k]) ** 2) for k, axis in enumerate(axes)
    ]
    half = len(axes) // 2
    first, second = together(factors[:half]), together(factors[half:])
    return np.asarray((first * weights) @ second.T).ravel()


def together(factors: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return the products of all rows of some matrices, (p^k, m), from k of (p, m)."""
    result = factors[0]
    for factor in factors[1:]:
        result = (result[:, np.newaxis] * factor).reshape(-1, factor.shape[1])
    return result
