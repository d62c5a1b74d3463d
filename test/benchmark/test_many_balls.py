"""What a collision costs as the table grows, its density kept; processor time of one core."""

import time

import numpy as np
import pytest
from benchmark.results import per_second, significant
from benchmark.workloads import dense_table, dense_velocities

from pool_sim_ros.physics import simulate, simulate_many

SECTION = 'Many balls, everything moving, one core'
COUNTS = (16, 64, 256, 1024, 4000, 32_000)
UNTIL = 0.2
"""s: about ten collisions for each ball, and few that come to rest."""

COLLISIONS = 300_000
"""About how many a round has: enough balls, or enough shots."""

TARGETS = {('decelerating', 4000): '600,000', ('decelerating', 32_000): '450,000'}

pytestmark = [
    pytest.mark.usefixtures('one_core'),
    pytest.mark.benchmark(timer=time.thread_time),
]


@pytest.mark.parametrize('count', COUNTS)
@pytest.mark.parametrize('kind', ['frictionless', 'decelerating'])
def test_collisions_per_second(time_rounds, results, kind, count):
    table = dense_table(count, decelerating=kind == 'decelerating')
    velocities = dense_velocities(count, max(COLLISIONS // (5 * count), 1))
    collisions = sum(count_collisions(table, shot) for shot in velocities)
    seconds = time_rounds(lambda: simulate_many(table, velocities, until=UNTIL), rounds=7)
    target = TARGETS.get((kind, count), '')
    results.add(
        SECTION,
        f'{kind}, n = {count}; {2 * collisions / velocities[..., 0].size:.1f} collisions a ball',
        seconds,
        per_second(collisions, 'collisions'),
        target and f'{target} collisions/s',
    )
    results.medians[f'{kind}, {count}'] = float(np.median(seconds)) / collisions


def count_collisions(table, velocities):
    """Return how many contacts with balls and cushions a shot has; stops do not count."""
    return int(np.sum(simulate(table, velocities, until=UNTIL).events['kind'] != 2))


@pytest.mark.parametrize('kind', ['frictionless', 'decelerating'])
def test_growth(results, kind):
    costs = [results.medians.get(f'{kind}, {count}') for count in COUNTS]
    if None in costs:
        pytest.skip('not all sizes were measured')
    value = f'{significant(max(costs) / min(costs), 3)} times'
    results.note(SECTION, f'{kind}, dearest beside cheapest', value, '2 times')
