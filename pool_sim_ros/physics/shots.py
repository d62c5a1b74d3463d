"""Play shots: one to look at, or a million to choose from."""

from __future__ import annotations

import math
from typing import Any, Literal, NoReturn, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics import time_slice as time_slicing
from pool_sim_ros.physics.cores import share_out
from pool_sim_ros.physics.event_driven import copied, play_parts, work_area
from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.outcomes import (
    BAD_LAYOUT,
    BAD_VELOCITY,
    TOO_MANY_EVENTS,
    Ends,
    Outcomes,
    ShotTooLong,
    new_outcomes,
    with_events,
)
from pool_sim_ros.physics.progress import Counter, Progress
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import MAX_SPEED, MOST_EVENTS, MOST_EVENTS_A_BALL
from pool_sim_ros.physics.trajectory import Trajectory
from pool_sim_ros.physics.validation import array, check_layout, number, whole_number

Integrator = Literal['event', 'time_slice']
INTEGRATORS: tuple[Integrator, ...] = get_args(Integrator)

REPORT_TIME_SLICE = 1e-6
"""The report's slice in s (Listing 2)."""


def simulate(
    table: Table,
    velocities: ArrayLike,
    *,
    positions: ArrayLike | None = None,
    integrator: Integrator = 'event',
    time_slice: float = REPORT_TIME_SLICE,
    until: float | None = None,
    max_events: int | None = None,
) -> Trajectory:
    """Play one shot until all balls rest.

    Parameters
    ----------
    table : Table
    velocities : array_like of shape (2,) or (n, 2)
        Of the cue ball alone, or of every ball, each component at most 1e6 m/s.
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
    """
    limits = _limits(table, integrator, time_slice, until, max_events)
    moving = _velocities(table, velocities, 1)
    layout = None if positions is None else _layouts(table, positions)
    _check_end(table, moving, until, integrator, time_slice)
    if integrator == 'event':
        shot = work_area(table).play(moving, layout, limits)
    else:
        shot = time_slicing.play(table, layout, moving, time_slice, limits)
    if shot.failed:
        _raise(table, shot.failed, 'this shot', moving, layout, limits[1])
    return Trajectory(
        table,
        shot.final_positions,
        shot.final_velocities,
        shot.duration,
        shot.events,
        shot.segments,
        shot.complete,
    )


def simulate_many(
    table: Table,
    velocities: ArrayLike,
    *,
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

    Notes
    -----
    Bit for bit what `simulate` gives one by one, whatever the number of threads.
    """
    limits = _limits(table, integrator, time_slice, until, max_events)
    if errors not in ('raise', 'mark'):
        raise ValueError(f"errors: {errors!r} must be 'raise' or 'mark'")
    if threads is not None:
        threads = whole_number('threads', threads, least=1)
    moving = _velocities(table, velocities, 2)
    shots = len(moving)
    at_rest, layouts = table.balls_at_rest, np.empty((shots, 0, 2))
    if positions is not None:
        given = _layouts(table, positions, shots)
        if given.ndim == 3:
            layouts = given
        else:
            check_layout(table, given)
            at_rest = copied(at_rest)
            at_rest['x'], at_rest['y'] = given.T
    _check_end(table, moving, until, integrator, time_slice)
    outcomes = new_outcomes(shots, len(table.balls), out)
    ends = Ends(
        outcomes.finals,
        outcomes.durations,
        outcomes.event_counts,
        outcomes.first_hit,
        outcomes.failed,
    )
    store = EventStore(shots) if events else None
    counter = Counter(progress, shots)

    def play(parts: Any, shared: bool) -> None:
        if integrator == 'event':
            play_parts(
                table, at_rest, (moving, layouts), limits, ends, parts, shared, store, counter.add
            )
        else:
            time_slicing.play_parts(
                table,
                at_rest,
                (moving, layouts),
                time_slice,
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
        layout = layouts[shot]
        _raise(table, outcomes.failed[shot], f'shot {shot}', moving[shot], layout, limits[1])
    return outcomes if store is None else with_events(outcomes, store.joined())


def compile_kernels(table: Table) -> None:
    """Compile whatever playing a shot needs, or load it from numba's cache.

    The first time takes some seconds; a program that must answer at once calls this first.
    """
    speed = 1e-3
    for integrator in INTEGRATORS:
        shot = simulate(table, (speed, 0.0), integrator=integrator, time_slice=1e-4, until=1e-3)
        shot.positions(0.0)
        simulate_many(table, [(speed, 0.0)], integrator=integrator, time_slice=1e-4, until=1e-3)


def _limits(
    table: Table,
    integrator: str,
    time_slice: float,
    until: float | None,
    max_events: int | None,
) -> tuple[float, int]:
    """Return the end of the clock in s and the most events; raise ValueError."""
    if integrator not in INTEGRATORS:
        raise ValueError(f"integrator: {integrator!r} must be 'event' or 'time_slice'")
    if time_slice is not REPORT_TIME_SLICE:
        number('time_slice', time_slice, above=0.0)
    if max_events is None:
        max_events = max(MOST_EVENTS, MOST_EVENTS_A_BALL * len(table.balls))
    else:
        max_events = whole_number('max_events', max_events, least=1)
    return math.inf if until is None else number('until', until, least=0.0), max_events


def _velocities(table: Table, velocities: ArrayLike, alone: int) -> NDArray[np.float64]:
    """Return velocities as (n or 1, 2), with a dimension more where there are shots.

    `alone` is how many dimensions those of the cue ball alone have.
    """
    n = len(table.balls)
    moving = array('velocities', velocities)
    if moving.ndim == alone and moving.shape[-1:] == (2,):
        if table.is_cue.any() and not table.is_cue[0]:
            raise ValueError(
                f'velocities: shape {moving.shape} strikes ball 0, but the cue ball is ball '
                f'{table.is_cue.argmax()}; give ({n}, 2) of them'
            )
        moving = moving[..., np.newaxis, :]
    elif moving.ndim != alone + 1 or moving.shape[-2:] != (n, 2):
        shots = '' if alone == 1 else 'm, '
        raise ValueError(
            f'velocities: shape {moving.shape} must be ({shots}2) for the cue ball alone or '
            f'({shots}{n}, 2)'
        )
    if alone == 2:
        _check_speeds(moving)
    return _for_kernels(moving)


def _check_speeds(velocities: NDArray[np.float64]) -> None:
    """Raise ValueError where a ball is too fast, or not finite."""
    fastest = float(np.abs(velocities).max(initial=0.0))
    if not fastest <= MAX_SPEED:
        if not math.isfinite(fastest):
            raise ValueError(f'velocities: {velocities[~np.isfinite(velocities)][0]} is not finite')
        raise ValueError(f'velocities: {fastest:g} m/s must be at most {MAX_SPEED:g}')


def _layouts(table: Table, positions: ArrayLike, shots: int | None = None) -> NDArray[np.float64]:
    """Return a layout, (n, 2), or one for each of so many shots; raise ValueError."""
    n = len(table.balls)
    layouts = array('positions', positions)
    if layouts.shape == (n, 2) or (shots is not None and layouts.shape == (shots, n, 2)):
        return _for_kernels(layouts)
    wanted = f'({n}, 2)' if shots is None else f'({n}, 2) for all shots or ({shots}, {n}, 2)'
    raise ValueError(f'positions: shape {layouts.shape} must be {wanted}')


def _for_kernels(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return an array of the one memory layout that the kernels are compiled for."""
    if values.flags.c_contiguous and values.flags.writeable:
        return values
    return np.array(values, order='C')


def _check_end(
    table: Table,
    velocities: NDArray[np.float64],
    until: float | None,
    integrator: str,
    time_slice: float,
) -> None:
    """Raise ValueError where balls would never come to rest."""
    if integrator == 'event' and (until is not None or table.deceleration > 0.0):
        return
    _check_speeds(velocities)
    if until is not None:
        return
    fastest = float(np.abs(velocities).max(initial=0.0))
    if fastest == 0.0:
        return
    if table.deceleration == 0.0:
        raise ValueError('until: None must be a time where mu_ball_surface is 0: nothing ends it')
    # A light ball that a heavy one strikes is faster than either was.
    if time_slice * table.deceleration < np.spacing(1e3 * fastest):
        raise ValueError(
            f'time_slice: {time_slice} is too short: a ball at {fastest:g} m/s loses no speed in it'
        )


def _raise(
    table: Table,
    failed: int,
    shot: str,
    velocities: NDArray[np.float64],
    layout: NDArray[np.float64] | None,
    max_events: int,
) -> NoReturn:
    """Say why a shot failed."""
    if failed == BAD_VELOCITY:
        _check_speeds(velocities)
    if failed == BAD_LAYOUT and layout is not None:
        check_layout(table, layout, 'positions' if shot == 'this shot' else f'positions of {shot}')
    if failed == TOO_MANY_EVENTS:
        raise ShotTooLong(f'max_events: {shot} has more than {max_events} contacts and stops')
    raise ValueError(
        f"mu_ball_ball: {table.mu_ball_ball} is too large here: the law 'report' gives {shot} "
        "energy without end; make it smaller, or use the law 'coulomb'"
    )
