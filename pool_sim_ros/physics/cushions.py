"""`Cushions`: what bounds a table that is no plain rectangle, as numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics.tolerances import UNIT_LENGTH
from pool_sim_ros.physics.validation import array


@dataclass(frozen=True, eq=False)
class Cushions:
    """Straight cushions and the round noses between them.

    Equal where all numbers are equal. The arrays are read-only.

    Parameters
    ----------
    segments : array_like of shape (k, 6)
        Rows of x0, y0, x1, y1, the ends of a straight cushion, m, and its unit normal into the
        table.
    noses : array_like of shape (p, 3)
        Rows of x, y and radius of a round nose, m; the radius of a point is 0.

    Raises
    ------
    ValueError
        Where a shape is wrong, a number is not finite, a normal is not a unit vector across its
        segment, or a radius is negative; names the row.
    """

    segments: NDArray[np.float64]
    noses: NDArray[np.float64]

    def __post_init__(self) -> None:
        segments = rows('cushions.segments', self.segments, 6)
        noses = rows('cushions.noses', self.noses, 3)
        for k, (x0, y0, x1, y1, nx, ny) in enumerate(segments.tolist()):
            length = float(np.hypot(x1 - x0, y1 - y0))
            if length == 0.0:
                raise ValueError(f'cushions.segments[{k}]: both ends are ({x0:g}, {y0:g}) m')
            across = abs((x1 - x0) * nx + (y1 - y0) * ny) / length
            if abs(float(np.hypot(nx, ny)) - 1.0) > UNIT_LENGTH or across > UNIT_LENGTH:
                raise ValueError(
                    f'cushions.segments[{k}]: ({nx}, {ny}) is not the unit normal of the segment'
                )
        check_radii('cushions.noses', noses)
        object.__setattr__(self, 'segments', segments)
        object.__setattr__(self, 'noses', noses)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Cushions) and self._bytes == other._bytes

    def __hash__(self) -> int:
        return hash(self._bytes)

    @property
    def _bytes(self) -> tuple[bytes, bytes]:
        # Adding 0 makes -0 and 0 alike.
        return (self.segments + 0.0).tobytes(), (self.noses + 0.0).tobytes()


def rows(name: str, values: ArrayLike, columns: int) -> NDArray[np.float64]:
    """Return a read-only array of rows; raise ValueError where its shape or a number is wrong."""
    given = array(name, values)
    if given.size == 0:
        given = given.reshape(0, columns)
    if given.ndim != 2 or given.shape[1] != columns:
        raise ValueError(f'{name}: an array of shape {given.shape} must have shape (n, {columns})')
    bad = ~np.isfinite(given).all(axis=1)
    if bad.any():
        k = int(bad.argmax())
        raise ValueError(f'{name}[{k}]: {given[k].tolist()} is not finite')
    copy = given.copy()
    copy.flags.writeable = False
    return copy


def check_radii(name: str, circles: NDArray[np.float64]) -> None:
    """Raise ValueError, naming the row, where the radius of a circle (x, y, radius) is negative."""
    for k, radius in enumerate(circles[:, 2].tolist()):
        if radius < 0.0:
            raise ValueError(f'{name}[{k}]: radius {radius} must be at least 0')
