"""How many shots are shared out among threads."""

import os
import threading

import pytest

from pool_sim_ros.physics import compile_kernels, cores, report_table, simulate, simulate_many
from pool_sim_ros.physics.cores import available_cores, share_out


def shared(shots, threads):
    """Return the parts that were played, the threads that did, and what they were told."""
    parts, workers, told = [], set(), []

    def play(left, others):
        told.append(others)
        for part in left:
            workers.add(threading.current_thread())
            parts.append(part)

    share_out(shots, play, threads)
    return parts, workers, told


@pytest.mark.parametrize('threads', [1, 2, 3, 50, None])
@pytest.mark.parametrize('shots', [0, 1, 9, 10, 11, 100])
def test_each_shot_is_played_once(shots, threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 10)
    parts, workers, told = shared(shots, threads)
    played = sorted(shot for part in parts for shot in range(part.start, part.stop))
    assert played == list(range(shots))
    assert all(0 < part.stop - part.start <= 10 for part in parts)
    most = min(threads or available_cores(), max(len(parts), 1))
    assert len(workers) <= most
    assert len(told) == most
    assert told == [most > 1] * most


def test_one_thread_is_the_caller_s():
    assert shared(5, 1)[1] == {threading.current_thread()}


def test_all_threads_take_part(monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    meeting = threading.Barrier(3, timeout=60.0)
    workers = set()

    def play(left, others):
        meeting.wait()
        workers.add(threading.current_thread())
        list(left)

    share_out(30, play, 3)
    assert len(workers) == 3 and threading.current_thread() in workers


@pytest.mark.parametrize('fails', ['caller', 'helper'])
def test_a_fault_in_any_thread_is_raised(fails, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    caller, meeting = threading.current_thread(), threading.Barrier(2, timeout=60.0)

    def play(left, others):
        meeting.wait()
        if (threading.current_thread() is caller) == (fails == 'caller'):
            raise LookupError('lost')

    with pytest.raises(LookupError, match='lost'):
        share_out(10, play, 2)


def test_available_cores(monkeypatch):
    monkeypatch.setattr(os, 'sched_getaffinity', lambda process: {0, 3, 7}, raising=False)
    assert available_cores() == 3


def refuse(process):
    raise PermissionError('a sandbox')


@pytest.mark.parametrize('call', [None, refuse], ids=['missing', 'refused'])
@pytest.mark.parametrize(('count', 'expected'), [(8, 8), (None, 1)])
def test_available_cores_where_the_system_does_not_tell_a_process_s_own(
    count, expected, call, monkeypatch
):
    if call is None:
        monkeypatch.delattr(os, 'sched_getaffinity', raising=False)
    else:
        monkeypatch.setattr(os, 'sched_getaffinity', call, raising=False)
    monkeypatch.setattr(os, 'cpu_count', lambda: count)
    assert available_cores() == expected


def test_shots_are_shared_out_where_linux_is_missing(monkeypatch):
    """As on macOS and Windows, whose os module lacks these names."""
    for name in ('sched_getaffinity', 'sched_setaffinity'):
        monkeypatch.delattr(os, name, raising=False)
    monkeypatch.setattr(cores, 'CHUNK', 2)
    table = report_table()
    compile_kernels(table)
    velocities = [(-1.0, 0.1 * k) for k in range(5)]
    many = simulate_many(table, velocities)
    for velocity, finals in zip(velocities, many.finals, strict=True):
        assert (simulate(table, velocity).final_positions == finals).all()
