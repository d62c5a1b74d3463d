"""A table on which balls spin: what must be given for it, and what the kernels get."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pool_sim_ros.physics.boundary import Rectangle, pocketed_boundary
from pool_sim_ros.physics.contacts import BallLaw, EdgeLaw
from pool_sim_ros.physics.cushions import Cushions, check_radii
from pool_sim_ros.physics.law_names import (
    CUSHION_MODELS,
    FRICTION_BOUNDS,
    number_of,
)
from pool_sim_ros.physics.motion import BallTable
from pool_sim_ros.physics.tolerances import MAX_FRICTION, MIN_DECELERATION
from pool_sim_ros.physics.validation import number, shown

if TYPE_CHECKING:
    from pool_sim_ros.physics.table import Table

COEFFICIENTS = ('mu_slide', 'mu_roll', 'mu_spin', 'nose_height')
"""Fields that a table needs on which balls spin, and that no other has."""


def checked_fields(table: Table) -> dict[str, Any]:
    """Return the fields of a table for balls that spin, as they are to be kept.

    Raises
    ------
    ValueError
        Where one is missing or out of its range, and where balls differ in radius.
    """
    fields: dict[str, Any] = {}
    for name in COEFFICIENTS:
        value = getattr(table, name)
        if value is None:
            raise ValueError(f"{name}: a table of motion 'ball' needs it; there is none")
        fields[name] = number(name, value, least=0.0, most=MAX_FRICTION)
    radius = table.balls[0].radius
    for ball in table.balls:
        if ball.radius != radius:
            raise ValueError(
                f'ball {ball.label!r}: radius {ball.radius:g} must be {radius:g}, that of ball '
                f"{table.balls[0].label!r}: balls of motion 'ball' have one radius"
            )
    height = fields['nose_height']
    if not 0.5 * radius < height < 2.0 * radius:
        raise ValueError(
            f'nose_height: {height:g} must be between {0.5 * radius:g} and {2.0 * radius:g}, half '
            "a ball's radius and two"
        )
    for name in ('mu_slide', 'mu_roll'):
        if 0.0 < fields[name] * table.gravity < MIN_DECELERATION:
            raise ValueError(
                f'{name}: {fields[name]} must be 0 or at least '
                f'{MIN_DECELERATION / table.gravity:.3g}, so that the balls stop some day'
            )
    number_of('cushion_model', table.cushion_model, CUSHION_MODELS)
    number_of('friction_bound', table.friction_bound, FRICTION_BOUNDS)
    check_radii('pockets', table.pockets)
    if table.cushions is not None and not isinstance(table.cushions, Cushions):
        raise ValueError(
            f'cushions: {shown(table.cushions)} must be Cushions(segments, noses) or None'
        )
    if len(table.pockets) and table.cushions is None:
        raise ValueError('pockets: a table with pockets needs cushions that leave room for them')
    return fields


def check_nothing_given(table: Table) -> None:
    """Raise ValueError where a table of discs has what only balls that spin have."""
    for name in (*COEFFICIENTS, 'cushions'):
        if getattr(table, name) is not None:
            raise ValueError(f"{name}: only a table of motion 'ball' has it")
    if len(table.pockets):
        raise ValueError("pockets: only a table of motion 'ball' has them")


def for_kernels(table: Table) -> BallTable:
    """Return what the kernels know of a table."""
    radius = table.balls[0].radius
    boundary: Any = Rectangle(table.length, table.width)
    if table.cushions is not None:
        boundary = pocketed_boundary(
            (table.length, table.width),
            np.array(table.cushions.segments),
            np.array(table.cushions.noses),
            np.array(table.pockets),
            radius,
        )
    gravity = table.gravity
    mu_slide, mu_roll, mu_spin, height = (
        float(getattr(table, name) or 0.0) for name in COEFFICIENTS
    )
    return BallTable(
        boundary=boundary,
        slide=mu_slide * gravity,
        roll=mu_roll * gravity,
        spin=5.0 * mu_spin * gravity / (2.0 * radius),
        radius=radius,
        rubbing=BallLaw(
            table.mu_ball_ball,
            table.ball_friction == 'alciatore',
            table.friction_bound == 'restitution',
        ),
        edge=EdgeLaw(
            CUSHION_MODELS.index(table.cushion_model),
            table.e_ball_cushion,
            table.mu_ball_cushion,
            height,
            mu_slide,
        ),
        e_cue_ball=table.e_cue_ball,
        e_ball_ball=table.e_ball_ball,
        e_ball_cushion=table.e_ball_cushion,
        coulomb=True,
        cue_ball=int(table.is_cue.argmax()) if table.is_cue.any() else -1,
    )
