"""The report's four shots on one core, in processor time: exact, in slices, and with pooltool."""

import statistics
import time

import numpy as np
import pytest
from benchmark import unskipped
from benchmark.ask_pooltool import ENGINES
from benchmark.workloads import report_velocities

from pool_sim_ros.physics import report_table, simulate, simulate_many

SECTION = "The report's four shots, one core"
REPEATS = 1000

pytestmark = [
    pytest.mark.usefixtures('one_core'),
    pytest.mark.benchmark(timer=time.thread_time),
]


@pytest.fixture(scope='module')
def table():
    return report_table()


@pytest.fixture(scope='module')
def velocities():
    return report_velocities()


def test_exact_in_one_call(time_rounds, results, table, velocities):
    shots = np.tile(velocities, (REPEATS, 1))
    seconds = time_rounds(lambda: simulate_many(table, shots), rounds=100)
    what = f'exact, `simulate_many`, {len(shots)} shots in one call'
    results.add(SECTION, what, [s / REPEATS for s in seconds], key='exact')


def test_exact_one_by_one(time_rounds, results, table, velocities):
    def play():
        for velocity in velocities:
            simulate(table, velocity)

    seconds = time_rounds(play, rounds=1000)
    results.add(SECTION, 'exact, `simulate()`, trajectories included', seconds, key='simulate')


def test_the_longest_shot(time_rounds, results, table, velocities):
    seconds = time_rounds(lambda: simulate(table, velocities[0]), rounds=1000)
    what = 'exact, `simulate()`, shot 1 alone (24 events)'
    results.add(SECTION, what, seconds, target='10 us where 97539c6 took 29')


def test_time_slices(time_rounds, results, table, velocities):
    def play():
        for velocity in velocities:
            simulate(table, velocity, integrator='time_slice', time_slice=1e-6)

    seconds = time_rounds(play, rounds=7)
    results.add(SECTION, '`time_slice`, 1e-6 s', seconds, key='time_slice')


def test_unskipped_loop(time_rounds, results, table, velocities):
    def play():
        for velocity in velocities:
            unskipped.play(table, velocity, 1e-6)

    seconds = time_rounds(play, rounds=7)
    what = "the report's loop compiled, nothing skipped, 1e-6 s"
    results.add(SECTION, what, seconds, key='unskipped')


@pytest.mark.parametrize('engine', ENGINES)
def test_pooltool(results, pooltool, table, velocities, engine):
    answer = pooltool.play(table, velocities, rounds=60, engine=engine)
    assert [shot['error'] for shot in answer['shots']] == [None] * len(velocities)
    seconds = answer['seconds'][len(answer['seconds']) // 3 :]  # the first ones warm up
    models = {'nearest': 'the models nearest to ours', 'default': 'its default models'}[engine]
    results.add(SECTION, f'pooltool, {models}', seconds, key=f'pooltool, {engine}')
    results.medians['pooltool'] = min(
        results.medians.get('pooltool', np.inf), statistics.median(seconds)
    )


def test_ratios(results):
    many, single = 'exact (`simulate_many`)', 'exact (`simulate()`)'
    results.ratio(SECTION, f'{many} beside pooltool', 'pooltool', 'exact', '2500 times')
    results.ratio(SECTION, f'{single} beside pooltool', 'pooltool', 'simulate')
    results.ratio(SECTION, f'{many} beside the loop', 'unskipped', 'exact', '100 000 times')
    results.ratio(SECTION, '`time_slice` beside the loop', 'unskipped', 'time_slice', '2 times')
