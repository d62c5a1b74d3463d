"""What may be swept, by name: the strike, the spin, places of balls, coefficients of the table."""

from __future__ import annotations

import difflib
import reprlib
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, NamedTuple

from pool_sim_ros.physics import Table
from pool_sim_ros.study.ranges import Range, checked_range, row_of


class Known(NamedTuple):
    """Unit and meaning of an input."""

    units: str
    meaning: str


STRIKES: dict[str, dict[str, Known]] = {
    'polar': {
        'angle': Known('degree', 'direction of the cue ball, counterclockwise from +x'),
        'speed': Known('m/s', 'speed of the cue ball'),
    },
    'xy': {
        'vx': Known('m/s', 'velocity of the cue ball along x'),
        'vy': Known('m/s', 'velocity of the cue ball along y'),
    },
    'cue': {
        'cue_speed': Known('m/s', 'speed of the cue before the impact'),
        'azimuth': Known('degree', 'where the cue points, counterclockwise from +x'),
        'elevation': Known('degree', 'elevation of the butt of the cue'),
        'side': Known('radius', 'where the tip hits, to the left of the middle'),
        'above': Known('radius', 'where the tip hits, above the middle'),
    },
}
"""The three ways to strike, each with its inputs."""

LEFT_OUT = {'elevation': 0.0, 'side': 0.0, 'above': 0.0}
"""Those of a cue that need not be given."""

SPINS = {
    f'w{axis}': Known('rad/s', f'spin of the cue ball about {axis}') for axis in ('x', 'y', 'z')
}

JITTER = Known('m', 'standard deviation of x and y of each ball, drawn for each shot')

COEFFICIENT_UNITS = {'gravity': 'm/s^2', 'mu_spin': 'm', 'nose_height': 'm'}
"""Of those coefficients that have one."""

LAYOUT = 'layout'
"""The dimension of a sweep through layouts of all balls."""

ARGUMENTS = (
    *('velocity', 'spin', 'cue', 'place', 'positions', 'samples', 'seed', 'out', 'keep', 'balls'),
    *('chunk', 'scheduler', 'workers', 'progress'),
)
"""Of `sweep`, for whoever misspells one."""

Inputs = dict[str, Range]


def polar(angle: Any, speed: Any) -> dict[str, Any]:
    """Return a velocity by direction and speed.

    Parameters
    ----------
    angle : float, array_like of shape (k,), uniform or normal
        Degrees, counterclockwise from +x.
    speed : float, array_like of shape (k,), uniform or normal
        m/s.
    """
    return {'angle': angle, 'speed': speed}


def xy(x: Any, y: Any) -> dict[str, Any]:
    """Return a velocity in m/s, or a place in m, by its coordinates.

    Parameters
    ----------
    x, y : float, array_like of shape (k,), uniform or normal
        m/s, or m.
    """
    return {'x': x, 'y': y}


def xyz(x: Any = 0.0, y: Any = 0.0, z: Any = 0.0) -> dict[str, Any]:
    """Return a spin by its coordinates.

    Parameters
    ----------
    x, y, z : float, array_like of shape (k,), uniform or normal
        rad/s, z up.
    """
    return {'x': x, 'y': y, 'z': z}


def cue(
    speed: Any, azimuth: Any, elevation: Any = 0.0, side: Any = 0.0, above: Any = 0.0
) -> dict[str, Any]:
    """Return a stroke of the cue, as `cue_strike` takes it.

    Parameters
    ----------
    speed : float, array_like of shape (k,), uniform or normal
        m/s.
    azimuth, elevation : float, array_like of shape (k,), uniform or normal
        Degrees.
    side, above : float, array_like of shape (k,), uniform or normal
        Offsets of the tip, radii of the ball.
    """
    values = {'azimuth': azimuth, 'elevation': elevation, 'side': side, 'above': above}
    return {'cue_speed': speed, **values}


def coefficients_of(table: Table) -> tuple[str, ...]:
    """Return the names of the coefficients that a table has, all numbers."""
    size = ('length', 'width')
    names = (field.name for field in fields(table) if field.name not in size)
    return tuple(name for name in names if isinstance(getattr(table, name), float))


def known_inputs(table: Table) -> dict[str, Known]:
    """Return all inputs that a sweep of this table may have."""
    known = {name: each for kind in STRIKES.values() for name, each in kind.items()}
    if table.motion == 'ball':
        known |= SPINS
    for label in table.labels:
        known |= {f'{axis}_{label}': Known('m', f'{axis} of ball {label}') for axis in 'xy'}
    known['jitter'] = JITTER
    for name in coefficients_of(table):
        known[name] = Known(COEFFICIENT_UNITS.get(name, '1'), 'coefficient of the table')
    return known


def named_inputs(
    velocity: Any, spin: Any, cue: Any, place: Any, coefficients: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the arguments of `sweep` as inputs by name; raise ValueError for a wrong kind."""
    found: dict[str, Any] = {}
    if velocity is not None:
        parts = _parts('velocity', velocity, 'polar() or xy()', 2)
        found |= {{'x': 'vx', 'y': 'vy'}.get(name, name): part for name, part in parts.items()}
    if cue is not None:
        found |= _parts('cue', cue, 'cue()', 5)
    if spin is not None:
        found |= {f'w{k}': part for k, part in _parts('spin', spin, 'xyz()', 3).items()}
    if place is not None:
        if not isinstance(place, Mapping):
            raise ValueError(
                f"place: {reprlib.repr(place)} must be as in {{'9': xy(x=..., y=...)}}"
            )
        for label, where in place.items():
            parts = _parts(f'place of ball {label!r}', where, 'xy()', 2)
            found |= {f'{axis}_{label}': part for axis, part in parts.items()}
    return {**found, **coefficients}


def checked_inputs(table: Table, given: Mapping[str, Any]) -> Inputs:
    """Return the inputs of a sweep, in the order of its dimensions.

    Those of the table come first: all shots on one table are played in one call.

    Raises
    ------
    ValueError
        For a name that is none, a partner that is missing, and a value that cannot be.
    """
    known = known_inputs(table)
    for name in given:
        if name not in known:
            near = difflib.get_close_matches(name, [*known, *ARGUMENTS], 1)
            hint = f'; did you mean {near[0]}?' if near else ';'
            there = ', '.join(n for n in known if not n.startswith(('x_', 'y_')))
            raise ValueError(
                f'{name}: there is no such input{hint} there are {there}, x_LABEL, y_LABEL'
            )
    strike = strike_of(given)
    if strike == 'cue' and any(name in given for name in SPINS):
        raise ValueError('spin: a cue gives the ball its spin; give one of both')
    filled = {**given, **{k: v for k, v in LEFT_OUT.items() if strike == 'cue' and k not in given}}
    for name in STRIKES[strike]:
        if name not in filled:
            raise ValueError(f'{name}: it is missing; {" and ".join(STRIKES[strike])} go together')
    for label in table.labels:
        if (f'x_{label}' in given) != (f'y_{label}' in given):
            raise ValueError(f'place of ball {label!r}: give both of x_{label} and y_{label}')
    coefficients = set(coefficients_of(table))
    ordered = sorted(filled, key=lambda name: name not in coefficients)
    return {name: checked_range(name, filled[name]) for name in ordered}


def strike_of(names: Mapping[str, Any]) -> str:
    """Return which of `STRIKES` these inputs are; raise ValueError unless there is exactly one."""
    kinds = [kind for kind, inputs in STRIKES.items() if any(name in names for name in inputs)]
    if not kinds:
        raise ValueError(
            'velocity: it is missing; give velocity=polar(angle=..., speed=...), '
            'velocity=xy(x=..., y=...) or cue=cue(speed=..., azimuth=...)'
        )
    if len(kinds) > 1:
        raise ValueError(f'velocity: it is given twice, as {" and as ".join(kinds)}')
    return kinds[0]


def rows_of(inputs: Inputs) -> dict[str, int]:
    """Return the dimensions that the inputs make, and how long each is."""
    rows = {name: row_of(given) for name, given in inputs.items()}
    return {name: len(row) for name, row in rows.items() if row is not None}


def _parts(name: str, given: Any, maker: str, most: int) -> dict[str, Any]:
    if isinstance(given, Mapping):
        return dict(given)
    try:
        values = list(given)
    except TypeError:
        values = []
    if name == 'cue' or len(values) != most:
        raise ValueError(f'{name}: {reprlib.repr(given)} must be made by {maker}')
    return dict(zip('xyz', values, strict=False))
