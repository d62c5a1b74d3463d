"""Checks of what a caller gives, with messages that name the mistake."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics import Table


def whole(name: str, value: object, least: int = 0) -> int:
    """Return a whole number; raise ValueError, naming it, where it is none or too small."""
    if isinstance(value, bool) or not hasattr(value, '__index__'):
        raise ValueError(f'{name}: {value!r} is not a whole number')
    number = int(value.__index__())
    if not least <= number < 2**63:
        raise ValueError(f'{name}: {number} must be at least {least} and below 2**63')
    return number


def time_allowed(seconds: Any) -> float:
    """Return how long a search may take, s; raise ValueError for what is no such time."""
    if seconds is None:
        return np.inf
    try:
        allowed = float(seconds)
    except (TypeError, ValueError):
        raise ValueError(f'seconds: {seconds!r} is not a number') from None
    if not allowed > 0.0:
        raise ValueError(f'seconds: {allowed} must be above 0')
    return allowed


def checked_positions(table: Table, positions: ArrayLike | None) -> NDArray[np.float64]:
    """Return where the balls lie, (n, 2) in m; raise ValueError for another shape."""
    if positions is None:
        return np.array(table.positions)
    try:
        places = np.array(positions, dtype=float)
    except (TypeError, ValueError):
        raise ValueError('positions: they are not an array of numbers') from None
    if places.shape != table.positions.shape:
        raise ValueError(f'positions: shape {places.shape} must be {table.positions.shape}')
    return places
