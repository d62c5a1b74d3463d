"""Sweeps on two local workers beside `simulate_many` on two threads, with the same shots."""

import itertools
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
from pool_sim_ros.study.inputs import checked_inputs  # noqa: E402
from pool_sim_ros.study.local_cluster import local_cluster  # noqa: E402
from pool_sim_ros.study.plan import checked_plan  # noqa: E402
from pool_sim_ros.study.store import created  # noqa: E402

SECTION = 'Sweeps, two workers'
ROUNDS, REGIONS = 15, 6
TARGETS = {'played': '0.85', 'played and written': '0.70'}


def test_shots_beside_simulate_many(results, tmp_path):
    table = report_table()
    inputs = checked_inputs(table, {'angle': uniform(0, 360), 'speed': uniform(0.5, 4)})
    regions = (ROUNDS + 1) * REGIONS
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
    numbers = itertools.count()
    with local_cluster(2) as address, distributed.Client(address, set_as_default=False) as client:

        def play_only(path, identity, number):
            """What `play_region` does, but for the writing; in here, so that it goes by value."""
            store, player = region_task._open(path, identity)
            return len(player.play(store.plan.region(number))['failed'])

        def plain():
            simulate_many(table, velocities, threads=2, out=out)

        def run(task, *more):
            # The number of the region is the last argument of both tasks.
            chosen = list(itertools.islice(numbers, REGIONS))
            futures = [client.submit(task, *where, *more, n % regions, pure=False) for n in chosen]
            assert sum(client.gather(futures)) == REGIONS * 100_000

        ways = {
            'simulate_many': plain,
            'played': lambda: run(play_only),
            'played and written': lambda: run(region_task.play_region, region_task.engine()),
        }
        times = {name: [] for name in ways}
        for round_ in range(ROUNDS + 1):
            for name, way in ways.items():
                start = time.perf_counter()
                way()
                if round_:
                    times[name].append((time.perf_counter() - start) / len(velocities))
    for name, seconds in times.items():
        results.add(
            SECTION, f"{name}, random shots on the report's table", seconds, per_second(1, 'shots')
        )
    for name, target in TARGETS.items():
        pairs = zip(times['simulate_many'], times[name], strict=True)
        ratio = statistics.median(plain / way for plain, way in pairs)
        results.note(SECTION, f'{name}, beside `simulate_many`', significant(ratio, 2), target)
