"""What planners ask of `simulate_many` beside the plain call: layouts, events, single shots."""

import time

import numpy as np
import pytest
from benchmark.results import per_second
from benchmark.workloads import random_velocities

from pool_sim_ros.physics import report_table, simulate_many

SECTION = "Planners' calls on the report's table, one core"
SHOTS = 100_000
ROUNDS = 15
CAMERA = 1e-3
"""Standard deviation of the positions that a camera reports, m."""

pytestmark = [pytest.mark.usefixtures('one_core')]


def random_layouts(table, count, seed=4):
    """Return layouts, (count, n, 2) in m, each with all balls anywhere that they may lie."""
    rng = np.random.default_rng(seed)
    radii, size = table.radii, np.array([table.length, table.width])
    margin = radii[:, np.newaxis]
    layouts = rng.uniform(margin, size - margin, (count, len(radii), 2))
    while True:
        gaps = np.linalg.norm(layouts[:, :, np.newaxis] - layouts[:, np.newaxis], axis=3)
        gaps[:, np.arange(len(radii)), np.arange(len(radii))] = np.inf
        bad = (gaps < radii + margin).any(axis=(1, 2))
        if not bad.any():
            return layouts
        layouts[bad] = rng.uniform(margin, size - margin, (bad.sum(), len(radii), 2))


def test_in_turn(results):
    """All kinds of call in turn, in processor time, so that their ratios hold."""
    table, velocities = report_table(), random_velocities(SHOTS)
    own = np.repeat(table.positions[np.newaxis], SHOTS, axis=0)
    seen = own + np.random.default_rng(3).normal(0.0, CAMERA, own.shape)
    anywhere = random_layouts(table, 2000)[np.arange(SHOTS) % 2000]
    calls = {
        'one layout': {},
        'a layout for each shot': {'positions': own},
        'the same, each with the noise of a camera, 1 mm': {'positions': seen},
        'the same, balls anywhere': {'positions': anywhere},
        'all events kept': {'events': True},
    }
    seconds = {what: [] for what in calls}
    for _ in range(ROUNDS + 1):
        for what, options in calls.items():
            start = time.thread_time()
            simulate_many(table, velocities, errors='mark', threads=1, **options)
            seconds[what].append(time.thread_time() - start)
    for what, times in seconds.items():
        results.add(SECTION, what, times[1:], per_second(SHOTS, 'shots'), key=what)
    # The other layouts make other shots, which are no measure of what layouts cost.
    for what, target in (('a layout for each shot', '0.95'), ('all events kept', '0.7')):
        ratio = f'{what}, speed beside one layout'
        results.ratio(SECTION, ratio, 'one layout', what, f'{target} times')


def test_a_call_of_one_shot(results):
    table, velocity = report_table(), [(-4.0, 0.0)]
    simulate_many(table, velocity)
    seconds = []
    for _ in range(2000):
        start = time.thread_time()
        simulate_many(table, velocity)
        seconds.append(time.thread_time() - start)
    results.add(SECTION, '`simulate_many` for shot 1 alone', seconds)
