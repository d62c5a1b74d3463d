"""Hands out the regions of a sweep to the workers of a Dask cluster."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from concurrent.futures import CancelledError
from itertools import islice
from typing import Any

import numpy as np

from pool_sim_ros.extras import needs
from pool_sim_ros.study.description import engine
from pool_sim_ros.study.errors import SweepError
from pool_sim_ros.study.failures import GO_ON, failure
from pool_sim_ros.study.region_task import play_region
from pool_sim_ros.study.store import Store
from pool_sim_ros.study.tally import Tally

with needs('a sweep', 'study'):
    from distributed import Client, as_completed

TASKS_A_THREAD = 4
"""In hand at a time: enough that no worker waits for the next, whatever the sweep's length."""

LEAST_TASKS = 64
"""In hand at least: a cluster that grows with its queue must see one."""

CONNECT = '20s'
"""In which a scheduler must answer."""

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
        client = Client(address, timeout=CONNECT, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        why = ' '.join(str(error).split()) or type(error).__name__
        raise SweepError(f'scheduler: {address!r} does not answer: {why}') from None
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
    left = iter(np.flatnonzero(~store.finished()).tolist())
    where = str(store.path.absolute()), store.identity, engine()
    in_hand: dict[str, int] = {}

    def more(count: int) -> Iterator[Any]:
        for number in islice(left, count):
            key = f'pool-{store.identity[:12]}-{number}'
            in_hand[key] = number
            yield client.submit(play_region, *where, number, key=key, pure=True)

    threads = max(sum(client.nthreads().values()), 1)
    first = list(more(max(TASKS_A_THREAD * threads, LEAST_TASKS)))
    done = as_completed(first, loop=client.loop)
    for future in done:
        check(future, address, store)
        # What the task returns is known here; to ask for it would take another message.
        tally.add(store.plan.region(in_hand.pop(future.key)).count)
        done.update(list(more(1)))


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
