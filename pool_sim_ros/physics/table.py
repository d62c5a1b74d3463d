"""The table and its balls: what is given before a shot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import Rectangle
from pool_sim_ros.physics.motion import DiscTable, balls_at_rest
from pool_sim_ros.physics.validation import check_layout, number, numbers

BallFriction = Literal['report', 'coulomb']
BALL_FRICTION_LAWS: tuple[BallFriction, ...] = get_args(BallFriction)

MASSES = (1e-9, 1e9)
RADII = (1e-6, 1e3)
MAX_SIZE = 1e4
GRAVITIES = (1e-6, 1e6)
MAX_FRICTION = 1e3
MIN_DECELERATION = 1e-9
"""Ranges in SI units, far beyond any table: within them no calculation here overflows, and a
rounding error of a position stays well below `validation.OVERLAP`."""


@dataclass(frozen=True)
class Ball:
    """A ball and where it starts.

    Parameters
    ----------
    label : str
        What is written on it, unique on its table.
    mass : float
        1e-9 to 1e9 kg.
    radius : float
        1e-6 to 1e3 m.
    position : tuple of float
        Centre (x, y) on the cloth, m.
    color : tuple of float, optional
        Red, green, blue, each 0 to 1.
    is_cue : bool, optional
        Whether contacts with this ball use the cue ball's restitution.

    Raises
    ------
    ValueError
        Where a value is not finite or out of its range.
    """

    label: str
    mass: float
    radius: float
    position: tuple[float, float]
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    is_cue: bool = False

    def __post_init__(self) -> None:
        name = f'ball {self.label!r}'
        if not isinstance(self.label, str) or not self.label:
            raise ValueError(f'{name}: label must be a non-empty string')
        _store(self, 'mass', number(f'{name}: mass', self.mass, *MASSES))
        _store(self, 'radius', number(f'{name}: radius', self.radius, *RADII))
        _store(self, 'position', numbers(f'{name}: position', self.position, 2))
        _store(self, 'color', numbers(f'{name}: color', self.color, 3, 0.0, 1.0))
        _store(self, 'is_cue', bool(self.is_cue))


@dataclass(frozen=True)
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
    ball_friction : {'report', 'coulomb'}, optional
        The law of friction between two balls.

    Raises
    ------
    ValueError
        Where a value is out of its range; names the field and the value.

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

    def __post_init__(self) -> None:
        for name in ('length', 'width'):
            _store(self, name, number(name, getattr(self, name), above=0.0, most=MAX_SIZE))
        _store(self, 'gravity', number('gravity', self.gravity, *GRAVITIES))
        for name in ('mu_ball_ball', 'mu_ball_surface', 'mu_ball_cushion'):
            _store(self, name, number(name, getattr(self, name), least=0.0, most=MAX_FRICTION))
        if 0.0 < self.deceleration < MIN_DECELERATION:
            raise ValueError(
                f'mu_ball_surface: {self.mu_ball_surface} must be 0 or at least '
                f'{MIN_DECELERATION / self.gravity:.3g}, so that the balls stop some day'
            )
        for name in ('e_cue_ball', 'e_ball_ball', 'e_ball_cushion'):
            _store(self, name, number(name, getattr(self, name), least=0.0, most=1.0))
        if self.ball_friction not in BALL_FRICTION_LAWS:
            raise ValueError(
                f"ball_friction: {self.ball_friction!r} is not a law; it must be 'report' or "
                "'coulomb'"
            )
        _store(self, 'balls', _balls(self.balls))
        check_layout(self, self.positions, 'balls')

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
    def deceleration(self) -> float:
        """What a moving ball loses on the cloth, m/s^2 (report, Equation 10)."""
        return self.mu_ball_surface * self.gravity

    @cached_property
    def for_kernels(self) -> DiscTable:
        """What the kernels know of this table; its type chooses how balls move."""
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
        records = balls_at_rest(self.positions, self.radii, self.masses, self.is_cue)
        records.flags.writeable = False
        return records


def _store(instance: object, name: str, value: object) -> None:
    object.__setattr__(instance, name, value)


def _balls(balls: Iterable[Ball]) -> tuple[Ball, ...]:
    try:
        balls = tuple(balls)
    except TypeError:
        raise ValueError(f'balls: {balls!r} is not a sequence of Ball') from None
    if not balls:
        raise ValueError('balls: there are none; a table needs at least one ball')
    seen: dict[str, int] = {}
    for index, ball in enumerate(balls):
        if not isinstance(ball, Ball):
            raise ValueError(f'balls[{index}]: {ball!r} is not a Ball')
        if ball.label in seen:
            raise ValueError(
                f'balls[{index}]: label {ball.label!r} is already that of balls[{seen[ball.label]}]'
            )
        seen[ball.label] = index
    return balls


def _read_only(values: Sequence[object], dtype: type = float) -> NDArray[Any]:
    array: NDArray[Any] = np.array(values, dtype=dtype)
    array.flags.writeable = False
    return array
