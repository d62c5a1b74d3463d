"""The aims among which a shot is sought."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import MISCUE_OFFSET, Table

FINEST = np.array([1e-3, 5e-3, 1e-2, 1e-3, 1e-3])
"""Steps of a stroke (m/s, degrees, radii) below which nobody's aim is told apart: a search for
somebody without noise takes these."""


@dataclass(frozen=True)
class Space:
    """Speeds and offsets of the tip among which a shot is sought; the azimuth is free.

    Parameters
    ----------
    speeds : (float, float)
        Least and greatest, m/s.
    offset : float
        Greatest offset of the tip, radii; 0: the middle alone.
    """

    speeds: tuple[float, float]
    offset: float

    @property
    def searched(self) -> NDArray[np.int64]:
        """Which numbers of a stroke are sought."""
        return np.array([0, 1] if self.offset == 0.0 else [0, 1, 3, 4])

    @property
    def tips(self) -> NDArray[np.float64]:
        """Offsets of the tip that are swept, (k, 2), radii: the middle, and eight round it."""
        if self.offset == 0.0:
            return np.zeros((1, 2))
        angles = np.radians(45.0 * np.arange(8))
        ring = 0.65 * self.offset * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        return np.concatenate([np.zeros((1, 2)), ring])

    def within(self, aims: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the nearest aims, (..., 5), that are in the space; azimuths from 0 to 360."""
        aims = aims.copy()
        aims[..., 0] = np.clip(aims[..., 0], *self.speeds)
        aims[..., 1] %= 360.0
        aims[..., 2] = 0.0
        away = np.hypot(aims[..., 3], aims[..., 4])
        aims[..., 3:] *= np.where(away > self.offset, self.offset / np.maximum(away, 1e-300), 1.0)[
            ..., None
        ]
        return aims

    def distinct(
        self,
        aims: NDArray[np.float64],
        order: NDArray[np.int64],
        keep: int,
        apart: NDArray[np.float64],
    ) -> NDArray[np.int64]:
        """Return the first so many of `order` whose distance, in units of `apart`, is at least 1.

        `apart`, (5,), is how far one number of a stroke alone would have to differ.
        """
        chosen: list[int] = []
        columns = self.searched
        for index in order:
            away = aims[chosen][:, columns] - aims[index, columns]
            away[:, 1] = (away[:, 1] + 180.0) % 360.0 - 180.0
            if not (((away / apart[columns]) ** 2).sum(axis=1) < 1.0).any():
                chosen.append(int(index))
            if len(chosen) == keep:
                break
        return np.array(chosen, np.int64)


def checked_space(table: Table, speeds: object, offset: object) -> Space:
    """Return a space; raise ValueError, naming what is wrong, where there is none such."""
    try:
        low, high = (float(speed) for speed in speeds)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        raise ValueError(f'speeds: {speeds!r} must be the least and the greatest, m/s') from None
    if not 0.0 <= low < high <= 1e3:
        raise ValueError(f'speeds: ({low:g}, {high:g}) must rise, from 0 or more to at most 1000')
    try:
        most = float(offset)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise ValueError(f'offset: {offset!r} is not a number') from None
    if not 0.0 <= most <= MISCUE_OFFSET:
        raise ValueError(f'offset: {most:g} must be at least 0 and at most {MISCUE_OFFSET:g} radii')
    if most > 0.0 and table.motion != 'ball':
        raise ValueError("offset: discs do not spin; it needs a table of motion 'ball'")
    return Space((low, high), most)
