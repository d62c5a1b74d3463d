"""What an input of a sweep may be: one value, a row of values, or a random number for each shot."""

from __future__ import annotations

import re
import reprlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

LONGEST = 100_000_000
"""Values of a row at most: it stands in the memory of each worker."""


@dataclass(frozen=True)
class Uniform:
    """Random numbers, all between two equally likely; `uniform` makes one."""

    low: float
    high: float


@dataclass(frozen=True)
class Normal:
    """Normally distributed random numbers; `normal` makes one.

    `mean` is one number, or a row of them, which the sweep then goes through.
    """

    mean: float | Floats
    deviation: float


Range = float | Floats | Uniform | Normal
"""A number, a row of numbers (k,), or random ones."""


def uniform(low: float, high: float) -> Uniform:
    """Return an input that is drawn for each shot, from `low` up to `high`.

    Parameters
    ----------
    low, high : float
        In units of the input.

    Raises
    ------
    ValueError
        Where one is not finite, or `low` is not below `high`.
    """
    least, most = _number('uniform', low), _number('uniform', high)
    if not least < most:
        raise ValueError(f'uniform: {least:g} must be below {most:g}')
    return Uniform(least, most)


def normal(mean: ArrayLike, deviation: float) -> Normal:
    """Return an input that is drawn for each shot from a normal distribution.

    Parameters
    ----------
    mean : float or array_like of shape (k,)
        In units of the input. The sweep goes through a row of means.
    deviation : float
        The standard deviation, 0 or more, in units of the input.

    Raises
    ------
    ValueError
        Where one is not finite, or the deviation is below 0.
    """
    spread = _number('normal', deviation)
    if spread < 0.0:
        raise ValueError(f'normal: deviation {spread:g} must be at least 0')
    middle = checked_range('normal', mean)
    assert not isinstance(middle, (Uniform, Normal))
    return Normal(middle, spread)


def checked_range(name: str, given: Any) -> Range:
    """Return what an input may be; raise ValueError, naming it, for anything else."""
    if isinstance(given, (Uniform, Normal)):
        if name == 'normal':
            raise ValueError('normal: its mean must be a number or a row of numbers')
        return given
    try:
        values = np.array(given, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(
            f'{name}: {reprlib.repr(given)} must be a number, a row of them, uniform() or normal()'
        ) from None
    if values.ndim > 1 or not values.size:
        raise ValueError(f'{name}: shape {values.shape} must be () or (k,), of at least one number')
    if values.size > LONGEST:
        raise ValueError(f'{name}: {values.size} values must be at most {LONGEST}')
    if not np.isfinite(values).all():
        raise ValueError(f'{name}: {values[~np.isfinite(values)].flat[0]} is not finite')
    if values.ndim == 0:
        return float(values)
    if len(np.unique(values)) < len(values):
        raise ValueError(f'{name}: a value stands twice in {reprlib.repr(values.tolist())}')
    values.flags.writeable = False
    return values


def row_of(given: Range) -> Floats | None:
    """Return the values that a sweep goes through, or None where there is no row."""
    middle = given.mean if isinstance(given, Normal) else given
    return middle if isinstance(middle, np.ndarray) else None


def is_random(given: Range) -> bool:
    """Return whether it is drawn for each shot."""
    return isinstance(given, (Uniform, Normal))


def range_of_text(name: str, text: str) -> Range:
    """Return what somebody typed.

    ``2.5``, ``1,2,4``, ``0:360:721`` (721 values from 0 to 360), ``uniform(0,360)``,
    ``normal(2,0.1)`` or ``normal(0:360:721,0.1)``.

    Raises
    ------
    ValueError
        Where it is none of these; names the input.
    """
    drawn = re.fullmatch(r'\s*(uniform|normal)\((.*),([^,]*)\)\s*', text)
    try:
        if drawn is None:
            return checked_range(name, _row_of_text(text))
        law, first, second = drawn.groups()
        if law == 'uniform':
            return uniform(float(first), float(second))
        return normal(_row_of_text(first), float(second))
    except ValueError as error:
        why = str(error)
        if 'could not convert' in why:
            why = 'is not as in 2.5  1,2,4  0:360:721  uniform(0,360)  normal(2,0.1)'
        raise ValueError(f'{name}={text}: {why}') from None


def _row_of_text(text: str) -> ArrayLike:
    if ':' in text:
        parts = text.split(':')
        if len(parts) != 3 or not parts[2].strip().isdigit() or not 1 <= int(parts[2]) <= LONGEST:
            raise ValueError('a row is FIRST:LAST:COUNT, as in 0:360:721')
        return np.linspace(float(parts[0]), float(parts[1]), int(parts[2]))
    values = [float(part) for part in text.split(',')]
    return values if ',' in text else values[0]


def _number(name: str, given: Any) -> float:
    try:
        number = float(given)
    except (TypeError, ValueError):
        raise ValueError(f'{name}: {reprlib.repr(given)} is not a number') from None
    if not np.isfinite(number):
        raise ValueError(f'{name}: {number} is not finite')
    return number
