"""Play shots: one to look at, or a million to choose from."""

from __future__ import annotations

import math
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import ArrayLike

from pool_sim_ros.physics import time_slice as time_slicing
from pool_sim_ros.physics.event_driven import engine as event_driven
from pool_sim_ros.physics.motion.disc import copied
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.trajectory import Trajectory
from pool_sim_ros.physics.validation import check_layout, number

INTEGRATORS = ('event', 'time_slice')

REPORT_TIME_SLICE = 1e-6
"""The report's slice in s (Listing 2)."""

MAX_SPEED = 1e6
"""Of a ball at the start, along each axis, m/s."""

CHUNK = 4096
"""Shots that one thread takes at a time: long beside handing them out, short beside a million."""


def simulate(
    table: Table,
    velocities: ArrayLike,
    *,
    positions: ArrayLike | None = None,
    integrator: str = 'event',
    time_slice: float = REPORT_TIME_SLICE,
    until: float | None = None,
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

    Returns
    -------
    Trajectory

    Raises
    ------
    ValueError
        For a wrong shape, a value that is not finite or out of range, balls that overlap or lie
        outside, an unknown integrator; and for a shot to which the `report` law of friction gives
        energy without end.
    """
    at_rest, limit = _check(table, positions, integrator, time_slice, until)
    moving, fastest = _velocities(table, velocities, (1, 2))
    _check_end(table, fastest, until, integrator, time_slice)
    if integrator == 'event':
        trajectory = event_driven.play(table, at_rest, moving, limit)
    else:
        trajectory = time_slicing.play(table, at_rest, moving, time_slice, limit)
    if math.isnan(trajectory.duration):
        raise _gains_energy(table, 'this shot')
    return trajectory


def simulate_many(
    table: Table,
    velocities: ArrayLike,
    *,
    positions: ArrayLike | None = None,
    integrator: str = 'event',
    time_slice: float = REPORT_TIME_SLICE,
    until: float | None = None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Play many shots from one layout on every core; only their ends are kept.

    Parameters
    ----------
    table : Table
    velocities : array_like of shape (m, 2) or (m, n, 2)
        For each shot that of the cue ball alone, or of every ball, each component at most 1e6 m/s.
    positions, integrator, time_slice, until
        As in `simulate`, the same for all shots.

    Returns
    -------
    finals : ndarray of shape (m, n, 2)
        Final positions, m.
    durations : ndarray of shape (m,)
        s.
    event_counts : ndarray of shape (m,)
        Contacts and stops.

    Raises
    ------
    ValueError
        As `simulate`.

    Notes
    -----
    Bit for bit what `simulate` gives one by one.
    """
    at_rest, limit = _check(table, positions, integrator, time_slice, until)
    moving, fastest = _velocities(table, velocities, (2, 3))
    _check_end(table, fastest, until, integrator, time_slice)
    shots = len(moving)
    finals = np.empty((shots, len(at_rest), 2))
    durations = np.empty(shots)
    counts = np.empty(shots, np.int64)
    ends = finals, durations, counts
    parts = [slice(first, first + CHUNK) for first in range(0, shots, CHUNK)]
    left = iter(parts)
    helpers = min(len(os.sched_getaffinity(0)), len(parts)) - 1

    def play() -> None:
        if integrator == 'event':
            event_driven.play_many(table, at_rest, moving, limit, ends, left, helpers < 1)
        else:
            time_slicing.play_many(table, at_rest, moving, time_slice, limit, ends, left)

    if helpers < 1:
        play()
    else:
        with ThreadPoolExecutor(helpers) as pool:
            helping = [pool.submit(play) for _ in range(helpers)]
            try:
                play()
            finally:
                list(left)  # interrupted: nobody else goes on either
        for helper in helping:
            helper.result()
    given_up = np.isnan(durations)
    if given_up.any():
        raise _gains_energy(table, f'shot {given_up.argmax()}')
    return finals, durations, counts


def compile_kernels(table: Table) -> None:
    """Compile whatever playing a shot needs, or load it from numba's cache.

    The first time takes some seconds; a program that must answer at once calls this first.
    """
    speed = 1e-3
    for integrator in INTEGRATORS:
        shot = simulate(table, (speed, 0.0), integrator=integrator, time_slice=1e-4, until=1e-3)
        shot.positions(0.0)
        simulate_many(table, [(speed, 0.0)], integrator=integrator, time_slice=1e-4, until=1e-3)


def _check(table, positions, integrator, time_slice, until):
    """Return the balls at their places, and the end of the clock; raise ValueError."""
    if integrator not in INTEGRATORS:
        raise ValueError(f"integrator: {integrator!r} must be 'event' or 'time_slice'")
    number('time_slice', time_slice, above=0.0)
    limit = math.inf if until is None else number('until', until, least=0.0)
    if positions is None:
        return table.balls_at_rest, limit
    n = len(table.balls)
    places = _array('positions', positions)
    if places.shape != (n, 2):
        raise ValueError(f'positions: shape {places.shape} must be ({n}, 2)')
    check_layout(table, places)
    at_rest = copied(table.balls_at_rest)
    at_rest['x'], at_rest['y'] = places.T
    return at_rest, limit


def _velocities(table, velocities, dimensions):
    """Return velocities as (n or 1, 2), with as many dimensions more as there are shots."""
    n = len(table.balls)
    array = _array('velocities', velocities)
    alone, all_balls = dimensions
    if array.ndim == alone and array.shape[-1:] == (2,):
        if table.is_cue.any() and not table.is_cue[0]:
            raise ValueError(
                f'velocities: shape {array.shape} strikes ball 0, but the cue ball is ball '
                f'{table.is_cue.argmax()}; give ({n}, 2) of them'
            )
        array = array[..., np.newaxis, :]
    elif array.ndim != all_balls or array.shape[-2:] != (n, 2):
        shots = '' if alone == 1 else 'm, '
        raise ValueError(
            f'velocities: shape {array.shape} must be ({shots}2) for the cue ball alone or '
            f'({shots}{n}, 2)'
        )
    fastest = float(np.abs(array).max(initial=0.0))
    if not fastest <= MAX_SPEED:
        if not math.isfinite(fastest):
            raise ValueError(f'velocities: {array[~np.isfinite(array)][0]} is not finite')
        raise ValueError(f'velocities: {fastest:g} m/s must be at most {MAX_SPEED:g}')
    return np.ascontiguousarray(array), fastest


def _check_end(table, fastest, until, integrator, time_slice):
    """Raise ValueError where balls of up to `fastest` m/s would never come to rest."""
    if until is not None or fastest == 0.0:
        return
    if table.deceleration == 0.0:
        raise ValueError('until: None must be a time where mu_ball_surface is 0: nothing ends it')
    # A light ball that a heavy one strikes is faster than either was.
    if integrator == 'time_slice' and time_slice * table.deceleration < np.spacing(1e3 * fastest):
        raise ValueError(
            f'time_slice: {time_slice} is too short: a ball at {fastest:g} m/s loses no speed in it'
        )


def _gains_energy(table, shot):
    """Return the error for a shot that was given up, which its duration of NaN says."""
    return ValueError(
        f"mu_ball_ball: {table.mu_ball_ball} is too large here: the law 'report' gives {shot} "
        "energy without end; make it smaller, or use the law 'coulomb'"
    )


def _array(name, values):
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f'{name}: {values!r} is not an array of numbers') from None
