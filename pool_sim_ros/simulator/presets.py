"""The tables that a name stands for, and what other parameters make of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from pool_sim_ros.physics import pool_table, pool_table_dimensions, rack
from pool_sim_ros.simulator.parameter_table import (
    BALL_LISTS,
    BOUNDARY_LISTS,
    PARAMETERS,
    REPORT,
    ParameterValue,
    default_values,
    parameters_of,
)

if TYPE_CHECKING:
    from pool_sim_ros.physics import Ball, PoolTable, PoolTableName, Table

BALL_FIELDS = dict(
    labels='label', masses='mass', radii='radius', positions='position', colors='color'
)
"""Field of `Ball` for each of the parameters ``balls.*``."""


def preset_values(given: Mapping[str, ParameterValue]) -> dict[str, ParameterValue]:
    """Return the value of every parameter: those of the preset, and over them those given.

    Parameters
    ----------
    given : mapping
        Name -> value, in its own type; of ``balls.*`` all or none.

    Raises
    ------
    ValueError
        Where parameters contradict each other, or one is missing; names it.
    """
    preset = str(given.get('table.preset', REPORT))
    values = default_values() if preset == REPORT else _pool_values(preset)  # type: ignore[arg-type]
    motion = str(given.get('table.motion', values['table.motion']))
    if preset != REPORT and motion != values['table.motion']:
        raise ValueError(
            f'table.motion: {motion} contradicts table.preset, {preset}, on which balls slide, '
            'roll and spin; leave one of them out'
        )
    if preset == REPORT and motion == 'ball':
        values |= _BALLS_THAT_SPIN
    _check_names(given, motion)
    _check_size(given, values)
    names = parameters_of(motion)
    values |= given
    for name in names:
        if name not in values:
            raise ValueError(f'{name} is missing; a table of motion {motion} needs it')
        choices = names[name].choices
        if choices and values[name] not in choices:
            raise ValueError(
                f'{name} must be {" or ".join(choices)}, not {values[name]!r}, on a table of '
                f'motion {motion}'
            )
    if preset != REPORT and 'balls.labels' not in given:
        values |= ball_values(_racked(preset, values))  # type: ignore[arg-type]
    return {name: values[name] for name in names}


def ball_values(balls: tuple[Ball, ...]) -> dict[str, ParameterValue]:
    """Return the values of ``balls.*`` for some balls."""
    values: dict[str, ParameterValue] = {}
    for name, width in BALL_LISTS.items():
        rows = [getattr(ball, BALL_FIELDS[name]) for ball in balls]
        values[f'balls.{name}'] = [v for row in rows for v in row] if width > 1 else rows
    return values


def boundary_values(table: PoolTable | Table) -> dict[str, ParameterValue]:
    """Return the values of the lists that make the boundary, of whatever has cushions and pockets.

    Empty lists stand for four cushions around a rectangle.
    """
    cushions, pockets = table.cushions, table.pockets
    rows = dict(pockets=pockets)
    if cushions is not None:
        rows |= dict(cushion_segments=cushions.segments, cushion_noses=cushions.noses)
    return {
        f'table.{name}': rows[name].ravel().tolist() if name in rows else []
        for name in BOUNDARY_LISTS
    }


def _pool_values(preset: PoolTableName) -> dict[str, ParameterValue]:
    table = pool_table_dimensions(preset)
    fields = {f'table.{name}': value for name, value in table.fields().items()}
    return {
        **default_values(),
        **{name: value for name, value in fields.items() if name in PARAMETERS},
        **boundary_values(table),
        'table.preset': preset,
        'integrator': 'event',
        'report_integrator': 'event',
    }


_BALLS_THAT_SPIN: dict[str, ParameterValue] = {
    'table.cushion_model': 'han',
    'table.friction_bound': 'impulse',
    **{f'table.{name}': [] for name in BOUNDARY_LISTS},
    'integrator': 'event',
    'report_integrator': 'event',
}
"""What nobody need give for a table of motion `ball`."""


def _check_names(given: Mapping[str, ParameterValue], motion: str) -> None:
    for name in given:
        only = PARAMETERS[name].motion
        if only not in ('', motion):
            raise ValueError(
                f'{name} is for tables of motion {only}, and this one has motion {motion}; leave '
                'it out, or choose another table.preset or table.motion'
            )


def _check_size(given: Mapping[str, ParameterValue], preset: Mapping[str, ParameterValue]) -> None:
    """Raise ValueError where cushions and pockets of a preset do not fit the size that is given."""
    if not preset.get('table.cushion_segments') or 'table.cushion_segments' in given:
        return
    for name in ('table.length', 'table.width'):
        if given.get(name, preset[name]) != preset[name]:
            raise ValueError(
                f'{name}: {given[name]} does not fit the cushions and pockets of table.preset '
                f'{preset["table.preset"]}, made for {preset[name]}; give table.cushion_segments, '
                'table.cushion_noses and table.pockets too, or leave it out'
            )


def _racked(preset: PoolTableName, values: Mapping[str, ParameterValue]) -> tuple[Ball, ...]:
    """Return the balls of a preset, racked; on a table without pockets where its size asks for."""
    table = pool_table(preset)
    length, width = (float(values[f'table.{name}']) for name in ('length', 'width'))  # type: ignore[arg-type]
    if (table.length, table.width) == (length, width):
        return table.balls
    middle = replace(table.balls[0], position=(length / 2, width / 2))
    bare = replace(table, balls=(middle,), length=length, width=width)
    return rack(bare, pool_table_dimensions(preset).rack)
