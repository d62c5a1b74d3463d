"""What a shot is given, checked and made ready for the kernels; and why one failed, in words."""

from __future__ import annotations

import math
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics.boundary import pocket_at
from pool_sim_ros.physics.integrators import INTEGRATORS, REPORT_TIME_SLICE
from pool_sim_ros.physics.jit import for_kernels
from pool_sim_ros.physics.outcomes import (
    BAD_LAYOUT,
    BAD_VELOCITY,
    RUNS_AWAY,
    TOO_MANY_EVENTS,
    ShotTooLong,
)
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import MAX_SPEED, MOST_EVENTS, MOST_EVENTS_A_BALL
from pool_sim_ros.physics.validation import array, check_layout, number, whole_number

NO_SPINS = np.empty((0, 3))


def limits_of(
    table: Table,
    integrator: str,
    time_slice: float,
    until: float | None,
    max_events: int | None,
) -> tuple[float, int]:
    """Return the end of the clock in s and the most events; raise ValueError."""
    if integrator not in INTEGRATORS:
        raise ValueError(f"integrator: {integrator!r} must be 'event' or 'time_slice'")
    if integrator == 'time_slice' and table.motion != 'disc':
        raise ValueError("integrator: 'time_slice' plays discs only, not a table of motion 'ball'")
    if time_slice is not REPORT_TIME_SLICE:
        number('time_slice', time_slice, above=0.0)
    if max_events is None:
        max_events = max(MOST_EVENTS, MOST_EVENTS_A_BALL * len(table.balls))
    else:
        max_events = whole_number('max_events', max_events, least=1)
    return math.inf if until is None else number('until', until, least=0.0), max_events


def velocities_for(table: Table, velocities: ArrayLike, alone: int) -> NDArray[np.float64]:
    """Return velocities as (n or 1, 2), with a dimension more where there are shots.

    `alone` is how many dimensions those of the cue ball alone have.
    """
    n = len(table.balls)
    moving = array('velocities', velocities)
    if moving.ndim == alone and moving.shape[-1:] == (2,):
        if table.for_kernels.cue_ball > 0:
            raise ValueError(
                f'velocities: shape {moving.shape} strikes ball 0, but the cue ball is ball '
                f'{table.for_kernels.cue_ball}; give ({n}, 2) of them'
            )
        moving = moving[..., np.newaxis, :]
    elif moving.ndim != alone + 1 or moving.shape[-2:] != (n, 2):
        shots = '' if alone == 1 else 'm, '
        raise ValueError(
            f'velocities: shape {moving.shape} must be ({shots}2) for the cue ball alone or '
            f'({shots}{n}, 2)'
        )
    if alone == 2:
        check_speeds(moving)
    return for_kernels(moving)


def check_speeds(velocities: NDArray[np.float64]) -> None:
    """Raise ValueError where a ball is too fast, or not finite."""
    fastest = float(np.abs(velocities).max(initial=0.0))
    if not fastest <= MAX_SPEED:
        if not math.isfinite(fastest):
            raise ValueError(f'velocities: {velocities[~np.isfinite(velocities)][0]} is not finite')
        raise ValueError(f'velocities: {fastest:g} m/s must be at most {MAX_SPEED:g}')


def spins_for(table: Table, spins: ArrayLike | None, shots: int | None) -> NDArray[np.float64]:
    """Return spins as (k, 3), or (m, k, 3) for so many shots; k is 0 where there are none.

    Raises
    ------
    ValueError
        For a wrong shape, a value that is not finite or too large, and on a table of discs.
    """
    n = len(table.balls)
    lead = () if shots is None else (shots,)
    if spins is None:
        return NO_SPINS if shots is None else np.empty((shots, 0, 3))
    if table.motion != 'ball':
        raise ValueError("spins: discs do not spin; they need a table of motion 'ball'")
    turning = array('spins', spins)
    if shots is not None and turning.shape == (3,):
        turning = np.broadcast_to(turning, (shots, 3))
    if turning.shape == (*lead, 3):
        turning = turning[..., np.newaxis, :]
    elif turning.shape != (*lead, n, 3):
        wanted = ', '.join(map(str, lead + (3,)))
        every = ', '.join(map(str, (*lead, n, 3)))
        raise ValueError(
            f'spins: shape {turning.shape} must be ({wanted}) for the cue ball alone or ({every})'
        )
    most, radius = float(np.abs(turning).max(initial=0.0)), table.balls[0].radius
    if not most * radius <= MAX_SPEED:
        if not math.isfinite(most):
            raise ValueError(f'spins: {turning[~np.isfinite(turning)][0]} is not finite')
        raise ValueError(
            f'spins: {most * radius:g} m/s at the surface must be at most {MAX_SPEED:g}'
        )
    return for_kernels(turning)


def check_in_play(
    table: Table,
    struck: tuple[NDArray[np.float64], NDArray[np.float64]],
    layout: NDArray[np.float64] | None,
) -> None:
    """Raise ValueError where a shot strikes or spins a ball that lies in a pocket."""
    places = table.positions if layout is None else layout
    for name, values in zip(('velocities', 'spins'), struck, strict=True):
        for i in np.flatnonzero(np.any(values != 0.0, axis=-1)):
            pocket = pocket_at(table.for_kernels.boundary, *places[i])
            if pocket >= 0:
                raise ValueError(
                    f'{name}: {values[i].tolist()} is for ball {table.labels[i]!r}, which lies in '
                    f'pocket {pocket}; place it on the cloth first'
                )


def layouts_for(
    table: Table, positions: ArrayLike, shots: int | None = None
) -> NDArray[np.float64]:
    """Return a layout, (n, 2), or one for each of so many shots; raise ValueError."""
    n = len(table.balls)
    layouts = array('positions', positions)
    if layouts.shape == (n, 2) or (shots is not None and layouts.shape == (shots, n, 2)):
        return for_kernels(layouts)
    wanted = f'({n}, 2)' if shots is None else f'({n}, 2) for all shots or ({shots}, {n}, 2)'
    raise ValueError(f'positions: shape {layouts.shape} must be {wanted}')


def check_end(
    table: Table,
    velocities: NDArray[np.float64],
    until: float | None,
    integrator: str,
    time_slice: float,
) -> None:
    """Raise ValueError where balls would never come to rest."""
    if integrator == 'event' and (until is not None or table.comes_to_rest):
        return
    check_speeds(velocities)
    if until is not None:
        return
    fastest = float(np.abs(velocities).max(initial=0.0))
    if fastest == 0.0:
        return
    if not table.comes_to_rest:
        name = 'mu_ball_surface'
        if table.motion == 'ball':
            name = next(n for n in ('mu_slide', 'mu_roll', 'mu_spin') if not getattr(table, n))
        raise ValueError(f'until: None must be a time where {name} is 0: nothing ends it')
    # A light ball that a heavy one strikes is faster than either was.
    if time_slice * table.deceleration < np.spacing(1e3 * fastest):
        raise ValueError(
            f'time_slice: {time_slice} is too short: a ball at {fastest:g} m/s loses no speed in it'
        )


def raise_failed(
    table: Table,
    failed: int,
    shot: str,
    struck: tuple[NDArray[np.float64], NDArray[np.float64]],
    layout: NDArray[np.float64] | None,
    max_events: int,
) -> NoReturn:
    """Say why a shot failed; `struck` are its velocities and spins."""
    if failed == BAD_VELOCITY:
        check_speeds(struck[0])
    if failed == BAD_LAYOUT:
        if layout is not None:
            name = 'positions' if shot == 'this shot' else f'positions of {shot}'
            check_layout(table, layout, name)
        check_in_play(table, struck, layout)
    if failed == TOO_MANY_EVENTS:
        raise ShotTooLong(f'max_events: {shot} has more than {max_events} contacts and stops')
    if failed == RUNS_AWAY:
        raise ValueError(
            f"mu_ball_ball: {table.mu_ball_ball} is too large here: the law 'report' gives {shot} "
            "energy without end; make it smaller, or use the law 'coulomb'"
        )
    raise RuntimeError(f'{shot} failed with {failed}, but what it was given seems right')
