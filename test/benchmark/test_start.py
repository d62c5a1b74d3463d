"""How long a fresh process takes to its first shot."""

import time

from benchmark.children import run_python

SECTION = 'Starting'
FIRST_SHOT = (
    'from pool_sim_ros.physics import report_table, simulate; simulate(report_table(), (-4.0, 0.0))'
)
EVERYTHING = (
    'from pool_sim_ros.physics import compile_kernels, report_table;compile_kernels(report_table())'
)


def seconds_of(command, **environment):
    """Return how long a Python process takes from its start to its end."""
    start = time.perf_counter()
    run_python('-c', command, **environment)
    return time.perf_counter() - start


def test_warm_cache(results):
    run_python('-c', FIRST_SHOT)
    seconds = [seconds_of(FIRST_SHOT) for _ in range(11)]
    what = 'process, imports, first `simulate()`, all compiled before'
    results.add(SECTION, what, seconds, target='500 ms')


def test_cold_cache(results, tmp_path):
    seconds = [seconds_of(FIRST_SHOT, NUMBA_CACHE_DIR=str(tmp_path / str(k))) for k in range(3)]
    what = 'process, imports, first `simulate()`, nothing compiled yet'
    results.add(SECTION, what, seconds, target='20 s')


def test_cold_cache_for_everything(results, tmp_path):
    seconds = [seconds_of(EVERYTHING, NUMBA_CACHE_DIR=str(tmp_path))]
    results.add(SECTION, 'the same with `compile_kernels()`: every kernel', seconds)
