"""The settings of a simulation: all parameters together, with the table that they make."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pool_sim_ros.me212 import deviations
from pool_sim_ros.physics import Ball, Cushions, Integrator, Table
from pool_sim_ros.simulator.parameter_table import (
    BALL_LISTS,
    BOUNDARY_LISTS,
    ParameterValue,
    parameters_of,
)
from pool_sim_ros.simulator.parameter_values import ParameterError
from pool_sim_ros.simulator.presets import ball_values, boundary_values

FRAME_LENGTH = 60
"""Characters of a frame that a message shows: anybody may have sent it."""

MESSAGE_LENGTH = 400
"""Characters of a message: it may name labels, and those may have any length."""


@dataclass(frozen=True)
class Settings:
    """All parameters, checked: see `PARAMETERS` for what each means."""

    table: Table
    preset: str
    integrator: Integrator
    report_integrator: Integrator
    time_slice: float
    max_cue_speed: float
    max_shot_duration: float
    real_time_factor: float
    step_ticks: int
    publish_rate: int
    frame_id: str
    publish_clock: bool
    start_paused: bool
    record: str

    @property
    def deviations(self) -> list[str]:
        """Differences from the run that the report printed, in words; empty = none."""
        return deviations(self.table, self.report_integrator, self.time_slice)

    def frame_fault(self, frame_id: str) -> str:
        """Return why positions cannot be in a frame; empty where they can, as in an empty one."""
        if frame_id in ('', self.frame_id):
            return ''
        return f'the frame is {frame_id[:FRAME_LENGTH]!r}; it must be {self.frame_id!r}, or empty'


def build_settings(values: Mapping[str, Any]) -> Settings:
    """Check all parameters together.

    Parameters
    ----------
    values : mapping
        Name -> value of every parameter, each as `coerce` returns it.

    Raises
    ------
    ParameterError
        Where lists are of unequal length, balls overlap, or anything else makes no table.
    """
    own = {name: value for name, value in values.items() if '.' not in name}
    table = {
        name.removeprefix('table.'): value
        for name, value in values.items()
        if name.startswith('table.')
    }
    preset = table.pop('preset')
    try:
        if table['motion'] == 'ball':
            table |= _boundary(table)
        for name in ('integrator', 'report_integrator'):
            choices = parameters_of(table['motion'])[name].choices
            if own[name] not in choices:
                raise ParameterError(
                    f'{name} must be {" or ".join(choices)}, not {own[name]!r}, on a table of '
                    f'motion {table["motion"]}'
                )
        return Settings(table=Table(balls=_balls(values), **table), preset=preset, **own)
    except ParameterError:
        raise
    except ValueError as error:
        raise ParameterError(str(error)[:MESSAGE_LENGTH]) from error


def values_of(settings: Settings) -> dict[str, ParameterValue]:
    """Return the value of every parameter: what `build_settings` was given."""
    table = settings.table
    values = {**ball_values(table.balls), **boundary_values(table), 'table.preset': settings.preset}
    for name in parameters_of(table.motion):
        if name not in values:
            group, _, field = name.rpartition('.')
            values[name] = getattr(table if group == 'table' else settings, field)
    return {name: values[name] for name in parameters_of(table.motion)}


def _boundary(table: dict[str, Any]) -> dict[str, Any]:
    """Take the lists of the boundary out of the fields of a table; return what they make."""
    rows = {}
    for name, width in BOUNDARY_LISTS.items():
        flat = table.pop(name)
        if len(flat) % width:
            raise ParameterError(f'table.{name} has {len(flat)} values; each row has {width}')
        rows[name] = np.array(flat).reshape(-1, width)
    segments, noses = rows['cushion_segments'], rows['cushion_noses']
    cushions = Cushions(segments, noses) if len(segments) or len(noses) else None
    return {'cushions': cushions, 'pockets': rows['pockets']}


def _balls(values: Mapping[str, Any]) -> tuple[Ball, ...]:
    columns: dict[str, list[Any]] = {}
    count = len(values['balls.labels'])
    for name, width in BALL_LISTS.items():
        flat = values[f'balls.{name}']
        if len(flat) != width * count:
            raise ParameterError(
                f'balls.{name} has {len(flat)} values; {count} balls.labels need {width * count}'
            )
        columns[name] = [
            tuple(flat[i : i + width]) if width > 1 else flat[i] for i in range(0, len(flat), width)
        ]
    rows = zip(*(columns[name] for name in BALL_LISTS), strict=True)
    return tuple(
        Ball(label, mass, radius, position, color, is_cue=index == 0)
        for index, (label, mass, radius, position, color) in enumerate(rows)
    )
