"""How many shots are shared out among threads."""

import os
import subprocess
import sys
import threading

import pytest

from pool_sim_ros.physics import compile_kernels, cores, report_table, simulate, simulate_many
from pool_sim_ros.physics.cores import available_cores, share_out


def shared(shots, threads):
    """Return the parts that were played, and the threads that did."""
    parts, workers = [], set()

    def play(left):
        for part in left:
            workers.add(threading.current_thread())
            parts.append(part)

    share_out(shots, play, threads)
    return parts, workers


@pytest.mark.parametrize('threads', [1, 2, 3, 50, None])
@pytest.mark.parametrize('shots', [0, 1, 9, 10, 11, 100])
def test_each_shot_is_played_once(shots, threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 10)
    parts, workers = shared(shots, threads)
    played = sorted(shot for part in parts for shot in range(part.start, part.stop))
    assert played == list(range(shots))
    assert all(0 < part.stop - part.start <= 10 for part in parts)
    most = min(threads or available_cores(), max(len(parts), 1))
    assert len(workers) <= most


def test_one_thread_is_the_caller_s():
    assert shared(5, 1)[1] == {threading.current_thread()}


def test_all_threads_take_part(monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    meeting = threading.Barrier(3, timeout=60.0)
    workers = set()

    def play(left):
        meeting.wait()
        workers.add(threading.current_thread())
        list(left)

    share_out(30, play, 3)
    assert len(workers) == 3 and threading.current_thread() in workers


def test_threads_wait_for_the_next_call(monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    meeting = threading.Barrier(2, timeout=60.0)
    workers = []

    def play(left):
        meeting.wait()
        workers.append(threading.current_thread())
        list(left)

    for _ in range(50):
        share_out(10, play, 2)
    # One that has just finished may not wait yet when the next call comes.
    assert len(workers) == 100 and len(set(workers)) < 20


def test_two_callers_at_once_do_not_wait_for_each_other(monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    meeting = threading.Barrier(6, timeout=60.0)  # all threads of both callers

    def play(left):
        meeting.wait()
        list(left)

    callers = [threading.Thread(target=share_out, args=(10, play, 3)) for _ in range(2)]
    for caller in callers:
        caller.start()
    for caller in callers:
        caller.join(60.0)
    assert not any(caller.is_alive() for caller in callers)


AFTER_A_FORK = """
import os, threading
from pool_sim_ros.physics.cores import share_out
def play(left):
    meeting.wait()
    list(left)
meeting = threading.Barrier(2, timeout=60.0)
share_out(10000, play, 2)
child = os.fork()
if not child:
    meeting = threading.Barrier(2, timeout=60.0)
    try:
        share_out(10000, play, 2)
    except threading.BrokenBarrierError:
        os._exit(1)
    os._exit(0)
assert os.waitpid(child, 0)[1] == 0, 'one thread alone'
"""


@pytest.mark.skipif(not hasattr(os, 'fork'), reason='Windows has no fork')
def test_a_fork_has_threads_of_its_own():
    script = [sys.executable, '-W', 'ignore::DeprecationWarning', '-c', AFTER_A_FORK]
    ended = subprocess.run(script, capture_output=True, text=True, timeout=120.0, check=False)
    assert ended.returncode == 0, ended.stderr


@pytest.mark.parametrize('fails', ['caller', 'helper'])
def test_a_fault_in_any_thread_is_raised(fails, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    caller, meeting = threading.current_thread(), threading.Barrier(2, timeout=60.0)

    def play(left):
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
