"""Hands out the regions of a sweep to the workers of a Dask cluster."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from concurrent.futures import CancelledError
from itertools import islice
from typing import Any

import numpy as np

from pool_sim_ros.extras import needs
from pool_sim_ros.oracle import Cluster, ClusterError
from pool_sim_ros.study.description import engine
from pool_sim_ros.study.errors import SweepError
from pool_sim_ros.study.failures import GO_ON, failure
from pool_sim_ros.study.region_task import play_regions
from pool_sim_ros.study.store import Store
from pool_sim_ros.study.tally import Tally

with needs('a sweep', 'study'):
    from distributed import as_completed

TASKS_A_THREAD = 4
"""In hand at a time: enough that no worker waits for the next, whatever the sweep's length."""

LEAST_TASKS = 64
"""In hand at least: a cluster that grows with its queue must see one."""

TASK_REGIONS = 4
"""Of a task at most: Dask takes a thirtieth as long for a task as a region of 100,000 shots."""

TASKS_TO_COME = 8
"""A thread: as the end comes near, tasks grow small, so that all threads end together."""

FIRST_WAIT = 5.0
"""Seconds after which a missing worker is told of."""


def play_on_cluster(address: str, store: Store, tally: Tally) -> None:
    """Play all regions of a sweep that are not there yet.

    Parameters
    ----------
    address : str
        Of the scheduler, like tcp://host:8786.
    store : Store
    tally : Tally

    Raises
    ------
    SweepError
        Where the scheduler is not there, or goes; where a disk is full, or a worker cannot play.
    """
    try:
        client = Cluster(address).client
    except ClusterError as error:
        raise SweepError(str(error)) from None
    try:
        _await_workers(client, address, tally)
        _play(client, address, store, tally)
    except (OSError, CancelledError, asyncio.CancelledError):
        raise SweepError(f'scheduler: {address!r} is gone; {GO_ON}') from None
    finally:
        client.close()


def _await_workers(client: Any, address: str, tally: Tally) -> None:
    try:
        client.wait_for_workers(1, timeout=FIRST_WAIT)
    except TimeoutError:
        tally.say(f'{address} has no workers yet; the sweep begins with the first')
        client.wait_for_workers(1)


def _play(client: Any, address: str, store: Store, tally: Tally) -> None:
    threads = max(sum(client.nthreads().values()), 1)
    left = batches(np.flatnonzero(~store.finished()).tolist(), threads)
    where = str(store.path.absolute()), store.identity, engine()
    in_hand: dict[str, list[int]] = {}

    def more(count: int) -> Iterator[Any]:
        for numbers in islice(left, count):
            # Tasks of one key have the same regions: those left later are among those left now.
            ends = f'{numbers[0]}-{numbers[-1]}-{len(numbers)}'
            key = f'pool-{store.identity[:12]}-{ends}'
            in_hand[key] = numbers
            yield client.submit(play_regions, *where, numbers, key=key, pure=True)

    first = list(more(max(TASKS_A_THREAD * threads, LEAST_TASKS)))
    done = as_completed(first, loop=client.loop)
    for future in done:
        check(future, address, store)
        # What the task returns is known here; to ask for it would take another message.
        tally.add(sum(store.plan.region(n).count for n in in_hand.pop(future.key)))
        done.update(list(more(1)))


def batches(numbers: list[int], threads: int) -> Iterator[list[int]]:
    """Share regions out among tasks, in order: some for each, at the end one for each."""
    done = 0
    while done < len(numbers):
        fair = (len(numbers) - done) // (TASKS_TO_COME * threads)
        count = min(max(fair, 1), TASK_REGIONS)
        yield numbers[done : done + count]
        done += count


def check(future: Any, address: str, store: Store) -> None:
    """Raise SweepError, in words, where a task has failed."""
    if future.status == 'finished':
        return
    if future.status != 'error':
        raise SweepError(f'scheduler: {address!r} is gone; {GO_ON}')
    error = future.exception()
    if isinstance(error, SweepError):
        raise SweepError(str(error)) from None
    raise SweepError(f'{failure(error, store)}; {GO_ON}') from error
