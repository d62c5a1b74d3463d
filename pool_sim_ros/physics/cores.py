"""Many shots shared out among threads; the kernels let go of the interpreter meanwhile."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, wait
from functools import lru_cache

CHUNK, LEAST_CHUNK = 4096, 512
"""Most and fewest shots that a thread takes at a time: long beside handing them out, short beside a
million."""

CHUNKS_A_THREAD = 8
"""Parts for each thread where there are enough shots: the last ones must not wait long for one."""

MOST_HELPERS = 1000
"""Threads for all callers together: as many as are wanted, so that no caller waits for another."""


def available_cores() -> int:
    """Return how many cores this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except (
        AttributeError,
        OSError,
    ):  # macOS and Windows have no such call; a sandbox may refuse it
        return os.cpu_count() or 1


def share_out(shots: int, play: Callable[[Iterator[slice]], None], threads: int | None) -> None:
    """Have `play` called with slices of so many shots until all are played.

    Parameters
    ----------
    shots : int
    play : callable
        Takes an iterator of slices, from which other threads may take too. It is called in each of
        the threads, of which the caller's is one.
    threads : int or None
        At most so many; None: one for each core.
    """
    if 0 < shots <= min(LEAST_CHUNK, CHUNK):
        play(iter((slice(0, shots),)))
        return
    threads = threads or available_cores()
    size = min(max(shots // (CHUNKS_A_THREAD * threads), LEAST_CHUNK), CHUNK)
    parts = [slice(first, min(first + size, shots)) for first in range(0, shots, size)]
    left = iter(parts)
    helpers = min(threads, len(parts)) - 1
    if helpers < 1:
        play(left)
        return

    def help_out() -> None:
        try:
            play(left)
        finally:
            list(left)  # interrupted: nobody else goes on either

    pool = kept_threads()
    helping = [pool.submit(help_out) for _ in range(helpers)]
    try:
        help_out()
    finally:
        # Nothing is left for one that has not begun by now.
        begun = [helper for helper in helping if not helper.cancel()]
        wait(begun)
    for helper in begun:
        helper.result()


@lru_cache(maxsize=1)
def kept_threads() -> ThreadPoolExecutor:
    """Return threads that wait for work: to start one takes as long as some hundred shots."""
    return ThreadPoolExecutor(MOST_HELPERS, 'pool_sim_ros')


if hasattr(os, 'register_at_fork'):
    os.register_at_fork(after_in_child=kept_threads.cache_clear)  # a fork has no other thread
