"""What a long call tells of how far it has come."""

import sys
import threading
import types

import numpy as np
import pytest

from pool_sim_ros.physics import cores, progress, report_table, simulate, simulate_many
from pool_sim_ros.physics.progress import Counter


class Bar:
    """A bar as tqdm has it, which keeps what it is told."""

    def __init__(self, total, **looks):
        self.total, self.told, self.closed = total, [], False

    def update(self, count):
        self.told.append(count)

    def close(self):
        self.closed = True


@pytest.fixture
def bars(monkeypatch):
    """The bars that are shown; tqdm is not needed."""
    shown = []

    def tqdm(total, **looks):
        shown.append(Bar(total, **looks))
        return shown[-1]

    package, auto = types.ModuleType('tqdm'), types.ModuleType('tqdm.auto')
    auto.tqdm = tqdm
    monkeypatch.setitem(sys.modules, 'tqdm', package)
    monkeypatch.setitem(sys.modules, 'tqdm.auto', auto)
    return shown


def test_counts_add_up():
    told = []
    counter = Counter(lambda done, total: told.append((done, total)), 10)
    for count in (3, 0, 5, 2):
        counter.add(count)
    counter.close()
    assert told == [(3, 10), (3, 10), (8, 10), (10, 10)]


@pytest.mark.parametrize('value', [None, False])
def test_nothing_is_shown_where_nobody_asks(value, bars):
    counter = Counter(value, 10)
    counter.add(10)
    counter.close()
    assert bars == []


def test_counts_of_several_threads_add_up():
    told, inside = [], threading.Lock()

    def tell(done, total):
        assert inside.acquire(blocking=False), 'told by two threads at a time'
        told.append(done)
        inside.release()

    counter = Counter(tell, 4000)
    workers = [
        threading.Thread(target=lambda: [counter.add(1) for _ in range(1000)]) for _ in range(4)
    ]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert told == list(range(1, 4001))


def test_a_bar(bars, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 4)
    simulate_many(report_table(), np.full((10, 2), 0.01), progress=True, threads=2)
    (bar,) = bars
    assert bar.total == 10 and sum(bar.told) == 10 and bar.closed


def test_a_bar_is_closed_where_the_call_fails(bars):
    with pytest.raises(ValueError, match='max_events'):
        simulate_many(report_table(), [(-4.0, 0.0)], progress=True, max_events=1)
    assert bars[0].closed


def test_no_bar_without_tqdm(monkeypatch, capfd):
    monkeypatch.setitem(sys.modules, 'tqdm', None)
    monkeypatch.setitem(sys.modules, 'tqdm.auto', None)
    assert progress._bar(1) is None
    outcomes = simulate_many(report_table(), [(-1.0, 0.0)], progress=True)
    assert outcomes.event_counts.tolist() == [1]
    assert capfd.readouterr() == ('', '')


@pytest.mark.parametrize('where', ['caller', 'helper'])
def test_an_exception_in_one_thread_ends_the_call_for_all(where, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 1)
    told, raised = [], threading.Event()

    def tell(done, total):
        told.append(done)
        in_caller = threading.current_thread() is threading.main_thread()
        if in_caller == (where == 'caller'):
            raised.set()
            raise LookupError('enough')

    with pytest.raises(LookupError, match='enough'):
        simulate_many(report_table(), np.full((20_000, 2), 0.01), threads=2, progress=tell)
    assert raised.is_set()
    assert told[-1] < 20_000


def test_who_is_told_may_play_on_the_same_table(monkeypatch):
    """Shots in the caller's thread share its work area with those that are played meanwhile."""
    monkeypatch.setattr(cores, 'CHUNK', 3)
    table, velocities = report_table(), np.random.default_rng(1).normal(size=(20, 2))
    expected = simulate_many(table, velocities).finals.tobytes()

    def play(done, total):
        simulate(table, (-4.0, 0.1 * done), until=0.3)
        simulate_many(table, [(1.0, 0.1 * done)], until=0.2)

    assert simulate_many(table, velocities, progress=play, threads=1).finals.tobytes() == expected
