"""Moves an aim to the best place near it, from one set of shots.

Shots from a wider normal, weighted by importance, give the chance of every aim nearby.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.space import FINEST, Space
from pool_sim_ros.oracle.trials import Trials

WIDER = 1.6
"""Standard deviations of the shots in that of the noise: the weights stay below 3 a dimension."""

OFFSETS = 256
"""Aims nearby that are compared."""

FARTHEST = 1.5
"""Standard deviations between an aim and those."""


def climb(
    trials: Trials, space: Space, aim: NDArray[np.float64], shots: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Return the best aim near one, (5,), from so many shots."""
    columns = space.searched
    noise = trials.spread.copy()
    noise[columns] = np.maximum(noise[columns], FINEST[columns])
    normals = rng.standard_normal((shots, 5))
    normals[:, columns] *= WIDER
    strokes = trials.executed(np.tile(aim, (shots, 1)), normals, noise)
    met = trials.play(strokes, trials.layouts.draw(shots, rng)).met
    if not met.any():
        return aim
    near = offsets(len(columns), rng)
    best = near[np.argmax(chances(normals[met][:, columns], near))]
    moved = aim.copy()
    moved[columns] += noise[columns] * best
    return space.within(moved)


def chances(successes: NDArray[np.float64], near: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the chance of each offset, (k,), up to a common factor.

    Parameters
    ----------
    successes : ndarray of shape (m, d)
        Where the shots fell that met the goal, in standard deviations from the aim. They are drawn
        from a normal `WIDER` than the noise.
    near : ndarray of shape (k, d)
        Offsets from the aim in standard deviations.
    """
    wide = -0.5 * (1.0 - 1.0 / WIDER**2) * (successes**2).sum(axis=1)
    weights = np.exp(near @ successes.T + wide - 0.5 * (near**2).sum(axis=1)[:, np.newaxis])
    return np.asarray(weights.sum(axis=1))


def offsets(dimensions: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return offsets that fill a ball evenly, (k, d), the first of them 0."""
    directions = rng.standard_normal((OFFSETS, dimensions))
    directions /= np.linalg.norm(directions, axis=1)[:, np.newaxis]
    radii = FARTHEST * (np.arange(OFFSETS) / OFFSETS) ** (1.0 / dimensions)
    return np.asarray(directions * radii[:, np.newaxis])
