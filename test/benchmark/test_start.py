"""How long a fresh process takes to its first shot."""

import time
from pathlib import Path

from benchmark.children import run_python

SECTION = 'Starting'
FIRST_SHOT = (
    'from pool_sim_ros.physics import report_table, simulate; simulate(report_table(), (-4.0, 0.0))'
)
NUMBA_ALONE = str(Path(__file__).with_name('numba_alone.py'))
EVERYTHING = (
    'from pool_sim_ros.physics import compile_kernels, report_table;compile_kernels(report_table())'
)


def seconds_of(*command, **environment):
    """Return how long a Python process takes from its start to its end."""
    start = time.perf_counter()
    run_python(*command, **environment)
    return time.perf_counter() - start


def test_warm_cache(results):
    run_python('-c', FIRST_SHOT)
    seconds_of(NUMBA_ALONE)
    seconds, alone = zip(
        *((seconds_of('-c', FIRST_SHOT), seconds_of(NUMBA_ALONE)) for _ in range(11)), strict=True
    )
    what = 'process, imports, first `simulate()`, all compiled before'
    results.add(SECTION, what, seconds, target='500 ms')
    what = 'process, imports of numpy and numba, one function of one line, compiled before'
    results.add(SECTION, what, alone)


def test_cold_cache(results, tmp_path):
    empty = [str(tmp_path / str(k)) for k in range(3)]
    seconds = [seconds_of('-c', FIRST_SHOT, NUMBA_CACHE_DIR=folder) for folder in empty]
    what = 'process, imports, first `simulate()`, nothing compiled yet'
    results.add(SECTION, what, seconds, target='20 s')


def test_cold_cache_for_everything(results, tmp_path):
    seconds = [seconds_of('-c', EVERYTHING, NUMBA_CACHE_DIR=str(tmp_path))]
    results.add(SECTION, 'the same with `compile_kernels()`: every kernel', seconds)
