"""Many shots shared out among threads; the kernels let go of the interpreter meanwhile."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

CHUNK = 4096
"""Shots that one thread takes at a time: long beside handing them out, short beside a million."""


def available_cores() -> int:
    """Return how many cores this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except (
        AttributeError,
        OSError,
    ):  # macOS and Windows have no such call; a sandbox may refuse it
        return os.cpu_count() or 1


def share_out(
    shots: int, play: Callable[[Iterator[slice], bool], None], threads: int | None
) -> None:
    """Have `play` called with slices of so many shots until all are played.

    Parameters
    ----------
    shots : int
    play : callable
        Takes an iterator of slices, and whether other threads take from it too. It is called in
        each of the threads, of which the caller's is one.
    threads : int or None
        At most so many; None: one for each core.
    """
    parts = [slice(first, min(first + CHUNK, shots)) for first in range(0, shots, CHUNK)]
    left = iter(parts)
    helpers = min(threads or available_cores(), len(parts)) - 1
    if helpers < 1:
        play(left, False)
        return

    def help_out() -> None:
        try:
            play(left, True)
        finally:
            list(left)  # interrupted: nobody else goes on either

    with ThreadPoolExecutor(helpers) as pool:
        helping = [pool.submit(help_out) for _ in range(helpers)]
        help_out()
    for helper in helping:
        helper.result()
