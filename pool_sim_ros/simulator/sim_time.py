"""Sim time: whole nanoseconds since tick 0, as ROS stamps count them, and the same in seconds."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

SECOND_NS = 1_000_000_000
"""Nanoseconds in a second."""

NANOSECOND = 1e-9
"""A nanosecond, s."""


def tick_to_stamp(tick: int, rate: int) -> int:
    """Return the sim time of a tick, ns, rounded down.

    Parameters
    ----------
    tick : int
        Its number, from 0.
    rate : int
        Ticks per second of sim time.
    """
    return tick * SECOND_NS // rate


@overload
def stamp_to_seconds(stamp: int) -> float: ...
@overload
def stamp_to_seconds(stamp: NDArray[np.int64]) -> NDArray[np.float64]: ...
def stamp_to_seconds(stamp: Any) -> Any:
    """Return a stamp in ns, or an array of them, in s."""
    return stamp * NANOSECOND


def seconds_to_stamp(seconds: float) -> int:
    """Return the nearest stamp, ns, to a sim time in s."""
    return round(seconds * SECOND_NS)
