"""CMA-ES as a search for the best shot, with restarts: what `find_shots` is compared with."""

from __future__ import annotations

import cma
import numpy as np
from benchmark.search_problems import SPEEDS, Problem
from numpy.typing import NDArray

EACH = 64
"""Shots that say what an aim is worth."""

POPULATION, GENERATIONS = 16, 30
"""Aims in a generation, and generations before a restart, at most."""

STEP = 0.15
"""First standard deviation of the aims, as a part of all speeds and of all azimuths."""

LAST = 0.1
"""Of the shots, what chooses among the ends of the runs."""


def cma_search(problem: Problem, shots: int, seed: int) -> NDArray[np.float64]:
    """Return the best aim, (5,), that so many shots find."""
    trials = problem.trials()
    rng = np.random.default_rng(seed)

    def chances(aims: NDArray[np.float64], each: int) -> NDArray[np.float64]:
        """Return the chance of each aim, (k, 2) from 0 to 1, from shots with common noise."""
        normals = np.tile(rng.standard_normal((each, 5)), (len(aims), 1))
        layouts = trials.layouts.draw(each, rng)
        strokes = trials.executed(np.repeat(strokes_of(aims), each, axis=0), normals)
        if layouts is not None:
            layouts = np.tile(layouts, (len(aims), 1, 1))
        return np.asarray(trials.play(strokes, layouts).met.reshape(len(aims), each).mean(axis=1))

    ends = []
    while trials.played < (1.0 - LAST) * shots:
        options = {
            'bounds': [[0.0, -np.inf], [1.0, np.inf]],
            'popsize': POPULATION,
            'maxiter': GENERATIONS,
            'seed': int(rng.integers(1, 2**31)),
            'verbose': -9,
        }
        strategy = cma.CMAEvolutionStrategy(rng.random(2), STEP, options)
        while not strategy.stop() and trials.played < (1.0 - LAST) * shots:
            aims = strategy.ask()
            strategy.tell(aims, (-chances(np.array(aims), EACH)).tolist())
        ends.append(np.clip(strategy.mean, [0.0, -np.inf], [1.0, np.inf]))
    found = np.array(ends)
    # The better half plays again, more often, until one is left.
    while len(found) > 1:
        rounds = int(np.ceil(np.log2(len(found))))
        left = max(shots - trials.played, 0)
        each = max(left // (rounds * len(found)), EACH)
        found = found[np.argsort(-chances(found, each), kind='stable')[: (len(found) + 1) // 2]]
    return np.asarray(strokes_of(found)[0])


def strokes_of(aims: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the strokes, (k, 5), of aims, (k, 2), whose numbers go from 0 to 1."""
    strokes = np.zeros((len(aims), 5))
    strokes[:, 0] = SPEEDS[0] + aims[:, 0] * (SPEEDS[1] - SPEEDS[0])
    strokes[:, 1] = 360.0 * aims[:, 1] % 360.0
    return strokes
