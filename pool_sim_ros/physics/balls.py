"""The balls of a table: what is given of each before a shot."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from pool_sim_ros.physics.validation import number, numbers, shown

MASSES = (1e-9, 1e9)
RADII = (1e-6, 1e3)
"""Ranges in kg and m, far beyond any ball: within them no calculation here overflows."""


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
        store(self, 'mass', number(f'{name}: mass', self.mass, *MASSES))
        store(self, 'radius', number(f'{name}: radius', self.radius, *RADII))
        store(self, 'position', numbers(f'{name}: position', self.position, 2))
        store(self, 'color', numbers(f'{name}: color', self.color, 3, 0.0, 1.0))
        store(self, 'is_cue', bool(self.is_cue))


def checked_balls(balls: Iterable[Ball]) -> tuple[Ball, ...]:
    try:
        balls = tuple(balls)
    except TypeError:
        raise ValueError(f'balls: {shown(balls)} is not a sequence of Ball') from None
    if not balls:
        raise ValueError('balls: there are none; a table needs at least one ball')
    seen: dict[str, int] = {}
    for index, ball in enumerate(balls):
        if not isinstance(ball, Ball):
            raise ValueError(f'balls[{index}]: {shown(ball)} is not a Ball')
        if ball.label in seen:
            raise ValueError(
                f'balls[{index}]: label {ball.label!r} is already that of balls[{seen[ball.label]}]'
            )
        seen[ball.label] = index
    return balls


def store(instance: object, name: str, value: object) -> None:
    """Set a field of a frozen dataclass while it is made."""
    object.__setattr__(instance, name, value)
