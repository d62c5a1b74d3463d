"""The table and its balls: what is given before a shot."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import ball_table
from pool_sim_ros.physics.balls import Ball, checked_balls, store
from pool_sim_ros.physics.boundary import Rectangle
from pool_sim_ros.physics.cushions import Cushions, rows
from pool_sim_ros.physics.law_names import (
    DISC_FRICTION_LAWS,
    BallFriction,
    CushionModel,
    FrictionBound,
    number_of,
)
from pool_sim_ros.physics.log import SEGMENT, SPIN_SEGMENT
from pool_sim_ros.physics.motion import BallTable, DiscTable, discs_at_rest, spheres_at_rest
from pool_sim_ros.physics.tolerances import MAX_FRICTION, MIN_DECELERATION
from pool_sim_ros.physics.validation import check_layout, number

Motion = Literal['disc', 'ball']
"""How balls move, by its name: discs slide, balls also roll and spin."""
MOTIONS: tuple[Motion, ...] = get_args(Motion)
"""Both of them."""

LAWS_OF_MOTION = {'disc': DISC_FRICTION_LAWS, 'ball': ('coulomb', 'alciatore')}

MAX_SIZE = 1e4
GRAVITIES = (1e-6, 1e6)
"""Ranges in SI units, far beyond any table: within them no calculation here overflows, and a
rounding error of a position stays well below `validation.OVERLAP`."""


@dataclass(frozen=True, eq=False, repr=False)
class Table:
    """A table, the balls on it and the coefficients of their contacts.

    x runs along the length, y along the width, from the corner of the cloth.
    The cue ball is ``balls[0]``.

    Parameters
    ----------
    length, width : float
        Size of the cloth between the cushions, at most 1e4 m.
    balls : iterable of Ball
        At least one; none overlaps another or a cushion by more than 1e-9 m.
    mu_ball_ball, mu_ball_surface, mu_ball_cushion : float, optional
        Coefficients of friction, 0 to 1000. Where the cloth slows the balls at all, it does so
        by at least 1e-9 m/s^2.
    e_cue_ball, e_ball_ball, e_ball_cushion : float, optional
        Coefficients of restitution, 0 to 1: a pair with the cue ball, any
        other pair, a ball and a cushion.
    gravity : float, optional
        1e-6 to 1e6 m/s^2.
    ball_friction : {'report', 'coulomb', 'alciatore'}, optional
        The law of friction between two balls: the report's, for discs; a constant coefficient;
        or one that falls with the slip, for balls that spin, which does not use `mu_ball_ball`.
    motion : {'disc', 'ball'}, optional
        Discs slide and lose speed along their own line, by `mu_ball_surface`; balls slide, roll and
        spin, and need the four coefficients that follow.
    mu_slide, mu_roll : float, optional
        Coefficients of friction on the cloth of a ball that slides and of one that rolls.
    mu_spin : float, optional
        The spin about the vertical axis falls by ``5 mu_spin g / (2 R)``, mu_spin in m.
    nose_height : float, optional
        Of the cushions' edge above the cloth, m: between half a ball's radius and two.
    cushion_model : {'han', 'impulse', 'stronge', 'mathavan'}, optional
        What a cushion does to a ball that spins.
    friction_bound : {'impulse', 'restitution'}, optional
        What bounds the friction of two balls that spin: the normal impulse, or e times the closing
        speed, as pooltool has it.
    cushions : Cushions, optional
        Those of a table of motion 'ball' that is no plain rectangle. They must leave no gap but the
        mouths of pockets: what gets through another rolls on beyond the table.
    pockets : array_like of shape (q, 3), optional
        Centre x, y and radius of the circles in which a ball's centre is caught, m.

    Raises
    ------
    ValueError
        Where a value is missing or out of its range; names the field and the value.

    Notes
    -----
    The defaults are the report's (Listing 3). ``e_cue_ball`` is 0.70 there:
    the listing uses ``e_bc`` where its property list has ``e_cn`` = 0.95.
    """

    length: float
    width: float
    balls: tuple[Ball, ...]
    mu_ball_ball: float = 0.05
    mu_ball_surface: float = 0.10
    mu_ball_cushion: float = 0.20
    e_cue_ball: float = 0.70
    e_ball_ball: float = 0.90
    e_ball_cushion: float = 0.70
    gravity: float = 9.80665
    ball_friction: BallFriction = 'report'
    motion: Motion = 'disc'
    mu_slide: float | None = None
    mu_roll: float | None = None
    mu_spin: float | None = None
    nose_height: float | None = None
    cushion_model: CushionModel = 'han'
    friction_bound: FrictionBound = 'impulse'
    cushions: Cushions | None = None
    pockets: NDArray[np.float64] = ()  # type: ignore[assignment]

    def __post_init__(self) -> None:
        for name in ('length', 'width'):
            store(self, name, number(name, getattr(self, name), above=0.0, most=MAX_SIZE))
        store(self, 'gravity', number('gravity', self.gravity, *GRAVITIES))
        for name in ('mu_ball_ball', 'mu_ball_surface', 'mu_ball_cushion'):
            store(self, name, number(name, getattr(self, name), least=0.0, most=MAX_FRICTION))
        if 0.0 < self.deceleration < MIN_DECELERATION:
            raise ValueError(
                f'mu_ball_surface: {self.mu_ball_surface} must be 0 or at least '
                f'{MIN_DECELERATION / self.gravity:.3g}, so that the balls stop some day'
            )
        for name in ('e_cue_ball', 'e_ball_ball', 'e_ball_cushion'):
            store(self, name, number(name, getattr(self, name), least=0.0, most=1.0))
        number_of('motion', self.motion, MOTIONS)
        laws = LAWS_OF_MOTION[self.motion]
        if not isinstance(self.ball_friction, str) or self.ball_friction not in laws:
            raise ValueError(
                f'ball_friction: {self.ball_friction!r} is not a law of motion {self.motion!r}; it '
                f'must be {laws[0]!r} or {laws[1]!r}'
            )
        store(self, 'balls', checked_balls(self.balls))
        store(self, 'pockets', rows('pockets', self.pockets, 3))
        if self.motion == 'ball':
            for name, value in ball_table.checked_fields(self).items():
                store(self, name, value)
        else:
            ball_table.check_nothing_given(self)
        check_layout(self, self.positions, 'balls')

    def __repr__(self) -> str:
        return f'<Table {self.length:g} x {self.width:g} m, {self.motion}, {len(self.balls)} balls>'

    def _repr_html_(self) -> str:
        from pool_sim_ros.physics.svg import table_html

        return table_html(self)

    def __eq__(self, other: object) -> bool:
        return self._key == other._key if isinstance(other, Table) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._key)

    @cached_property
    def _key(self) -> tuple[object, ...]:
        values = (getattr(self, field.name) for field in fields(self))
        return tuple(v.tobytes() if isinstance(v, np.ndarray) else v for v in values)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the table to `path`, a JSON file."""
        from pool_sim_ros.physics.table_file import save_table

        save_table(self, path)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Table:
        """Return the table in `path`; raise ValueError, naming what is wrong in it, and OSError."""
        from pool_sim_ros.physics.table_file import load_table

        return load_table(path)

    def index(self, label: str) -> int:
        """Return the index of the ball with this `label`; raise ValueError where there is none."""
        if label not in self.labels:
            raise ValueError(
                f'label: {label!r} is not on the table; it has {", ".join(self.labels)}'
            )
        return self.labels.index(label)

    @cached_property
    def labels(self) -> tuple[str, ...]:
        """The balls' labels, in order."""
        return tuple(ball.label for ball in self.balls)

    @cached_property
    def positions(self) -> NDArray[np.float64]:
        """Start positions, (n, 2), m; read-only."""
        return _read_only([ball.position for ball in self.balls])

    @cached_property
    def radii(self) -> NDArray[np.float64]:
        """Radii, (n,), m; read-only."""
        return _read_only([ball.radius for ball in self.balls])

    @cached_property
    def masses(self) -> NDArray[np.float64]:
        """Masses, (n,), kg; read-only."""
        return _read_only([ball.mass for ball in self.balls])

    @cached_property
    def is_cue(self) -> NDArray[np.bool_]:
        """Whether each ball is the cue ball, (n,); read-only."""
        return _read_only([ball.is_cue for ball in self.balls], dtype=bool)

    @property
    def segment_type(self) -> np.dtype[np.void]:
        """The type of `Trajectory.segments`."""
        return SPIN_SEGMENT if self.motion == 'ball' else SEGMENT

    @property
    def comes_to_rest(self) -> bool:
        """Whether something slows the balls in all that they do."""
        if self.motion == 'ball':
            return bool(self.mu_slide and self.mu_roll and self.mu_spin)
        return self.deceleration > 0.0

    @property
    def deceleration(self) -> float:
        """What a moving ball loses on the cloth, m/s^2 (report, Equation 10)."""
        return self.mu_ball_surface * self.gravity

    @cached_property
    def for_kernels(self) -> DiscTable | BallTable:
        """What the kernels know of this table; its type chooses how balls move."""
        if self.motion == 'ball':
            return ball_table.for_kernels(self)
        return DiscTable(
            boundary=Rectangle(self.length, self.width),
            deceleration=self.deceleration,
            mu_ball_ball=self.mu_ball_ball,
            mu_ball_cushion=self.mu_ball_cushion,
            e_cue_ball=self.e_cue_ball,
            e_ball_ball=self.e_ball_ball,
            e_ball_cushion=self.e_ball_cushion,
            coulomb=self.ball_friction == 'coulomb',
            cue_ball=int(self.is_cue.argmax()) if self.is_cue.any() else -1,
        )

    @cached_property
    def balls_at_rest(self) -> NDArray[np.void]:
        """The kernels' records of the balls where they start, (n,); read-only."""
        records = self.records_at(self.positions)
        records.flags.writeable = False
        return records

    def records_at(self, positions: NDArray[np.float64]) -> NDArray[np.void]:
        """Return the kernels' records of the balls, (n,), at rest at `positions`, (n, 2), m."""
        if self.motion == 'ball':
            boundary = self.for_kernels.boundary
            return spheres_at_rest(positions, self.radii, self.masses, self.is_cue, boundary)
        return discs_at_rest(positions, self.radii, self.masses, self.is_cue)


def _read_only(values: Sequence[object], dtype: type = float) -> NDArray[Any]:
    array: NDArray[Any] = np.array(values, dtype=dtype)
    array.flags.writeable = False
    return array
