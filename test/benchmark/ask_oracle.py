"""Asks an oracle from a process of its own; says on standard output, as JSON, how long that took.

python ask_oracle.py ROUNDS
"""

import json
import sys
import time

import numpy as np
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from pool_sim_ros.oracle import what_if
from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import WhatIfClient

BURST = 20


def candidates(count: int) -> np.ndarray:
    """Return random strokes of the report's speeds, (count, 2), m/s."""
    rng = np.random.default_rng(count)
    angle, speed = rng.uniform(0.0, 2.0 * np.pi, count), rng.uniform(0.3, 5.0, count)
    return np.stack([speed * np.cos(angle), speed * np.sin(angle)], axis=-1)


def main(rounds: int) -> None:
    context = Context()
    rclpy.init(args=[], context=context)
    node = Node('asker', context=context, use_global_arguments=False)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    client = WhatIfClient(node, '/pool_oracle')

    def seconds(*asked: np.ndarray) -> float:
        """Return how long it takes until all questions are answered."""
        start = time.perf_counter()
        futures = [client.ask(rows) for rows in asked]
        for future in futures:
            executor.spin_until_future_complete(future)
        taken = time.perf_counter() - start
        for rows, future in zip(asked, futures, strict=True):
            assert len(future.result().finals) == len(rows)
        return taken

    seconds(candidates(1))
    times = {count: [] for count in (1, 10_000, 50_000)}
    alone = {count: [] for count in times}
    table = report_table()
    equal = True
    for _ in range(rounds):
        for count in times:
            rows = candidates(count)
            times[count].append(seconds(rows))
            start = time.perf_counter()
            here = what_if(table, rows)
            alone[count].append(time.perf_counter() - start)
    for rows in (candidates(10_000), candidates(50_000)):
        future = client.ask(rows)
        executor.spin_until_future_complete(future)
        there, here = future.result(), what_if(table, rows)
        equal = equal and all(
            np.array_equal(a, b)
            for a, b in (
                (there.finals, here.finals),
                (there.durations, here.durations),
                (there.event_counts, here.event_counts),
                (there.first_hit, here.first_hit),
                (there.pocketed, here.pocketed),
            )
        )
    burst = seconds(*[candidates(10_000)] * BURST)
    print(
        json.dumps(
            {
                'equal': equal,
                'burst': burst,
                'times': {count: float(np.median(t)) for count, t in times.items()},
                'alone': {count: float(np.median(t)) for count, t in alone.items()},
            }
        ),
        flush=True,
    )
    context.try_shutdown()


if __name__ == '__main__':
    main(int(sys.argv[1]))
