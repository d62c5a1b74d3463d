"""Checks of actions: anything may come out of a policy."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray


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
