"""The names of the laws of contact that a table may choose; a number is an index in its tuple."""

from __future__ import annotations

from typing import Literal, get_args

BallFriction = Literal['report', 'coulomb', 'alciatore']
"""A law of friction between two balls, by its name."""
BALL_FRICTION_LAWS: tuple[BallFriction, ...] = get_args(BallFriction)
"""All of them."""

DiscFriction = Literal['report', 'coulomb']
"""A law of friction between two discs, by its name."""
DISC_FRICTION_LAWS: tuple[DiscFriction, ...] = get_args(DiscFriction)
"""Those of discs."""

CushionModel = Literal['han', 'impulse', 'stronge', 'mathavan']
"""What a cushion does to a ball that spins, by the name of the model."""
CUSHION_MODELS: tuple[CushionModel, ...] = get_args(CushionModel)
"""All of them."""

FrictionBound = Literal['impulse', 'restitution']
"""What bounds the friction of two balls that spin, by its name."""
FRICTION_BOUNDS: tuple[FrictionBound, ...] = get_args(FrictionBound)
"""Both of them."""


def number_of(name: str, value: object, names: tuple[str, ...]) -> int:
    """Return the index of a law in `names`; raise ValueError, naming the field, for another."""
    if not isinstance(value, str) or value not in names:
        listed = ', '.join(repr(known) for known in names[:-1])
        raise ValueError(f'{name}: {value!r} must be {listed} or {names[-1]!r}')
    return names.index(value)
