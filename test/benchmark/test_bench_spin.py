"""Balls that spin: shots a second and what an event costs, beside discs and beside pooltool."""

import statistics
import time

import numpy as np
import pytest
from benchmark.cores import cores
from benchmark.results import as_time, per_second, significant
from benchmark.spin_workloads import (
    FIFTEEN,
    NAMES,
    NINE,
    REPORT,
    TEN,
    TEN_WITH_POCKETS,
    shots_of,
    strikes,
    table_of,
)
from benchmark.workloads import random_velocities

from pool_sim_ros.physics import report_table, simulate_many

SECTION = 'Balls that spin, one core'
ROUNDS = 15
COUNTS = {REPORT: 20_000, TEN: 5_000, TEN_WITH_POCKETS: 5_000, NINE: 400, FIFTEEN: 400}
TO_POOLTOOL = {REPORT: 40, TEN: 40, TEN_WITH_POCKETS: 40, NINE: 6, FIFTEEN: 3}
DISC_SHOTS = 50_000
DISC_RATE = 2.0e6
"""Shots/s of discs on the machine that the targets in shots/s are for."""

TARGETS = {
    REPORT: ('1/7 of the discs', '1.3 times', ''),
    TEN: ('1/4.5 of the discs', '1.3 times', '1,000 times'),
    TEN_WITH_POCKETS: ('1/5.5 of the discs', '1.3 times', '1,500 times'),
    NINE: ('40,000/s where discs make 2.0 M', '2 times', '1,200 times'),
    FIFTEEN: ('30,000/s where discs make 2.0 M', '2 times', '1,200 times'),
}


class Call:
    """One call of `simulate_many`, and what its shots and events took, s."""

    def __init__(self, table, given):
        self.table, self.given = table, given
        self.shots = len(given['velocities'])
        self.events = simulate_many(table, **given).event_counts.mean()
        self.seconds = []

    def play(self, clock=time.thread_time, threads=1):
        start = clock()
        simulate_many(self.table, threads=threads, **self.given)
        self.seconds.append((clock() - start) / self.shots)

    def beside(self, other):
        """Return how many times longer a shot took than one of `other` in the same round."""
        pairs = zip(self.seconds, other.seconds, strict=True)
        return statistics.median(own / others for own, others in pairs)


@pytest.fixture(scope='module')
def calls():
    """Every workload and the discs, in turn and on one core: one round of all after the other."""
    found = {'discs': Call(report_table(), dict(velocities=random_velocities(DISC_SHOTS)))}
    for name in NAMES:
        given = strikes(shots_of(name, COUNTS[name]))
        if name == REPORT:
            del given['positions']
        found[name] = Call(table_of(name), given)
    with cores(1):
        for _ in range(ROUNDS):
            for call in found.values():
                call.play()
    return found


@pytest.mark.parametrize('name', ['discs', *NAMES])
def test_shots_and_events(results, calls, name):
    call, discs = calls[name], calls['discs']
    results.add(
        SECTION,
        f'{name}; {call.events:.1f} events a shot',
        call.seconds,
        per_second(1, 'shots'),
        key=f'spin: {name}',
    )
    results.note(
        SECTION, f'{name}, an event', as_time(statistics.median(call.seconds) / call.events)
    )
    if name == 'discs':
        return
    per_shot = call.beside(discs)
    rate, per_event, _ = TARGETS[name]
    share = f'1/{significant(per_shot, 3)}; {significant(DISC_RATE / per_shot, 3)}/s at 2.0 M'
    results.note(SECTION, f'{name}, shots/s beside the discs', share, rate)
    ratio = per_shot * discs.events / call.events
    what = f'{name}, an event beside one of the discs'
    results.note(SECTION, what, f'{significant(ratio, 3)} times', per_event)


@pytest.mark.parametrize('name', NAMES)
def test_beside_pooltool(results, pooltool, calls, one_core, name):
    """The first shots of each workload, with the same models."""
    table, shots = table_of(name), shots_of(name, TO_POOLTOOL[name])
    seconds = pooltool.play_balls(table, shots, rounds=4)['seconds'][1:]
    theirs = statistics.median(seconds) / TO_POOLTOOL[name]
    # So often that the call itself counts for nothing; no shot twice in a row, which a processor
    # would learn.
    given = {key: np.concatenate([values] * 200) for key, values in strikes(shots).items()}
    call = Call(table, given)
    for _ in range(ROUNDS):
        call.play()
    ours = statistics.median(call.seconds)
    results.note(SECTION, f'pooltool, {name}', f'{significant(1 / theirs, 3)} shots/s')
    what = f'{name}, beside pooltool'
    results.note(SECTION, what, f'{significant(theirs / ours, 3)} times', TARGETS[name][2])


def test_two_cores(results):
    call = {count: Call(table_of(REPORT), strikes(shots_of(REPORT, 100_000))) for count in (1, 2)}
    for _ in range(ROUNDS):
        for count, each in call.items():
            with cores(count):
                each.play(time.perf_counter, threads=count)
    value = f'{significant(call[1].beside(call[2]), 3)} times'
    results.note(SECTION, f'{REPORT}, two cores beside one, wall clock', value, '1.8 times')
