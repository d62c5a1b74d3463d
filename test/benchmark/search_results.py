"""Compare what searches find with the best shots of `search_reference.json`.

    python test/benchmark/search_results.py            twelve problems with four seeds each
    python test/benchmark/search_results.py --quick --write docs/oracle.md

For every run the true chance of the best shot is counted from a million fresh shots, or 100,000
with --quick, and divided by that of the reference. Prints a table, or writes it between the marks.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np  # noqa: E402
from benchmark.cma_search import cma_search  # noqa: E402
from benchmark.results import write_between_marks  # noqa: E402
from benchmark.search_problems import Problem, problems, true_chance  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

from pool_sim_ros.oracle import find_shots  # noqa: E402

REFERENCE = Path(__file__).with_name('search_reference.json')

MARKS = '<!-- searches: begin -->', '<!-- searches: end -->'

HALF_A_SECOND, A_FIFTH = 330_000, 130_000
"""Shots that one core of the machine in docs/benchmarks.md plays in 0.5 s and 0.2 s."""

SEEDS = 4

Search = Callable[[Problem, int, int], NDArray[np.float64]]


def ours(problem: Problem, shots: int, seed: int) -> NDArray[np.float64]:
    """Return the best aim of `find_shots`, (5,)."""
    plan = find_shots(problem.table, problem.goal, problem.noise, shots, seed, threads=1)
    aim = np.zeros(5)
    if plan:
        aim[:2] = plan[0].speed, plan[0].azimuth
    return aim


RUNS: tuple[tuple[str, Search, int], ...] = (
    ('`find_shots`', ours, HALF_A_SECOND),
    ('`find_shots`', ours, A_FIFTH),
    ('CMA-ES with restarts', cma_search, HALF_A_SECOND),
    ('CMA-ES with restarts', cma_search, 4 * HALF_A_SECOND),
)


def main() -> None:
    """Print or write the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--quick', action='store_true', help='100,000 fresh shots of each')
    parser.add_argument('--write', type=Path, metavar='FILE', help='between the marks of this file')
    options = parser.parse_args()
    truth = 100_000 if options.quick else 1_000_000
    lines = [
        '',
        '| search | shots | s of one core | median | worst | at least 0.98 | at least 0.9 |',
        '| --- | ---: | ---: | ---: | ---: | ---: | ---: |',
    ]
    for name, search, shots in RUNS:
        ratios, seconds = compared(search, shots, truth)
        lines.append(
            f'| {name} | {shots:,} | {np.median(seconds):.2f} | {np.median(ratios):.3f} '
            f'| {ratios.min():.3f} | {100 * (ratios >= 0.98).mean():.0f} % '
            f'| {100 * (ratios >= 0.9).mean():.0f} % |'
        )
        print(lines[-1], flush=True)
    table = '\n'.join([*lines, ''])
    if options.write is not None:
        write_between_marks(options.write, table, MARKS)


def compared(
    search: Search, shots: int, truth: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return true chances over the reference's, and s of processor time, run by run."""
    reference = json.loads(REFERENCE.read_text())
    ratios, seconds = [], []
    for problem in problems():
        row = []
        for seed in range(SEEDS):
            begin = time.process_time()
            aim = search(problem, shots, seed)
            seconds.append(time.process_time() - begin)
            chance = true_chance(problem.trials(), aim, truth, [9, seed])
            row.append(chance / reference[problem.name]['chance'])
        print(f'{problem.name:24s}', ' '.join(f'{ratio:.3f}' for ratio in row), flush=True)
        ratios += row
    return np.array(ratios), np.array(seconds)


if __name__ == '__main__':
    main()
