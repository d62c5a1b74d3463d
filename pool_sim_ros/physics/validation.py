"""Checks of what is given, with messages that name what was wrong and what would be right."""

from __future__ import annotations

import math
import operator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics.boundary import is_outside, pocket_at
from pool_sim_ros.physics.jit import for_kernels, kernel
from pool_sim_ros.physics.tolerances import OVERLAP

if TYPE_CHECKING:
    from pool_sim_ros.physics.table import Table


MOST_SHOWN = 160
"""Characters of a wrong value that a message shows: it is to stay one line."""


def shown(value: object) -> str:
    """Return a value as a message shows it: on one line, and not all of it where it is long."""
    text = ' '.join(repr(value).split())
    return text if len(text) <= MOST_SHOWN else f'{text[: MOST_SHOWN - 3]}...'


def number(
    name: str,
    value: object,
    least: float = -math.inf,
    most: float = math.inf,
    above: float = -math.inf,
) -> float:
    """Return `value` as a float; raise ValueError, naming it, where it is no number in range."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise ValueError(f'{name}: {shown(value)} is not a number') from None
    except OverflowError:
        raise ValueError(f'{name}: {shown(value)} is too large') from None
    if not math.isfinite(number):
        raise ValueError(f'{name}: {number} is not finite')
    if number <= above:
        raise ValueError(f'{name}: {number} must be above {above:g}')
    if number < least:
        raise ValueError(f'{name}: {number} must be at least {least:g}')
    if number > most:
        raise ValueError(f'{name}: {number} must be at most {most:g}')
    return number


def whole_number(name: str, value: object, least: int) -> int:
    """Return `value` as an int; raise ValueError, naming it, where it is none or too small."""
    try:
        whole = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise ValueError(f'{name}: {shown(value)} is not a whole number') from None
    if not least <= whole < 2**63:
        raise ValueError(f'{name}: {whole} must be at least {least} and below 2**63')
    return whole


def numbers(
    name: str, values: object, count: int, least: float = -math.inf, most: float = math.inf
) -> tuple[float, ...]:
    """Return `values` as floats; raise ValueError where they are not `count` numbers in range."""
    try:
        items: tuple[object, ...] = tuple(values)  # type: ignore[arg-type]
    except TypeError:
        items = ()
    if isinstance(values, str) or len(items) != count:
        raise ValueError(f'{name}: {shown(values)} must be {count} numbers')
    return tuple(number(name, item, least, most) for item in items)


def array(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return `values` as an array of floats; raise ValueError, naming it, where it is none."""
    try:
        given = np.asarray(values)
        if given.dtype == np.float64:
            return given
        if given.dtype.kind == 'c':
            raise TypeError
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f'{name}: {shown(values)} is not an array of numbers') from None


def check_layout(table: Table, positions: NDArray[np.float64], name: str = 'positions') -> None:
    """Raise ValueError, naming the ball, where one is outside, in another or not finite.

    Parameters
    ----------
    table : Table
        Whose balls are to lie there.
    positions : ndarray of shape (n, 2)
        m.
    name : str, optional
        What the positions are called in the message.

    Raises
    ------
    ValueError
    """
    i, j = _fault(table, positions)
    if i >= 0:
        raise ValueError(f'{name}: {describe_fault(table, positions, i, j)}')


def is_bad(table: Table, positions: NDArray[np.float64]) -> bool:
    """Return whether `check_layout` would raise."""
    return _fault(table, positions)[0] >= 0


def _fault(table: Table, positions: NDArray[np.float64]) -> tuple[int, int]:
    order = np.argsort(positions[:, 0])
    return first_fault(for_kernels(positions), table.radii, table.for_kernels.boundary, order)


def describe_fault(table: Table, positions: NDArray[np.float64], i: int, j: int) -> str:
    """Say in one line what `first_fault` found."""
    x, y = positions[i]
    labels, radii = table.labels, table.radii
    if j >= 0:
        depth = radii[i] + radii[j] - np.hypot(*(positions[j] - positions[i]))
        return f'ball {labels[i]!r} and ball {labels[j]!r} overlap by {depth:.3g} m'
    if not (np.isfinite(x) and np.isfinite(y)):
        return f'ball {labels[i]!r} is at ({x}, {y}), which is not finite'
    return (
        f'ball {labels[i]!r} of radius {radii[i]:g} m is at ({x:g}, {y:g}) m, outside the table of '
        f'{table.length:g} x {table.width:g} m'
    )


@kernel
def first_fault(
    positions: NDArray[np.float64],
    radii: NDArray[np.float64],
    boundary: Any,
    order: NDArray[np.int64],
) -> tuple[int, int]:
    """Return (i, -1) for a ball outside, (i, j) for two that overlap, (-1, -1) for none.

    Sweeps along x, in which `order`, (n,), sorts the balls, so that a large table costs little.
    Positions are (n, 2) and radii (n,), in m.
    """
    n = len(positions)
    widest = 0.0
    for i in range(n):
        if is_outside(boundary, positions[i, 0], positions[i, 1], radii[i], OVERLAP):
            return i, -1
        widest = max(widest, radii[i])
    for k in range(n):
        i = order[k]
        for m in range(k + 1, n):
            j = order[m]
            dx = positions[j, 0] - positions[i, 0]
            if dx > radii[i] + widest:
                break
            dy = positions[j, 1] - positions[i, 1]
            least = radii[i] + radii[j] - OVERLAP
            if least > 0.0 and dx * dx + dy * dy < least * least:
                # What lies in a pocket touches nothing.
                caught = pocket_at(boundary, positions[i, 0], positions[i, 1]) >= 0
                if not (caught or pocket_at(boundary, positions[j, 0], positions[j, 1]) >= 0):
                    return min(i, j), max(i, j)
    return -1, -1
