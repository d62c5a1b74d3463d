"""Find the best shot of each of the twelve problems with 10^8 shots, and keep its chance.

    python test/benchmark/search_reference.py            writes test/benchmark/search_reference.json

It takes about two minutes of one core a problem; problems that the file has already are left as
they are. It goes from coarse to fine, and shares no code with the search but what plays and judges:

1. 6 x 10^7 executed strokes, spread evenly over speed and azimuth, each on a layout of its own. The
   successes in cells of a quarter of a standard deviation, smoothed by the noise, are the chance of
   every aim: from 4,000 shots or more each.
2. 2 x 10^7: the 2,000 best aims that are at least half a standard deviation apart, 10,000 each.
3. 8 x 10^6: the 40 best of those at least a standard deviation apart climb, twice: 100,000 shots
   from a wider normal, weighted, say which of a grid of 31 x 31 offsets is the best.
4. 8 x 10^6: the 8 best, 10^6 each, choose the reference.
5. 4 x 10^6 fresh ones say its chance, so that it is not flattered.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np  # noqa: E402
from benchmark.search_problems import SPEEDS, passes, problems, true_chance  # noqa: E402
from numpy.typing import NDArray  # noqa: E402
from scipy.ndimage import gaussian_filter  # noqa: E402

from pool_sim_ros.oracle.trials import Trials  # noqa: E402

FILE = Path(__file__).with_suffix('.json')

SWEPT, EACH, CLIMBED, CHOSEN, TOLD = 60_000_000, 10_000, 100_000, 1_000_000, 4_000_000
CELL = 0.25
WIDER = 1.6

Floats = NDArray[np.float64]


def main() -> None:
    """Write what is missing, problem by problem."""
    kept = json.loads(FILE.read_text()) if FILE.exists() else {}
    for problem in problems():
        if problem.name in kept:
            continue
        trials = problem.trials()
        (speed, azimuth), chance = reference(trials)
        kept[problem.name] = {
            'speed': round(speed, 5),
            'azimuth': round(azimuth % 360.0, 5),
            'chance': round(chance, 6),
            'shots': trials.played,
        }
        FILE.write_text(json.dumps(kept, indent=1) + '\n')
        print(problem.name, kept[problem.name], flush=True)


def reference(trials: Trials) -> tuple[Floats, float]:
    """Return the best aim, (2,), and its chance."""
    noise = trials.spread[:2]
    aims = swept(trials, noise)
    best = apart(aims[:20_000], 0.5 * noise, 2000)
    chances = [true_chance(trials, five(aim), EACH, [2]) for aim in best]
    best = apart(best[np.argsort(chances)[::-1]], noise, 40)
    for turn in range(2):
        best = np.array([climbed(trials, noise, aim, [3, turn, k]) for k, aim in enumerate(best)])
    chances = [true_chance(trials, five(aim), EACH, [4]) for aim in best]
    best = best[np.argsort(chances)[::-1][:8]]
    chances = [true_chance(trials, five(aim), CHOSEN, [5]) for aim in best]
    winner = best[int(np.argmax(chances))]
    return winner, true_chance(trials, five(winner), TOLD, [6])


def swept(trials: Trials, noise: Floats) -> Floats:
    """Return aims in the middle of cells, (k, 2), best first."""
    low, high = max(SPEEDS[0] - 4.0 * noise[0], 0.0), SPEEDS[1] + 4.0 * noise[0]
    edges = [
        np.linspace(low, high, int((high - low) / (CELL * noise[0])) + 1),
        np.linspace(0.0, 360.0, int(360.0 / (CELL * noise[1])) + 1),
    ]
    rng, counts = np.random.default_rng(1), 0.0
    for count in passes(SWEPT):
        strokes = np.zeros((count, 5))
        strokes[:, 0], strokes[:, 1] = rng.uniform(low, high, count), rng.uniform(0, 360, count)
        met = trials.play(strokes, trials.layouts.draw(count, rng)).met
        counts = counts + np.histogram2d(strokes[met, 0], strokes[met, 1], edges)[0]
    steps = [edge[1] - edge[0] for edge in edges]
    chances = gaussian_filter(counts, noise / steps, mode=('constant', 'wrap'))
    middles = [edge[:-1] + 0.5 * step for edge, step in zip(edges, steps, strict=True)]
    chances[(middles[0] < SPEEDS[0]) | (middles[0] > SPEEDS[1])] = 0.0
    order = np.argsort(-chances, axis=None)[:200_000]
    rows, columns = np.unravel_index(order, chances.shape)
    return np.stack([middles[0][rows], middles[1][columns]], axis=-1)


def apart(aims: Floats, distance: Floats, most: int) -> Floats:
    """Return the first so many aims that are so far from all before them."""
    chosen = np.empty((0, 2))
    for aim in aims:
        if len(chosen) == most:
            break
        if (np.hypot(*((chosen - aim) / distance).T) >= 1.0).all():
            chosen = np.vstack([chosen, aim])
    return chosen


def climbed(trials: Trials, noise: Floats, aim: Floats, seed: list[int]) -> Floats:
    """Return the best aim within 1.5 standard deviations, (2,)."""
    rng = np.random.default_rng(seed)
    normals = rng.standard_normal((CLIMBED, 5))
    normals[:, :2] *= WIDER
    strokes = trials.executed(five(aim), normals)
    hits = normals[trials.play(strokes, trials.layouts.draw(CLIMBED, rng)).met][:, :2]
    steps = np.linspace(-1.5, 1.5, 31)
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    wide = np.exp(0.5 / WIDER**2 * (hits**2).sum(axis=1))
    chances = [np.exp(-0.5 * ((hits - offset) ** 2).sum(axis=1)) @ wide for offset in grid]
    best = aim + noise * grid[int(np.argmax(chances))]
    return np.array([np.clip(best[0], *SPEEDS), best[1]])


def five(aim: Floats) -> Floats:
    """Return the five numbers of a stroke."""
    return np.array([*aim, 0.0, 0.0, 0.0])


if __name__ == '__main__':
    main()
