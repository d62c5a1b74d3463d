"""What a worker of Dask does: it plays some regions of a sweep and writes them.

A task is a path and numbers. All else stands in the folder of the sweep, which the workers see.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

from pool_sim_ros import __version__
from pool_sim_ros.study.description import engine
from pool_sim_ros.study.errors import SweepError
from pool_sim_ros.study.playing import Player
from pool_sim_ros.study.store import Store, opened


def play_regions(path: str, identity: str, expected: str, numbers: Sequence[int]) -> int:
    """Play and write regions, one after another; return how many shots they have.

    Parameters
    ----------
    path, identity : str
        The folder of the sweep, and which one it is.
    expected : str
        The engine of whoever sends the task.
    numbers : sequence of int
        Of the regions.

    Raises
    ------
    SweepError
        Where this worker sees another folder, or has another version of the engine.
    OSError
        Where a region cannot be written.
    """
    if engine() != expected:
        raise SweepError(
            f'a worker has another version of the engine ({__version__}, {engine()[:8]}) than this '
            f'process ({expected[:8]}); install the same one everywhere'
        )
    try:
        store, player = _open(path, identity)
    except FileNotFoundError:
        raise SweepError(
            f'out: {path} is not there for a worker; name a folder that all workers share'
        ) from None
    regions = [store.plan.region(number) for number in numbers]
    for region in regions:
        store.write(region, player.play(region))
    return sum(region.count for region in regions)


@lru_cache(maxsize=4)
def _open(path: str, identity: str) -> tuple[Store, Player]:
    from numcodecs import blosc

    # A worker has one core a thread.
    blosc.set_nthreads(1)
    store = opened(Path(path))
    if store.identity != identity:
        raise SweepError(f'out: {path} is another folder for a worker than it is here')
    return store, Player(store.plan, 1)
