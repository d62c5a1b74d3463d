"""Asks an oracle from a process of its own; says on standard output, as JSON, how long that took.

python ask_oracle.py ROUNDS [--only-ask]

With --only-ask it plays nothing itself, and compares nothing.
"""

import json
import sys
import time

import echo
import numpy as np
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from pool_sim_ros.oracle import what_if
from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import WhatIfClient, oracle_interface
from pool_sim_ros.ros.what_if_rows import request_bytes

BURST = 20
COUNTS = {1: 10, 10_000: 1, 50_000: 1}
"""Candidates of a question, and how many times the rounds it is asked."""


def candidates(count: int) -> np.ndarray:
    """Return random strokes of the report's speeds, (count, 2), m/s."""
    rng = np.random.default_rng(count)
    angle, speed = rng.uniform(0.0, 2.0 * np.pi, count), rng.uniform(0.3, 5.0, count)
    return np.stack([speed * np.cos(angle), speed * np.sin(angle)], axis=-1)


def echoes(node: Node, executor: SingleThreadedExecutor, rounds: int) -> list[float]:
    """Return how long `echo.py` takes to answer messages of one candidate, s."""
    asked, told = oracle_interface.WHAT_IF_REQUEST, oracle_interface.WHAT_IF_RESPONSE
    heard: list[bytes] = []
    requests = node.create_publisher(asked.type, asked.of(echo.NAME), asked.qos)
    node.create_subscription(told.type, told.of(echo.NAME), heard.append, told.qos, raw=True)
    message = request_bytes((1, 2), 'table', candidates(1))
    while not heard:  # until both know each other
        requests.publish(message)
        executor.spin_once(0.3)
    times = []
    for _ in range(rounds):
        while heard:  # what else is under way
            heard.clear()
            executor.spin_once(0.02)
        start = time.perf_counter()
        requests.publish(message)
        while not heard:
            executor.spin_once(1.0)
        times.append(time.perf_counter() - start)
    return times


def main(rounds: int, only_ask: bool) -> None:
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
    times = {count: [] for count in COUNTS}
    alone = {count: [] for count in times}
    table = report_table()
    equal = True
    for count, often in COUNTS.items():
        rows = candidates(count)
        for _ in range(rounds * often):
            times[count].append(seconds(rows))
            if only_ask:
                continue
            start = time.perf_counter()
            here = what_if(table, rows)
            alone[count].append(time.perf_counter() - start)
    if only_ask:
        context.try_shutdown()
        return
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
                'echo': float(np.median(echoes(node, executor, rounds * COUNTS[1]))),
                'times': {count: float(np.median(t)) for count, t in times.items()},
                'alone': {count: float(np.median(t)) for count, t in alone.items()},
            }
        ),
        flush=True,
    )
    context.try_shutdown()


if __name__ == '__main__':
    main(int(sys.argv[1]), '--only-ask' in sys.argv)
