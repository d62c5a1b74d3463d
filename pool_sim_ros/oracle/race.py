"""Many aims, of which ever fewer are played ever more often.

All aims of a round get the same noise, so that luck decides little between them. After each round
every aim moves towards what succeeded.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.sequences import sobol_normals
from pool_sim_ros.oracle.space import FINEST, Space
from pool_sim_ros.oracle.trials import Trials

ROUNDS = ((256, 64), (64, 256), (24, 768))
"""Aims, and shots of each, at the budget of `SHOTS`."""

SHOTS = sum(aims * shots for aims, shots in ROUNDS)

STEP = 2.0
"""Times the way to the mean of what succeeded that an aim moves. The best of 1 to 3."""


def race(
    trials: Trials,
    space: Space,
    peaks: tuple[NDArray[np.float64], NDArray[np.float64]],
    shots: int,
    seed: int,
    late: Callable[[], bool],
) -> NDArray[np.float64]:
    """Return the aims that are left, (k, 5), best first.

    Parameters
    ----------
    trials : Trials
    space : Space
    peaks : tuple of ndarray
        Aims, (k, 5), best first, and how widely each was smoothed, (k, 2).
    shots : int
        To be played in all rounds.
    seed : int
    late : callable
        Asked after each round.
    """
    aims, wide = peaks
    noise = np.maximum(trials.spread, np.where(np.isin(np.arange(5), space.searched), FINEST, 0.0))
    widths = np.tile(noise, (len(aims), 1))
    for number, (most, each) in enumerate(ROUNDS):
        order = np.arange(len(aims))[:most]
        if number > 0:  # peaks of the map are apart already
            order = space.distinct(aims, np.arange(len(aims)), most, noise)
        aims, wide, widths = aims[order], wide[order], widths[order]
        # Where the map was smoothed more than the noise does, the noise shrinks round by round.
        share = 1.0 - (number + 1.0) / len(ROUNDS)
        widths[:, :2] = noise[:2] * (wide / noise[:2]) ** share
        count = max(8, each * shots // SHOTS)
        met, normals = common(trials, aims, count, [seed, 3, number], widths)
        successes = met.sum(axis=1)
        towards = (met @ normals) / np.maximum(successes, 1)[:, np.newaxis]
        moves = np.zeros_like(aims)
        moves[:, space.searched] = (STEP * widths * towards)[:, space.searched]
        order = np.argsort(-successes, kind='stable')
        aims = space.within(aims + moves)[order]
        wide, widths = wide[order], widths[order]
        if late():
            break
    return aims


def common(
    trials: Trials,
    aims: NDArray[np.float64],
    count: int,
    seed: list[int],
    widths: NDArray[np.float64] | None = None,
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Play each of the aims, (k, 5), with the same noise.

    Returns
    -------
    met : ndarray of bool, (k, count)
        Whether each shot met the goal.
    normals : ndarray of shape (count, 5)
        The noise, in standard deviations.
    """
    rng = np.random.default_rng(seed)
    normals = sobol_normals(count, rng)
    layouts = trials.layouts.draw(count, rng)
    spread = trials.spread if widths is None else widths[:, np.newaxis]
    strokes = trials.executed(aims[:, np.newaxis], normals, spread).reshape(-1, 5)
    if layouts is not None:
        layouts = np.tile(layouts, (len(aims), 1, 1))
    return trials.play(strokes, layouts).met.reshape(len(aims), count), normals
