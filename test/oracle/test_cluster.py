"""Shots on a Dask cluster, whose scheduler and workers are processes of their own."""

import numpy as np
import pytest

pytest.importorskip('distributed')

from rclpy.parameter import Parameter  # noqa: E402

from pool_sim_ros.oracle import Cluster, ClusterError, find_shots, what_if  # noqa: E402
from pool_sim_ros.oracle.cluster import PART, joined, parts  # noqa: E402
from pool_sim_ros.physics import pool_table, report_table, simulate_many  # noqa: E402
from pool_sim_ros.study.local_cluster import local_cluster  # noqa: E402

TABLE = report_table()
GOAL = {'ball': '9', 'to': [0.3, 0.2], 'within': 0.3}


@pytest.fixture(scope='module')
def address():
    with local_cluster(2) as address:
        yield address


@pytest.fixture(scope='module')
def cluster(address):
    cluster = Cluster(address)
    yield cluster
    cluster.close()


def velocities(count):
    return np.random.default_rng(count).normal(0.0, 2.0, (count, 2))


def assert_equal(found, expected):
    for name, here, there in zip(expected._fields, expected, found, strict=True):
        if here is None:
            assert there is None
        else:
            assert np.array_equal(here, there, equal_nan=here.dtype.kind == 'f'), name


@pytest.mark.parametrize('events', [False, True])
def test_what_if_has_the_same_bits(cluster, events):
    rows = velocities(2 * PART + 1)
    assert_equal(
        what_if(TABLE, rows, events=events, cluster=cluster), what_if(TABLE, rows, events=events)
    )


def test_each_shot_has_its_own_layout_and_spin(cluster):
    table, count = pool_table('7ft'), PART + 100
    rng = np.random.default_rng(2)
    layouts = np.tile(table.positions, (count, 1, 1))
    layouts[:, 0] += rng.normal(0.0, 0.01, (count, 2))
    rows = np.hstack([velocities(count), rng.normal(0.0, 30.0, (count, 3))])
    assert_equal(
        what_if(table, rows, positions=layouts, cluster=cluster),
        what_if(table, rows, positions=layouts),
    )


def test_a_plan_is_the_same(cluster):
    search = dict(table=TABLE, goal=GOAL, noise='fastfiz', shots=20_000, seed=3)
    here, there = find_shots(**search), find_shots(**search, cluster=cluster)
    assert len(here) > 0 and here.played == there.played
    for one, other in zip(here, there, strict=True):
        assert np.array_equal(one.velocity, other.velocity) and one.chance == other.chance


def test_what_is_wrong_with_a_shot_is_told_as_here(cluster):
    rows = velocities(10)
    rows[3, 0] = np.nan
    with pytest.raises(ValueError, match='velocities: nan is not finite'):
        what_if(TABLE, rows, cluster=cluster)


def test_a_scheduler_that_is_not_there_is_told(monkeypatch):
    monkeypatch.setattr('pool_sim_ros.oracle.cluster.CONNECT', '1s')
    with pytest.raises(ClusterError, match="^scheduler: 'tcp://127.0.0.1:9' does not answer: "):
        Cluster('tcp://127.0.0.1:9')
    with pytest.raises(ClusterError, match="^scheduler: 'nonsense' does not answer: "):
        Cluster('nonsense')


def test_one_without_workers_is_told(monkeypatch):
    monkeypatch.setattr('pool_sim_ros.oracle.cluster.LOOK_PERIOD', 0.3)
    with local_cluster(0) as address:
        cluster = Cluster(address)
        with pytest.raises(ClusterError, match='^scheduler: .* has no workers$'):
            what_if(TABLE, velocities(10), cluster=cluster)
        cluster.close()


@pytest.mark.soak
def test_one_that_goes_is_told():
    """Dask waits some seconds for it to come back."""
    with local_cluster(1) as address:
        cluster = Cluster(address)
        assert len(what_if(TABLE, velocities(10), cluster=cluster).finals) == 10
    with pytest.raises(ClusterError, match='^scheduler: .* is gone$'):
        what_if(TABLE, velocities(10), cluster=cluster)
    cluster.close()


def test_the_node_plays_there(address, domain):
    from oracle_harness import hall

    scheduler = Parameter('scheduler', value=address)
    with hall(domain, [scheduler], report_integrator='event') as room:
        rows = velocities(PART + 10)
        found, expected = room.ask(rows), what_if(TABLE, rows)
        assert np.array_equal(found.finals, expected.finals)
        plan = room.plan(GOAL, shots=3000, seed=4, count=2)
    best = find_shots(TABLE, GOAL, 'fastfiz', shots=3000, seed=4, count=2)[0]
    assert plan['shots'][0]['velocity'] == best.velocity.tolist()


@pytest.mark.parametrize('events', [False, True])
def test_parts_are_joined_as_one(events):
    rows = velocities(100)
    cuts = [rows[:1], rows[1:40], rows[40:]]
    found = [simulate_many(TABLE, cut, events=events) for cut in cuts]
    assert_equal(joined(found), simulate_many(TABLE, rows, events=events))
    assert [part.stop - part.start for part in parts(2 * PART + 1)] == [PART, PART, 1]
