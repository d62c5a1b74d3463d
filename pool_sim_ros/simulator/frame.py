"""What a tick shows: the balls, the collisions since the tick before, and their columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

COLLISION_COLUMNS = ('seq', 't', 'kind', 'a', 'b', 'x', 'y', 'nx', 'ny', 'speed')
"""Columns of `Frame.collisions` and of `~/collisions`.

seq counts from 0 and is never reset; t is sim time, s. Kind 0 is ball a on ball b, kind 1 is ball a
on cushion b (0: x = 0, 1: x = length, 2: y = 0, 3: y = width; where cushions are given their row,
straight ones first, then noses), kind 3 is ball a caught in pocket b. x, y is the point of contact,
or the centre of the ball that is caught, m; nx, ny the unit vector from a to b, into the cushion or
to the pocket's centre; speed that of closing, or that of the ball, m/s.
"""

VELOCITY_COLUMNS = ('vx', 'vy')
SPIN_COLUMNS = (*VELOCITY_COLUMNS, 'wx', 'wy', 'wz')
"""Columns of `Frame.velocities` and of `~/ball_velocities`, m/s: of discs, and of balls that spin,
with their spins in rad/s."""


def velocity_columns(motion: str) -> tuple[str, ...]:
    """Return the columns of `Frame.velocities` on a table of this motion."""
    return SPIN_COLUMNS if motion == 'ball' else VELOCITY_COLUMNS


NO_COLLISIONS: NDArray[np.float64] = np.empty((0, len(COLLISION_COLUMNS)))
"""The collisions of a tick that has none."""


@dataclass(eq=False, slots=True)
class Block:
    """What a row of ticks shows, unless a command changes it.

    Attributes
    ----------
    first_tick, end_tick : int
        The first tick, and the one after the last.
    stamps : list of int
        Sim time of each tick, ns.
    positions : ndarray of shape (m, n, 2)
        m. While the balls rest, every block has the same array.
    velocities : ndarray of shape (m, n, 2) or (m, n, 5)
        In the columns `VELOCITY_COLUMNS`, or `SPIN_COLUMNS`.
    collisions : list of ndarray of shape (k, 10)
        The collisions of each tick, as in `Frame.collisions`.
    moving : bool
        Whether the balls move.
    ends_shot : bool
        Whether the last tick is the first in which all balls are at rest again.
    orientations : ndarray of shape (m, n, 4), or None
        Unit quaternions x, y, z, w; None where balls are discs.
    pocketed : list of tuple of int
        The balls in pockets at each tick, in the order in which they fell.
    """

    first_tick: int
    end_tick: int
    stamps: list[int]
    positions: NDArray[np.float64]
    velocities: NDArray[np.float64]
    collisions: list[NDArray[np.float64]]
    moving: bool = False
    ends_shot: bool = False
    orientations: NDArray[np.float64] | None = None
    pocketed: Sequence[tuple[int, ...]] = ()


@dataclass(eq=False, slots=True)
class Frame:
    """What one tick shows.

    Attributes
    ----------
    block : Block
        The ticks that were looked up together with it.
    index : int
        Its index in the block.
    tick : int
        Its number, from 0.
    collisions : ndarray of shape (k, 10)
        Collisions since the frame before, in the columns `COLLISION_COLUMNS`; each is at or before
        this frame's stamp.
    started, finished : bool
        Whether this is a shot's first frame, or the first in which all balls are at rest again.
    """

    block: Block
    index: int
    tick: int
    collisions: NDArray[np.float64]
    started: bool = False
    finished: bool = False

    @property
    def stamp(self) -> int:
        """Its sim time, ns."""
        return self.block.stamps[self.index]

    @property
    def positions(self) -> NDArray[np.float64]:
        """Positions of the balls, (n, 2), m."""
        positions: NDArray[np.float64] = self.block.positions[self.index]
        return positions

    @property
    def velocities(self) -> NDArray[np.float64]:
        """Velocities of the balls, (n, 2), m/s, or (n, 5) with their spins, rad/s."""
        velocities: NDArray[np.float64] = self.block.velocities[self.index]
        return velocities

    @property
    def orientations(self) -> NDArray[np.float64] | None:
        """Unit quaternions of the balls, (n, 4); None where they are discs."""
        turned = self.block.orientations
        return None if turned is None else turned[self.index]

    @property
    def pocketed(self) -> tuple[int, ...]:
        """The balls in pockets, in the order in which they fell."""
        return self.block.pocketed[self.index] if self.block.pocketed else ()

    @property
    def moving(self) -> bool:
        """Whether any ball moves."""
        return self.block.moving and not self.finished
