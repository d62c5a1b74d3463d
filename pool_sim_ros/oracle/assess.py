"""What one aim is worth, from shots of its own."""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.intervals import wilson
from pool_sim_ros.oracle.noise import STROKE
from pool_sim_ros.oracle.plan import Failure, RankedShot
from pool_sim_ros.oracle.trials import Trials
from pool_sim_ros.physics import cue_strike

MOST_FAILURES = 3
"""Outcomes that are told."""


def assess(
    trials: Trials, aim: NDArray[np.float64], shots: int, rng: np.random.Generator
) -> RankedShot:
    """Play an aim, (5,), so many times, each with noise of its own."""
    strokes = trials.executed(np.tile(aim, (shots, 1)), rng.standard_normal((shots, 5)))
    layouts = trials.layouts.draw(shots, rng)
    played = trials.play(strokes, layouts)
    successes = int(played.met.sum())
    missed = Counter(trials.instead(played, layouts)[~played.met].tolist())
    # Equally frequent ones in the order of their words: that of the shots would be no less random.
    frequent = sorted(missed.items(), key=lambda item: (-item[1], item[0]))[:MOST_FAILURES]
    finals, pocketed = played.outcomes.finals, played.outcomes.pocketed
    there = ((pocketed < 0) & (played.outcomes.failed == 0)[:, np.newaxis])[..., np.newaxis]
    count = there.sum(axis=0)
    with np.errstate(invalid='ignore'):
        mean = np.where(there, finals, 0.0).sum(axis=0) / count
        spread = np.sqrt((np.where(there, finals - mean, 0.0) ** 2).sum(axis=0) / count)
    velocity, spin, cue = stroke_of(trials, aim)
    return RankedShot(
        velocity,
        spin,
        cue,
        float(aim[0]),
        float(aim[1]),
        successes / shots,
        *wilson(successes, shots),
        mean,
        spread,
        (pocketed >= 0).mean(axis=0),
        tuple(Failure(words, number / shots) for words, number in frequent),
        shots,
    )


def stroke_of(
    trials: Trials, aim: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64] | None, dict[str, float] | None]:
    """Return velocity, spin and cue of an aim without noise, as a player sends them."""
    if trials.table.motion != 'ball':
        return trials.struck(aim[np.newaxis])[0][0], None, None
    cue = dict(zip(STROKE, aim.tolist(), strict=True))
    return *cue_strike(trials.table, **cue), cue
