"""Find the best shot of each of the twelve problems with 10^8 shots, and keep its chance.

    python test/benchmark/search_reference.py            writes test/benchmark/search_reference.json
    python test/benchmark/search_reference.py --part 0.1      the same with a tenth of the shots

It takes about two minutes of one core a problem; what the file has from as many shots already is
left as it is. It goes from coarse to fine, and shares no code with the search but what plays and
judges. With all shots:

1. 6 x 10^7 executed strokes, anywhere in speed and azimuth with equal density, layouts at random
   among 200,000. The successes in cells of a quarter of a standard deviation, smoothed by the
   noise, are the chance of every aim: each from some 4,000 shots.
2. 2 x 10^7: the 2,000 best aims that are at least half a standard deviation apart, 10,000 each.
3. 8 x 10^6: the 40 best of those at least a standard deviation apart climb, twice: 100,000 shots
   from a wider normal, weighted, say which of a grid of 31 x 31 offsets is the best.
4. 8 x 10^6: the 8 best, 10^6 each, choose the reference.
5. 4 x 10^6 fresh ones say its chance, so that it is not flattered.
"""

from __future__ import annotations

import argparse
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
LAYOUTS = 200_000
CELL = 0.25
WIDER = 1.6

Floats = NDArray[np.float64]


def main() -> None:
    """Write what is missing, problem by problem."""
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--part', type=float, default=1.0, help='of all shots (default: 1)')
    part = parser.parse_args().part
    kept = json.loads(FILE.read_text()) if FILE.exists() else {}
    for problem in problems():
        if problem.name in kept and kept[problem.name]['shots'] > 0.9e8 * part:
            continue
        trials = problem.trials()
        (speed, azimuth), chance = reference(trials, part)
        kept[problem.name] = {
            'speed': round(float(speed), 5),
            'azimuth': round(float(azimuth) % 360.0, 5),
            'chance': round(chance, 6),
            'shots': trials.played,
        }
        FILE.write_text(json.dumps(kept, indent=1) + '\n')
        print(problem.name, kept[problem.name], flush=True)


def reference(trials: Trials, part: float) -> tuple[Floats, float]:
    """Return the best aim, (2,), and its chance."""
    noise = trials.spread[:2]
    each, climbing, choosing, telling = (
        int(part * shots) for shots in (EACH, CLIMBED, CHOSEN, TOLD)
    )
    best = apart(swept(trials, noise, int(part * SWEPT)), 0.5 * noise, 2000)
    chances = [true_chance(trials, five(aim), each, [2]) for aim in best]
    best = apart(best[np.argsort(chances)[::-1]], noise, 40)
    for turn in range(2):
        best = np.array(
            [climbed(trials, noise, aim, climbing, [3, turn, k]) for k, aim in enumerate(best)]
        )
    chances = [true_chance(trials, five(aim), each, [4]) for aim in best]
    best = best[np.argsort(chances)[::-1][:8]]
    chances = [true_chance(trials, five(aim), choosing, [5]) for aim in best]
    winner = best[int(np.argmax(chances))]
    return winner, true_chance(trials, five(winner), telling, [6])


def swept(trials: Trials, noise: Floats, shots: int) -> Floats:
    """Return the 20,000 best aims in the middle of cells, best first."""
    low, high = max(SPEEDS[0] - 4.0 * noise[0], 0.0), SPEEDS[1] + 4.0 * noise[0]
    edges = [
        np.linspace(low, high, int((high - low) / (CELL * noise[0])) + 1),
        np.linspace(0.0, 360.0, int(360.0 / (CELL * noise[1])) + 1),
    ]
    rng, counts = np.random.default_rng(1), 0.0
    layouts = trials.layouts.draw(LAYOUTS, rng)
    for count in passes(shots):
        strokes = np.zeros((count, 5))
        strokes[:, 0], strokes[:, 1] = rng.uniform(low, high, count), rng.uniform(0, 360, count)
        first = int(rng.integers(LAYOUTS - count + 1))
        met = trials.play(strokes, layouts[first : first + count]).met
        counts = counts + np.histogram2d(strokes[met, 0], strokes[met, 1], edges)[0]
    steps = [edge[1] - edge[0] for edge in edges]
    chances = gaussian_filter(counts, noise / steps, mode=('constant', 'wrap'))
    middles = [edge[:-1] + 0.5 * step for edge, step in zip(edges, steps, strict=True)]
    chances[(middles[0] < SPEEDS[0]) | (middles[0] > SPEEDS[1])] = 0.0
    rows, columns = np.unravel_index(
        np.argsort(-chances, axis=None, kind='stable')[:20_000], chances.shape
    )
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


def climbed(trials: Trials, noise: Floats, aim: Floats, shots: int, seed: list[int]) -> Floats:
    """Return the best aim within 1.5 standard deviations, (2,)."""
    rng = np.random.default_rng(seed)
    normals = rng.standard_normal((shots, 5))
    normals[:, :2] *= WIDER
    strokes = trials.executed(five(aim), normals)
    hits = normals[trials.play(strokes, trials.layouts.draw(shots, rng)).met][:, :2]
    lines = [
        middle + sd * np.linspace(-1.5, 1.5, 31) for middle, sd in zip(aim, noise, strict=True)
    ]
    lines[0] = np.clip(lines[0], *SPEEDS)
    factors = [
        np.exp(-0.5 * ((line[:, np.newaxis] - aim[k]) / noise[k] - hits[:, k]) ** 2)
        for k, line in enumerate(lines)
    ]
    wide = np.exp(0.5 / WIDER**2 * (hits**2).sum(axis=1))
    row, column = divmod(int(np.argmax((factors[0] * wide) @ factors[1].T)), len(lines[1]))
    return np.array([lines[0][row], lines[1][column]])


def five(aim: Floats) -> Floats:
    """Return the five numbers of a stroke."""
    return np.array([*aim, 0.0, 0.0, 0.0])


if __name__ == '__main__':
    main()
