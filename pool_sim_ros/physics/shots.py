"""Play shots: one to look at, or a million to choose from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics import kernel_cache
from pool_sim_ros.physics import time_slice as time_slicing
from pool_sim_ros.physics.cores import share_out
from pool_sim_ros.physics.event_driven import play_parts, work_area
from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.integrators import INTEGRATORS, REPORT_TIME_SLICE, Integrator
from pool_sim_ros.physics.outcomes import (
    NO_POCKETED,
    Ends,
    Outcomes,
    new_outcomes,
    with_events,
)
from pool_sim_ros.physics.progress import Counter, Progress
from pool_sim_ros.physics.shot_inputs import (
    check_end,
    layouts_for,
    limits_of,
    raise_failed,
    spins_for,
    velocities_for,
)
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.trajectory import Trajectory
from pool_sim_ros.physics.validation import check_layout, whole_number


def simulate(
    table: Table,
    velocities: ArrayLike,
    *,
    spins: ArrayLike | None = None,
    positions: ArrayLike | None = None,
    integrator: Integrator = 'event',
    time_slice: float = REPORT_TIME_SLICE,
    until: float | None = None,
    max_events: int | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Trajectory:
    """Play one shot until all balls rest.

    Parameters
    ----------
    table : Table
    velocities : array_like of shape (2,) or (n, 2)
        Of the cue ball alone, or of every ball, each component at most 1e6 m/s.
    spins : array_like of shape (3,) or (n, 3), optional
        Angular velocities of the cue ball alone, or of every ball, rad/s; z points up. Only on a
        table of motion 'ball'.
    positions : array_like of shape (n, 2), optional
        Where the balls start instead of their own places, m.
    integrator : {'event', 'time_slice'}, optional
        The exact one, or the report's (Listing 3).
    time_slice : float, optional
        Slice of the report's integrator, s.
    until : float, optional
        Stop the clock there, s. Required where nothing slows the balls.
    max_events : int, optional
        A longer shot is given up; by default 100,000, or 1,000 a ball where that is more.
    cancelled : callable, optional
        `time_slice` calls it now and then, and gives the shot up where it returns True. `event`
        does not: `max_events` ends it soon enough.

    Returns
    -------
    Trajectory

    Raises
    ------
    ValueError
        For a wrong shape, a value that is not finite or out of range, balls that overlap or lie
        outside, an unknown integrator; and for a shot to which the `report` law of friction gives
        energy without end.
    ShotTooLong
        A ValueError, for a shot of more than `max_events`.
    ShotCancelled
        Where `cancelled` returned True.
    """
    limits = limits_of(table, integrator, time_slice, until, max_events)
    moving = velocities_for(table, velocities, 1)
    turning = spins_for(table, spins, None)
    layout = None if positions is None else layouts_for(table, positions)
    check_end(table, moving, until, integrator, time_slice)
    if integrator == 'event':
        shot = work_area(table).play(moving, turning, layout, limits)
    else:
        shot = time_slicing.play(table, layout, moving, float(time_slice), limits, cancelled)
    if shot.failed:
        raise_failed(table, shot.failed, 'this shot', (moving, turning), layout, limits[1])
    return Trajectory(
        table,
        shot.final_positions,
        shot.final_velocities,
        shot.duration,
        shot.events,
        shot.segments,
        shot.complete,
        shot.pocketed,
    )


def simulate_many(
    table: Table,
    velocities: ArrayLike,
    *,
    spins: ArrayLike | None = None,
    positions: ArrayLike | None = None,
    integrator: Integrator = 'event',
    time_slice: float = REPORT_TIME_SLICE,
    until: float | None = None,
    max_events: int | None = None,
    events: bool = False,
    errors: Literal['raise', 'mark'] = 'raise',
    threads: int | None = None,
    progress: Progress = None,
    out: Outcomes | None = None,
) -> Outcomes:
    """Play many shots on every core; only what came of them is kept.

    Parameters
    ----------
    table : Table
    velocities : array_like of shape (m, 2) or (m, n, 2)
        For each shot that of the cue ball alone, or of every ball, each component at most 1e6 m/s.
    spins : array_like of shape (3,), (m, 3) or (m, n, 3), optional
        As in `simulate`: that of the cue ball in all shots, or shot by shot.
    positions : array_like of shape (n, 2) or (m, n, 2), optional
        Where the balls start instead of their own places, in all shots or shot by shot, m.
    integrator, time_slice, until, max_events
        As in `simulate`, the same for all shots.
    events : bool, optional
        Whether to keep all events.
    errors : {'raise', 'mark'}, optional
        What to do about a shot that fails: a layout that cannot be, too many events, energy without
        end. Raise, naming the shot, or mark it in the outcomes and go on.
    threads : int, optional
        At most so many; by default one for each core.
    progress : bool or callable, optional
        True shows a bar, where tqdm is installed. A callable is called now and then with the
        number of shots played and the total.
    out : Outcomes, optional
        Arrays to write to, of the right shape and type, for results that are large; its events
        are not used. Those that are None are made anew.

    Returns
    -------
    Outcomes

    Raises
    ------
    ValueError
        As `simulate`; with ``errors='mark'`` not for single shots, except for their velocities.
    TypeError
        Where `out` is something else.

    Notes
    -----
    Bit for bit what `simulate` gives one by one, whatever the number of threads.
    """
    limits = limits_of(table, integrator, time_slice, until, max_events)
    if errors not in ('raise', 'mark'):
        raise ValueError(f"errors: {errors!r} must be 'raise' or 'mark'")
    if threads is not None:
        threads = whole_number('threads', threads, least=1)
    moving = velocities_for(table, velocities, 2)
    shots = len(moving)
    turning = spins_for(table, spins, shots)
    layout: NDArray[np.float64] | None = None
    layouts = np.empty((shots, 0, 2))
    given = None if positions is None else layouts_for(table, positions, shots)
    if given is not None and given.ndim == 3:
        layouts = given
    elif given is not None:
        check_layout(table, given)
        if shots == 1:  # they are put there: to make a work area for one shot takes longer
            layouts = given[np.newaxis]
        else:
            layout = given
    check_end(table, moving, until, integrator, time_slice)
    outcomes = new_outcomes(shots, len(table.balls), out, len(table.pockets) > 0)
    ends = Ends(
        outcomes.finals,
        outcomes.durations,
        outcomes.event_counts,
        outcomes.pocketed if len(table.pockets) else NO_POCKETED,
        outcomes.first_hit,
        outcomes.failed,
    )
    store = EventStore(shots) if events else None
    counter = Counter(progress, shots)

    def play(parts: Any) -> None:
        if integrator == 'event':
            play_parts(
                table,
                layout,
                (moving, turning, layouts),
                limits,
                ends,
                parts,
                store,
                counter.add,
            )
        else:
            time_slicing.play_parts(
                table,
                table.balls_at_rest if layout is None else table.records_at(layout),
                (moving, layouts),
                float(time_slice),
                limits,
                ends,
                parts,
                store,
                counter.add,
            )

    try:
        share_out(shots, play, threads)
    finally:
        counter.close()
    if errors == 'raise' and outcomes.failed.any():
        shot = int(np.flatnonzero(outcomes.failed)[0])
        layout = layouts[shot] if len(layouts[shot]) else given
        struck = moving[shot], turning[shot]
        raise_failed(table, outcomes.failed[shot], f'shot {shot}', struck, layout, limits[1])
    return outcomes if store is None else with_events(outcomes, store.joined())


def compile_kernels(table: Table) -> None:
    """Compile whatever playing a shot needs, or load what was compiled before.

    The first time takes some seconds; a program that must answer at once calls this first. It says
    nothing: who calls it knows.

    Parameters
    ----------
    table : Table
        Any of the same kind will do: how many balls it has, and its coefficients, change nothing.
        Of one kind are tables with the same motion that all have `cushions`, or that all have none.
    """
    # What is compiled depends on types alone. Two balls at rest need neither memory nor time.
    small = replace(table, balls=table.balls[:2])
    still, layout = np.zeros((len(small.balls), 2)), np.array(small.positions)
    integrators: tuple[Integrator, ...] = INTEGRATORS if table.motion == 'disc' else ('event',)
    with kernel_cache.silence():
        for integrator in integrators:
            shot = simulate(small, still, positions=layout, integrator=integrator, until=0.0)
            shot.positions(0.0)
            simulate_many(small, still[np.newaxis], integrator=integrator, until=0.0)
        if table.motion == 'ball':
            shot.spins(0.0), shot.orientations(0.0)
