"""Tracks: where somebody saw the balls of a shot, frame by frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)
class Track:
    """One shot as somebody saw it.

    Parameters
    ----------
    times : array_like of shape (k,)
        Of the frames, s since the cue struck, rising; before 0 all balls rest.
    positions : array_like of shape (k, n, 2)
        Where the balls were seen, m; NaN where one was not.
    spin : array_like of shape (3,), optional
        A first guess of the spin that the cue gave, rad/s, as `cue_strike` returns it; without it
        that the ball rolls.

    Raises
    ------
    ValueError
        For a wrong shape, times that do not rise or are not finite.
    """

    times: NDArray[np.float64]
    positions: NDArray[np.float64]
    spin: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        times, positions = as_floats('times', self.times), as_floats('positions', self.positions)
        if times.ndim != 1 or positions.ndim != 3 or positions.shape[::2] != (len(times), 2):
            raise ValueError(
                f'track: shapes {times.shape} and {positions.shape} must be (k,) and (k, n, 2)'
            )
        if not (np.isfinite(times).all() and (np.diff(times) > 0.0).all()):
            raise ValueError('track: times must be finite and rise')
        if self.spin is not None:
            spin = as_floats('spin', self.spin)
            if spin.shape != (3,) or not np.isfinite(spin).all():
                raise ValueError(f'track: spin {spin.tolist()} must be three finite numbers')
            object.__setattr__(self, 'spin', spin)
        object.__setattr__(self, 'times', times)
        object.__setattr__(self, 'positions', positions)


def as_floats(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return an array of floats; raise ValueError, naming it, where it is none."""
    try:
        return np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f'track: {name} are not an array of numbers') from None
