"""Checks of what is given: anything may come out of a policy."""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table, check_layout


def checked_actions(actions: Any, shape: tuple[int, ...] | None) -> NDArray[np.float64]:
    """Return actions as an array of this shape; raise ValueError where they are none."""
    try:
        given = np.asarray(actions, dtype=np.float64)
    except (TypeError, ValueError):
        raise ValueError(f'action: {actions!r} is not an array of numbers') from None
    if given.shape != shape:
        raise ValueError(f'action: shape {given.shape} must be {shape}, numbers from -1 to 1')
    # The sum is quickly found; where it is finite, so is each of them.
    if not math.isfinite(given.sum()) and not np.isfinite(given).all():
        raise ValueError(f'action: {given[~np.isfinite(given)][0]} is not a number from -1 to 1')
    return given


def positive(name: str, value: Any, unit: str, most: float = math.inf) -> float:
    """Return a number above 0; raise ValueError, naming it, where it is none or above `most`."""
    try:
        given = float(value)
    except (TypeError, ValueError):
        given = math.nan
    if not 0.0 < given <= most or math.isinf(given):
        bound = f' and at most {most:g}' if math.isfinite(most) else ''
        raise ValueError(f'{name}: {value!r} must be above 0{bound} {unit}')
    return given


def counted(name: str, value: Any, least: int = 1) -> int:
    """Return a whole number; raise ValueError, naming it, where it is none or below `least`."""
    try:
        given = -1 if isinstance(value, bool) else operator.index(value)
    except TypeError:
        given = -1
    if given < least:
        raise ValueError(f'{name}: {value!r} must be a whole number, at least {least}')
    return given


def checked_layouts(name: str, table: Table, given: Any, or_else: str = '') -> NDArray[np.float64]:
    """Return layouts of a table, (k, n, 2) in m; raise ValueError where they are none.

    A single one, (n, 2), is a row of one. `or_else` tells what else may be given.
    """
    n = len(table.balls)
    try:
        layouts = np.array(given, dtype=float)
    except (TypeError, ValueError):
        layouts = np.empty(0)
    if layouts.shape == (n, 2):
        layouts = layouts[np.newaxis]
    if layouts.ndim != 3 or layouts.shape[1:] != (n, 2) or not len(layouts):
        raise ValueError(f'{name}: must be {or_else}layouts of shape ({n}, 2) or (k, {n}, 2), in m')
    for k, layout in enumerate(layouts):
        check_layout(table, layout, f'{name}[{k}]')
    return layouts
