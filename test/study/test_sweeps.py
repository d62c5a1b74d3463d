"""Sweeps from outside: what users call, and what they are told."""

import os
import signal
import subprocess

import numpy as np
import psutil
import pytest
from process_harness import Process
from sweeping import DRAWN, NAMES, TABLE, TEXTS, assert_same_bits
from waiting import wait_until

import pool_sim_ros.study as study
from pool_sim_ros.physics import pool_table, report_table
from pool_sim_ros.study.errors import SweepError
from pool_sim_ros.study.inputs import checked_inputs
from pool_sim_ros.study.plan import checked_plan
from pool_sim_ros.study.store import Store, opened
from pool_sim_ros.study.sweeps import advice, sweep

SHOTS = {'samples': 200, 'seed': 2, 'keep': ['finals', 'failed']}


def test_killed_twice_and_resumed_it_is_the_same(tmp_path):
    """First a worker, then the whole run, by SIGKILL; then another number of workers."""
    out = tmp_path / 'map.zarr'
    record = out / 'record' / 'finished' / 'c'
    args = ['sweep', 'report', str(out), *TEXTS, '--samples', '200', '--seed', '2']
    args += ['--keep', 'finals', 'failed']

    def finished():
        return len(list(record.iterdir())) if record.is_dir() else 0

    with Process('study', *args, '--chunk', '20', '--workers', '2', '--quiet') as run:
        wait_until(lambda: finished() > 5, 'the first regions')
        family = psutil.Process(run.pid).children(recursive=True)
        workers = [p for p in family if 'spawn_main' in ' '.join(p.cmdline())]
        assert len(workers) == 2
        workers[0].kill()
        seen = finished()
        wait_until(lambda: finished() > seen + 5, 'regions after the death of a worker')
        run.signal(signal.SIGKILL)
        run.wait()
    wait_until(lambda: not any(map(_runs, family)), 'the end of all that it started')
    assert 10 < finished() < 300
    found = sweep(TABLE, out=out, workers=0, progress=False, **NAMES, **SHOTS)
    assert_same_bits(found.load(), sweep(TABLE, progress=False, chunk=777, **NAMES, **SHOTS))


def _runs(process):
    try:
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def test_a_disk_that_fills_ends_in_one_line_and_goes_on_later(tmp_path, monkeypatch):
    given = {**NAMES, 'samples': 4, 'chunk': 20, 'progress': False, 'workers': 0}
    plain, left = Store.write, iter(range(3))

    def full(store, region, outcomes):
        if next(left, None) is None:
            raise OSError(28, 'No space left on device')
        plain(store, region, outcomes)

    with monkeypatch.context() as patch:
        patch.setattr(Store, 'write', full)
        with pytest.raises(SweepError, match='^out: the disk of .* is full; .*goes on from there'):
            sweep(TABLE, out=tmp_path / 'a', **given)
    assert opened(tmp_path / 'a').finished().sum() == 3
    found = sweep(TABLE, out=tmp_path / 'a', **given).load()
    assert_same_bits(found, sweep(TABLE, progress=False, samples=4, **NAMES))


def test_a_sweep_that_is_there_is_not_played_again(tmp_path, monkeypatch):
    given = {**NAMES, 'samples': 2, 'out': tmp_path / 'a', 'progress': False}
    sweep(TABLE, workers=0, chunk=50, **given)
    monkeypatch.setattr(Store, 'write', None)
    assert sweep(TABLE, **given).attrs['chunk'] == 50
    with pytest.raises(FileExistsError, match='has chunks of 50 shots, not 60'):
        sweep(TABLE, chunk=60, **given)


@pytest.mark.parametrize(
    ('wrong', 'error', 'said'),
    [
        ({'sped': 1}, ValueError, 'sped: there is no such input'),
        ({'workers': -1, 'out': 'a'}, ValueError, 'workers: -1'),
        ({'workers': 2}, ValueError, 'out: it is missing'),
        ({'scheduler': 'tcp://a:1'}, ValueError, 'out: it is missing'),
        ({'e_ball_ball': 'soft'}, ValueError, 'e_ball_ball: '),
        ({'angle': [1e9, np.nan]}, ValueError, 'angle: nan'),
        ({'speed': 1e7}, ValueError, 'velocities: '),
    ],
)
def test_mistakes_are_told_before_anything_is_made(tmp_path, monkeypatch, wrong, error, said):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error, match=said) as told:
        sweep(TABLE, **{'angle': [0.0, 1.0], 'speed': 2.0, 'progress': False, **wrong})
    assert '\n' not in str(told.value) and not list(tmp_path.iterdir())


def test_a_table_that_is_none():
    with pytest.raises(ValueError, match="table: 'report' must be a Table"):
        sweep('report', angle=[1, 2], speed=1)


def test_progress_and_one_line_of_advice(tmp_path, capsys):
    sweep(TABLE, samples=10, out=tmp_path / 'a', workers=0, chunk=100, **NAMES)
    shown = capsys.readouterr().err
    assert '300 shots in 3 chunks of 100' in shown and '100%' in shown


@pytest.mark.parametrize(
    ('samples', 'chunk', 'workers', 'said'),
    [
        (10**7, 100_000, 2, 'loses those in hand'),
        (10**7, 2_000_000, 2, 'takes less memory'),
        (10**6, 1_000, 2, 'a larger chunk= is faster'),
        (10**6, 500_000, 2, 'chunk=62500 would keep 2 workers busy'),
    ],
)
def test_the_advice_fits_the_sweep(samples, chunk, workers, said):
    inputs = checked_inputs(TABLE, DRAWN)
    plan = checked_plan(TABLE, inputs, None, samples, 0, None, None, chunk)
    assert said in advice(plan, workers) and '\n' not in advice(plan, workers)


@pytest.mark.parametrize('table', [report_table(), pool_table('7ft')], ids=['report', '7ft'])
def test_the_arguments_have_the_same_names_as_the_inputs(table):
    first = sweep(table, velocity=study.polar([170, 180], 2.0), progress=False)
    second = sweep(table, angle=[170, 180], speed=2.0, progress=False)
    assert_same_bits(first, second)
    third = sweep(table, cue=study.cue(2.0, [170, 180]), progress=False)
    assert third.azimuth.attrs['units'] == 'degree'


def test_all_of_it_stays_away_from_other_processes_in_memory(monkeypatch):
    monkeypatch.setattr(os, 'fork', None)
    monkeypatch.setattr(subprocess, 'Popen', None)
    assert sweep(TABLE, progress=False, samples=2, **NAMES).sizes['sample'] == 2
