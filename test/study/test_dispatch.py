"""Sweeps over tcp:// on a scheduler and workers in processes of their own."""

import errno
import threading

import pytest
from dask_processes import dask_processes
from sweeping import NAMES, TABLE, assert_same_bits
from waiting import wait_until

from pool_sim_ros.study import dispatch
from pool_sim_ros.study.errors import SweepError
from pool_sim_ros.study.store import opened
from pool_sim_ros.study.sweeps import sweep

GIVEN = {**NAMES, 'seed': 2, 'progress': False}


@pytest.fixture(scope='module')
def cluster(tmp_path_factory):
    with dask_processes(tmp_path_factory.mktemp('dask'), 2) as started:
        yield started


def test_the_same_bits_as_in_one_process(cluster, tmp_path):
    out = tmp_path / 'a.zarr'
    found = sweep(TABLE, samples=10, out=out, chunk=30, scheduler=cluster[0], **GIVEN).load()
    assert_same_bits(found, sweep(TABLE, samples=10, **GIVEN))


def test_a_worker_that_cannot_write_is_told_in_one_line(cluster, tmp_path):
    out = tmp_path / 'a.zarr'
    sweep(TABLE, samples=10, out=out, chunk=100, workers=0, **GIVEN)
    (out / 'record' / 'finished' / 'c' / '1').unlink()
    folder = out / 'durations' / 'c' / '10'
    for path in sorted((out / 'durations').rglob('*'), reverse=True):
        if path.name != 'zarr.json':
            path.unlink() if path.is_file() else path.rmdir()
    (out / 'durations' / 'c').write_text('a file where a folder must be')
    assert not folder.exists()
    with pytest.raises(SweepError, match='^out: .* cannot be written.*goes on from there') as told:
        sweep(TABLE, samples=10, out=out, scheduler=cluster[0], **GIVEN)
    assert '\n' not in str(told.value)


@pytest.mark.parametrize(
    ('count', 'threads', 'largest'),
    [(0, 2, 0), (1, 2, 1), (40, 2, 2), (100, 2, 4), (1000, 3, 4), (100, 64, 1)],
)
def test_tasks_have_each_region_once_and_grow_small_towards_the_end(count, threads, largest):
    numbers = list(range(7, 7 + count))
    tasks = list(dispatch.batches(numbers, threads))
    assert [number for task in tasks for number in task] == numbers
    sizes = [len(task) for task in tasks]
    assert sizes == sorted(sizes, reverse=True) and set(sizes[-threads:]) <= {1}
    assert max(sizes, default=0) == largest


class Gone:
    """A future of a scheduler that is gone, or of a task that failed."""

    def __init__(self, status, error=None):
        self.status, self._error = status, error

    def exception(self):
        return self._error


@pytest.mark.parametrize(
    ('future', 'said'),
    [
        (Gone('cancelled'), "scheduler: 'tcp://a:1' is gone"),
        (Gone('lost'), "scheduler: 'tcp://a:1' is gone"),
        (Gone('error', OSError(errno.ENOSPC, 'full')), 'out: the disk of'),
        (Gone('error', SweepError('another folder')), '^another folder$'),
    ],
)
def test_a_task_that_failed_says_why(future, said, tmp_path):
    store = type('Store', (), {'path': tmp_path})
    with pytest.raises(SweepError, match=said):
        dispatch.check(future, 'tcp://a:1', store)


@pytest.mark.parametrize('address', ['tcp://127.0.0.1:9', 'nonsense', 'http://x'])
def test_a_scheduler_that_is_not_there(tmp_path, monkeypatch, address):
    monkeypatch.setattr('pool_sim_ros.oracle.cluster.CONNECT', '0.5s')
    with pytest.raises(SweepError, match='^scheduler: .* does not answer') as told:
        sweep(TABLE, out=tmp_path / 'a', samples=2, scheduler=address, **GIVEN)
    assert '\n' not in str(told.value)


def test_a_scheduler_that_dies_in_between(cluster, tmp_path):
    """The last of this module: it kills the scheduler."""
    address, (scheduler, *_) = cluster
    out, given = tmp_path / 'a.zarr', {**GIVEN, 'samples': 1000}
    told = []

    def run():
        try:
            sweep(TABLE, out=out, chunk=20, scheduler=address, **given)
        except SweepError as error:
            told.append(str(error))

    thread = threading.Thread(target=run)
    thread.start()
    record = out / 'record' / 'finished' / 'c'
    wait_until(lambda: record.is_dir() and len(list(record.iterdir())) > 10, 'the first regions')
    scheduler.kill()
    thread.join()
    assert len(told) == 1 and 'is gone' in told[0] and '\n' not in told[0]
    assert 10 < opened(out).finished().sum() < 1500
