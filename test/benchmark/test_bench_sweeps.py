"""Sweeps on two local workers beside `simulate_many` on two threads, with shots of the same kind.

`simulate_many` gets velocities that are there, and `out`. The workers get what a sweep gives them:
they draw the same inputs for other shots, and write to files that are new.
"""

import itertools
import shutil
import statistics
import time

import numpy as np
import pytest
from benchmark.results import per_second, significant

from pool_sim_ros.physics import report_table, simulate_many
from pool_sim_ros.study.ranges import uniform

distributed = pytest.importorskip('distributed')
pytest.importorskip('zarr')

from pool_sim_ros.study import region_task  # noqa: E402
from pool_sim_ros.study.dispatch import batches  # noqa: E402
from pool_sim_ros.study.inputs import checked_inputs  # noqa: E402
from pool_sim_ros.study.local_cluster import local_cluster  # noqa: E402
from pool_sim_ros.study.plan import checked_plan  # noqa: E402
from pool_sim_ros.study.store import created  # noqa: E402

SECTION = 'Sweeps, two workers'
ROUNDS, CALLS, REGIONS = 4, 16, 6
"""A round is so many calls of `simulate_many` with the shots of so many regions; a sweep of as many
shots takes so long that its begin and its end count as little as in the sweeps that need workers.
"""

TARGETS = {'played': '0.85', 'played and written': '0.70'}


def test_shots_beside_simulate_many(results, tmp_path):
    table = report_table()
    inputs = checked_inputs(table, {'angle': uniform(0, 360), 'speed': uniform(0.5, 4)})
    regions = 2 * (ROUNDS + 1) * CALLS * REGIONS
    plan = checked_plan(table, inputs, None, regions * 100_000, 0, None, None, 100_000)
    store = created(tmp_path / 'a.zarr', plan)
    where = str(store.path), store.identity
    velocities = []
    for k in range(REGIONS):
        angle, speed = (plan.values(name, plan.region(k)) for name in ('angle', 'speed'))
        angle = np.radians(angle)
        velocities.append(np.stack([speed * np.cos(angle), speed * np.sin(angle)], axis=1))
    velocities = np.concatenate(velocities)
    out = simulate_many(table, velocities, threads=2)
    numbers, shots = itertools.count(), CALLS * len(velocities)
    with local_cluster(2) as address, distributed.Client(address, set_as_default=False) as client:

        def play_only(path, identity, numbers):
            """What `play_regions` does, but for the writing; in here, so that it goes by value."""
            store, player = region_task._open(path, identity)
            regions = [store.plan.region(number) for number in numbers]
            return sum(len(player.play(region)['failed']) for region in regions)

        def plain():
            for _ in range(CALLS):
                simulate_many(table, velocities, threads=2, out=out)

        def run(task, *more):
            chosen = list(itertools.islice(numbers, CALLS * REGIONS))
            tasks = batches(chosen, 2)
            # The numbers of the regions are the last argument of both tasks.
            futures = [client.submit(task, *where, *more, each, pure=False) for each in tasks]
            assert sum(client.gather(futures)) == shots

        ways = {
            'simulate_many': plain,
            'played': lambda: run(play_only),
            'played and written': lambda: run(region_task.play_regions, region_task.engine()),
        }
        times = {name: [] for name in ways}
        for round_ in range(ROUNDS + 1):
            for name, way in ways.items():
                start = time.perf_counter()
                way()
                if round_:
                    times[name].append((time.perf_counter() - start) / shots)
    shutil.rmtree(store.path)
    for name, seconds in times.items():
        results.add(
            SECTION, f"{name}, random shots on the report's table", seconds, per_second(1, 'shots')
        )
    for name, target in TARGETS.items():
        pairs = zip(times['simulate_many'], times[name], strict=True)
        ratio = statistics.median(plain / way for plain, way in pairs)
        results.note(SECTION, f'{name}, beside `simulate_many`', significant(ratio, 2), target)
