"""Random shots on the report's table: how many a second, on one core and on two."""

import dataclasses
import time

import pytest
from benchmark.cores import cores
from benchmark.results import per_second
from benchmark.workloads import random_velocities

from pool_sim_ros.physics import report_table, simulate_many

SECTION = "Random shots on the report's table"
SHOTS = 200_000
ROUNDS = 15


@pytest.mark.benchmark(timer=time.thread_time)
@pytest.mark.parametrize(('law', 'target'), [('report', '800,000 shots/s'), ('coulomb', '')])
def test_one_core(time_rounds, results, one_core, law, target):
    table = dataclasses.replace(report_table(), ball_friction=law)
    velocities = random_velocities(SHOTS)
    events = simulate_many(table, velocities)[2].mean()
    seconds = time_rounds(lambda: simulate_many(table, velocities), rounds=ROUNDS)
    what = f'`{law}`, one core; {events:.1f} events a shot'
    results.add(SECTION, what, seconds, per_second(SHOTS, 'shots'), target)


def test_two_cores(results):
    """One core and two in turn, by the clock on the wall."""
    table, velocities = report_table(), random_velocities(SHOTS)
    seconds = {1: [], 2: []}
    for _ in range(ROUNDS):
        for count, times in seconds.items():
            with cores(count):
                start = time.perf_counter()
                simulate_many(table, velocities)
                times.append(time.perf_counter() - start)
    shots = per_second(SHOTS, 'shots')
    results.add(SECTION, '`report`, one core, wall clock', seconds[1], shots, key='one core')
    results.add(SECTION, '`report`, two cores, wall clock', seconds[2], shots, key='two cores')
    results.ratio(SECTION, 'two cores beside one', 'one core', 'two cores', '1.8 times')
