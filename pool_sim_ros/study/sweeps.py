"""Sweeps: many shots over ranges of inputs, in memory or on disk, here or on a cluster."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pool_sim_ros.extras import needs
from pool_sim_ros.physics import Table
from pool_sim_ros.study.checks import counted
from pool_sim_ros.study.datasets import dataset_in_memory, open_sweep
from pool_sim_ros.study.inputs import checked_inputs, named_inputs
from pool_sim_ros.study.plan import CHUNK, Plan, Region, checked_plan
from pool_sim_ros.study.playing import Player
from pool_sim_ros.study.tally import Tally

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import xarray

    from pool_sim_ros.study.store import Store

LARGE = 256 * 2**20
"""Bytes of a chunk that a worker may find too many."""


def sweep(
    table: Table,
    *,
    velocity: Any = None,
    spin: Any = None,
    cue: Any = None,
    place: Mapping[str, Any] | None = None,
    positions: ArrayLike | None = None,
    samples: int | None = None,
    seed: int = 0,
    out: str | os.PathLike[str] | None = None,
    keep: Sequence[str] | None = None,
    balls: Sequence[str] | None = None,
    chunk: int | None = None,
    scheduler: str | None = None,
    workers: int | None = None,
    progress: bool = True,
    **others: Any,
) -> xarray.Dataset:
    """Play a shot for each combination of the inputs.

    An input is a number, a row of numbers (k,), which makes a dimension of that name, or `uniform`
    or `normal`, which draw a number for each shot.

    Parameters
    ----------
    table : Table
    velocity : optional
        Of the cue ball: ``polar(angle, speed)`` in degrees and m/s, or ``xy(x, y)`` in m/s.
    cue : optional
        Instead of a velocity: ``cue(speed, azimuth, ...)``, as `cue_strike` takes it.
    spin : optional
        Of the cue ball: ``xyz(x, y, z)`` in rad/s, beside a velocity.
    place : dict, optional
        Label of a ball -> ``xy(x, y)`` in m, where it starts.
    positions : array_like of shape (n, 2) or (k, n, 2), optional
        Where the balls start, m; several layouts make a dimension `layout`.
    samples : int, optional
        Makes a last dimension `sample`, along which only what is drawn changes.
    seed : int, optional
        Of what is drawn. A shot's numbers depend on it and on the index of the shot alone.
    out : path_like, optional
        A zarr folder to write to. If it has a part of this sweep, the sweep goes on from there.
        Without it all stays in memory, and this process plays alone.
    keep : sequence of str, optional
        Which arrays of `Outcomes` to keep; by default all but the events.
    balls : sequence of str, optional
        Labels of the balls whose ends are kept; by default all.
    chunk : int, optional
        Shots that are played and written together, at most; by default 100,000.
    scheduler : str, optional
        Address of a Dask cluster, like tcp://host:8786, whose workers see `out` too.
    workers : int, optional
        Processes on this machine, if there is no `scheduler`; by default one a core, or none for a
        small sweep. 0: no other process, and no Dask.
    progress : bool, optional
        Whether to show a bar with the time left, and a line about the chunks.
    **others
        `jitter`, the standard deviation in m by which x and y of each ball are drawn for each shot;
        and coefficients of the table by name, such as ``e_ball_ball=[0.9, 0.95]``.

    Returns
    -------
    xarray.Dataset
        With a dimension for each row; units and meanings are attributes of the variables. Table,
        versions, seed and inputs are attributes of the whole.

    Raises
    ------
    ValueError
        For an input that is none, or cannot be; names it.
    FileExistsError
        Where `out` has another sweep, or something else.
    FileNotFoundError
        Where `out` vanishes meanwhile.
    SweepError
        Where a sweep cannot go on: the disk is full, the scheduler is gone. What is written stays.
    ModuleNotFoundError
        Where the extra `study` is not installed.

    Notes
    -----
    Bit for bit the same for any chunks, workers and interruptions.
    """
    if not isinstance(table, Table):
        raise ValueError(f'table: {table!r} must be a Table')
    inputs = checked_inputs(table, named_inputs(velocity, spin, cue, place, others))
    plan = checked_plan(table, inputs, positions, samples, seed, keep, balls, chunk)
    count = _workers(workers, out, scheduler, plan)
    # The first shot tells of mistakes, and compiles the engine, before any worker starts.
    Player(plan, 1).play(Region(0, 0, 1, (slice(0, 1),) * len(plan.shape)))
    if out is None:
        with Tally(plan.shots, 0, progress) as tally:
            return dataset_in_memory(plan, tally)
    path = Path(out).expanduser()
    _write(path, plan, chunk, scheduler, count, progress)
    return open_sweep(path)


def _write(
    path: Path, plan: Plan, chunk: int | None, scheduler: str | None, workers: int, progress: bool
) -> None:
    with needs('a sweep', 'study'):
        from pool_sim_ros.study.store import created
    store = created(path, plan)
    if chunk is not None and chunk != store.plan.chunk:
        raise FileExistsError(
            f'out: {path} has chunks of {store.plan.chunk} shots, not {chunk}; leave chunk away to '
            'go on with these'
        )
    there = store.finished()
    done = sum(store.plan.region(int(k)).count for k in np.flatnonzero(there))
    with Tally(plan.shots, done, progress) as tally:
        if there.all():
            return
        tally.say(advice(store.plan, workers if scheduler is None else 1))
        if scheduler is None and workers == 0:
            _play_here(store, tally)
            return
        from pool_sim_ros.study.dispatch import play_on_cluster

        if scheduler is not None:
            play_on_cluster(scheduler, store, tally)
            return
        from pool_sim_ros.study.local_cluster import local_cluster

        with local_cluster(min(workers, int((~there).sum()))) as address:
            play_on_cluster(address, store, tally)


def _play_here(store: Store, tally: Tally) -> None:
    from pool_sim_ros.study.errors import SweepError
    from pool_sim_ros.study.failures import GO_ON, failure

    player = Player(store.plan, None)
    for number in np.flatnonzero(~store.finished()):
        region = store.plan.region(int(number))
        try:
            store.write(region, player.play(region))
        except OSError as error:
            raise SweepError(f'{failure(error, store)}; {GO_ON}') from error
        tally.add(region.count)


def advice(plan: Plan, workers: int) -> str:
    """Return one line about the chunks of a sweep."""
    count = int(np.prod(plan.block))
    size = count * (16 * len(plan.table.balls) + 64)
    line = (
        f'{plan.shots:,} shots in {plan.regions:,} chunks of {count:,}, {size / 2**20:.3g} MiB each'
    )
    if size > LARGE:
        return f'{line}: a smaller chunk= takes less memory of each worker'
    if count < CHUNK // 10 and plan.regions > 100:
        return f'{line}: a larger chunk= is faster, up to {CHUNK:,}'
    if plan.regions < 4 * workers and plan.shots > 1000 * workers:
        better = max(plan.shots // (8 * workers), 1000)
        return f'{line}: chunk={better} would keep {workers} workers busy to the end'
    return f'{line}; a run that is killed loses those in hand'


def _workers(workers: int | None, out: Any, scheduler: str | None, plan: Plan) -> int:
    if out is None and (scheduler is not None or workers):
        raise ValueError('out: it is missing; workers write to a folder')
    if workers is not None:
        return counted('workers', workers, 0)
    if plan.shots <= CHUNK:
        return 0  # all are played before a worker would start
    try:
        return len(os.sched_getaffinity(0))
    except (AttributeError, OSError):
        return os.cpu_count() or 1
