"""A sweep of ten million shots: killed twice, resumed, in bounded memory, and how fast it grows."""

import os
import signal
import time

import numpy as np
import psutil
import pytest
from dask_processes import dask_processes
from process_harness import Process
from sweeping import DRAWN, TABLE
from waiting import wait_until

from pool_sim_ros.study.datasets import open_sweep
from pool_sim_ros.study.store import opened
from pool_sim_ros.study.sweeps import sweep

SHOTS = int(os.environ.get('SWEEP_SHOTS', 10_000_000))
TEXTS = ['angle=uniform(150,210)', 'speed=uniform(1,4)', '--samples', str(SHOTS), '--seed', '3']
MOST_MEMORY = 400 * 2**20
STEP = 100_000


def workers_of(process):
    family = psutil.Process(process.pid).children(recursive=True)
    return [p for p in family if lives(p) and 'spawn_main' in ' '.join(p.cmdline())]


def lives(process):
    """Whether a process runs: it may be gone by now, or wait for somebody to ask how it ended."""
    try:
        return process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def assert_equal_files(one, other):
    """Compare part by part: neither fits in memory."""
    first, second = open_sweep(one), open_sweep(other)
    assert set(first.variables) == set(second.variables)
    for name in first.data_vars:
        for start in range(0, SHOTS, 10 * STEP):
            part = slice(start, start + 10 * STEP)
            left, right = (each[name].isel(sample=part).values for each in (first, second))
            assert left.tobytes() == right.tobytes(), (name, start)
    assert (first.failed.values == 0).all() and np.isfinite(first.durations.values).all()


@pytest.mark.soak
def test_killed_and_resumed_it_is_the_one_made_in_one_go(tmp_path):
    out, whole, over_tcp = (tmp_path / name for name in ('a.zarr', 'b.zarr', 'c.zarr'))
    record, most = out / 'record' / 'finished' / 'c', 0
    regions = SHOTS // STEP
    args = ['sweep', 'report', str(out), *TEXTS, '--workers', '2', '--quiet', '--chunk', str(STEP)]

    def finished():
        nonlocal most
        for worker in workers:
            if lives(worker):
                most = max(most, worker.memory_info().rss)
        return len(list(record.iterdir())) if record.is_dir() else 0

    workers = []
    with Process('study', *args) as run:
        wait_until(lambda: finished() > regions // 5, 'a fifth')
        workers = workers_of(run)
        workers[0].kill()
        wait_until(lambda: finished() > 2 * regions // 5, 'two fifths')
        workers = workers_of(run)
        run.signal(signal.SIGKILL)
        run.wait()
    half = finished()
    assert 2 * regions // 5 < half < regions
    start = time.perf_counter()
    with Process('study', *args) as run:
        wait_until(lambda: len(workers_of(run)) == 2, 'the workers')
        workers = workers_of(run)
        main = psutil.Process(run.pid)
        while lives(main):
            finished()
            time.sleep(0.1)
        assert run.wait() == 0, run.stderr
    seconds = time.perf_counter() - start
    print(f'\n{(regions - half) * STEP / seconds:,.0f} shots/s with the start of the cluster')
    print(f'a worker has {most / 2**20:.0f} MiB at most')
    assert most < MOST_MEMORY
    print_growth(out)
    sweep(TABLE, out=whole, workers=1, chunk=70_001, samples=SHOTS, seed=3, progress=False, **DRAWN)
    assert_equal_files(out, whole)
    with dask_processes(tmp_path, 2) as (address, _):
        given = {'samples': SHOTS, 'seed': 3, 'progress': False, **DRAWN}
        sweep(TABLE, out=over_tcp, scheduler=address, chunk=50_000, **given)
    assert_equal_files(out, over_tcp)


def print_growth(out):
    """Say what ten times as many shots would take: time of a region, and bytes of a shot."""
    files = (out / 'record' / 'finished' / 'c').iterdir()
    times = np.sort([file.stat().st_mtime for file in files])
    steps = np.diff(times[len(times) // 2 :])
    first, last = steps[: len(steps) // 2].mean(), steps[len(steps) // 2 :].mean()
    size = sum(file.stat().st_size for file in out.rglob('*') if file.is_file())
    shots = len(opened(out).finished()) * STEP
    print(f'a region every {first:.3f} s, later {last:.3f} s; {size / shots:.1f} bytes a shot')
    print(f'10^8 shots: {1e8 / STEP * last / 60:.1f} min, {1e8 * size / shots / 2**30:.1f} GiB')
