"""The node's parameters: names, defaults, ranges, and what they mean together; no ROS."""

from __future__ import annotations

import difflib
import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from pool_sim_ros.me212 import deviations
from pool_sim_ros.physics import (
    BALL_FRICTION_LAWS,
    INTEGRATORS,
    REPORT_TIME_SLICE,
    Ball,
    Table,
    report_table,
)


class Change(Enum):
    """When a new value counts."""

    NEVER = 'fixed at start-up'
    NEXT_STRIKE = 'counts from the next strike'
    NOW = 'counts at once'


@dataclass(frozen=True)
class ParameterSpec:
    """One parameter.

    Attributes
    ----------
    name : str
    default : object
        Its type is the parameter's.
    doc : str
    change : Change
    least, most : float or None
        Range, both ends included.
    choices : tuple of str
        What a string may be; none = anything.
    may_be_empty : bool
        Whether a string may be empty.
    """

    name: str
    default: object
    doc: str
    change: Change = Change.NEVER
    least: float | None = None
    most: float | None = None
    choices: tuple[str, ...] = ()
    may_be_empty: bool = False


class ParameterError(ValueError):
    """A parameter that cannot be; the message names it and says what would be right."""


@dataclass(frozen=True)
class Settings:
    """All parameters, checked: see `PARAMETERS` for what each means."""

    table: Table
    integrator: str
    report_integrator: str
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
        """All that differs from the run that the report printed, in words; empty = nothing."""
        return deviations(self.table, self.report_integrator, self.time_slice)


def _parameters() -> tuple[ParameterSpec, ...]:
    table, strike, now = report_table(), Change.NEXT_STRIKE, Change.NOW
    balls = table.balls
    friction = (
        ('mu_ball_ball', 'friction between two balls', 0.0),
        ('mu_ball_surface', 'friction between a ball and the cloth', 1e-4),
        ('mu_ball_cushion', 'friction between a ball and a cushion', 0.0),
    )
    restitution = (
        ('e_cue_ball', 'restitution between the cue ball and another'),
        ('e_ball_ball', 'restitution between two other balls'),
        ('e_ball_cushion', 'restitution between a ball and a cushion'),
    )
    per_ball = 'one given means all given'
    spec = ParameterSpec
    return (
        spec('table.length', table.length, 'x size between the cushions, m', least=0.01, most=1e3),
        spec('table.width', table.width, 'y size between the cushions, m', least=0.01, most=1e3),
        spec('table.gravity', table.gravity, 'm/s^2', least=0.01, most=1e3),
        *(
            spec(f'table.{name}', getattr(table, name), f'coefficient of {doc}', strike, least, 10)
            for name, doc, least in friction
        ),
        *(
            spec(f'table.{name}', getattr(table, name), f'coefficient of {doc}', strike, 0.0, 1.0)
            for name, doc in restitution
        ),
        spec(
            'table.ball_friction',
            table.ball_friction,
            'law of friction between two balls',
            strike,
            choices=BALL_FRICTION_LAWS,
        ),
        spec('balls.labels', list(table.labels), f'one for each ball, cue ball first; {per_ball}'),
        spec('balls.masses', [ball.mass for ball in balls], f'kg; {per_ball}'),
        spec('balls.radii', [ball.radius for ball in balls], f'm; {per_ball}'),
        spec(
            'balls.positions',
            [v for ball in balls for v in ball.position],
            f'start layout, x0, y0, x1, ..., m; {per_ball}',
        ),
        spec(
            'balls.colors',
            [v for ball in balls for v in ball.color],
            f'r0, g0, b0, r1, ..., each 0 to 1; {per_ball}',
        ),
        spec(
            'integrator',
            'event',
            'plays every strike but the report shots',
            strike,
            choices=INTEGRATORS,
        ),
        spec(
            'report_integrator',
            'time_slice',
            'plays the report shots; time_slice ends where the report printed',
            strike,
            choices=INTEGRATORS,
        ),
        spec(
            'time_slice',
            REPORT_TIME_SLICE,
            'slice of the integrator time_slice, s',
            strike,
            1e-7,
            1e-2,
        ),
        spec('max_cue_speed', 15.0, 'a faster strike is rejected, m/s', strike, 1e-3, 1e3),
        spec('max_shot_duration', 120.0, 'a longer shot is preempted, s', strike, 1e-3, 1e5),
        spec(
            'real_time_factor',
            1.0,
            'sim seconds per second; 0 = as fast as possible, and real time while nothing moves',
            now,
            0.0,
            1e4,
        ),
        spec('step_ticks', 1, 'ticks that ~/step advances', now, 1, 1000),
        spec('publish_rate', 60, 'frames per second of sim time', least=1, most=1000),
        spec('frame_id', 'table', 'frame of all that is published'),
        spec('publish_clock', False, 'whether to publish /clock'),
        spec('start_paused', False, 'whether to start paused'),
        spec(
            'record',
            '',
            'new file to write a log of all commands to, for replay; empty = none',
            may_be_empty=True,
        ),
    )


PARAMETERS = {spec.name: spec for spec in _parameters()}
"""Every parameter of the node but those of ROS itself, by name."""

_BALL_LISTS = {'labels': 1, 'masses': 1, 'radii': 1, 'positions': 2, 'colors': 3}
_BALL_FIELDS = {
    'labels': 'label', 'masses': 'mass', 'radii': 'radius', 'positions': 'position',
    'colors': 'color',
}  # fmt: skip


def default_values() -> dict[str, object]:
    """Return the values without a parameter file: the report's table."""
    return {name: spec.default for name, spec in PARAMETERS.items()}


def values_from(overrides: Mapping[str, object]) -> dict[str, object]:
    """Return the value of every parameter, given those that were set at start-up.

    Parameters
    ----------
    overrides : mapping
        Name -> value; other names than the node's are left alone unless they start with
        ``table.`` or ``balls.``.

    Raises
    ------
    ParameterError
        Where a name is misspelt, a type is wrong, or some but not all of ``balls.*`` are given.
    """
    for name in overrides:
        if name not in PARAMETERS and name.startswith(('table.', 'balls.')):
            close = difflib.get_close_matches(name, PARAMETERS, 1)
            hint = f'did you mean {close[0]}?' if close else 'see config/report.yaml for the names'
            raise ParameterError(f'{name} is not a parameter; {hint}')
    lists = [f'balls.{name}' for name in _BALL_LISTS]
    missing = [name for name in lists if name not in overrides]
    if 0 < len(missing) < len(lists):
        raise ParameterError(f'{missing[0]} is missing; give all of {", ".join(lists)}, or none')
    given = {name: coerce(name, overrides[name]) for name in PARAMETERS if name in overrides}
    return {**default_values(), **given}


def coerce(name: str, value: object) -> object:
    """Return the value of a parameter in its own type; whole numbers do for floats.

    Raises
    ------
    ParameterError
        Where it is of another type, not finite or out of range.
    """
    spec = PARAMETERS[name]
    if isinstance(spec.default, list):
        return _list(spec, value)
    if isinstance(spec.default, bool):
        _require(isinstance(value, bool), name, 'true or false', value)
        return value
    if isinstance(spec.default, str):
        good = isinstance(value, str) and (value != '' or spec.may_be_empty)
        _require(good, name, 'a string', value)
        if spec.choices:
            _require(value in spec.choices, name, ' or '.join(spec.choices), value)
        return value
    whole = isinstance(spec.default, int)
    wanted = f'{"a whole number" if whole else "a number"} from {spec.least:g} to {spec.most:g}'
    _require(_is_number(value) and spec.least <= value <= spec.most, name, wanted, value)
    if whole:
        _require(value == int(value), name, wanted, value)
        return int(value)
    return float(value)


def build_settings(values: Mapping[str, object]) -> Settings:
    """Check all parameters together.

    Parameters
    ----------
    values : mapping
        Name -> value of every parameter, each as `coerce` returns it.

    Raises
    ------
    ParameterError
        Where lists are of unequal length, balls overlap, and whatever else makes no table.
    """
    own = {name: value for name, value in values.items() if '.' not in name}
    table = {
        name.removeprefix('table.'): value
        for name, value in values.items()
        if name.startswith('table.')
    }
    try:
        return Settings(table=Table(balls=_balls(values), **table), **own)
    except ParameterError:
        raise
    except ValueError as error:
        raise ParameterError(str(error)) from error


def values_of(settings: Settings) -> dict[str, object]:
    """Return the value of every parameter: what `build_settings` was given."""
    table = settings.table
    values = {}
    for name in PARAMETERS:
        group, _, field = name.rpartition('.')
        if group == 'balls':
            rows = [getattr(ball, _BALL_FIELDS[field]) for ball in table.balls]
            wide = _BALL_LISTS[field] > 1
            values[name] = [number for row in rows for number in row] if wide else rows
        else:
            values[name] = getattr(table if group == 'table' else settings, field)
    return values


def _balls(values: Mapping[str, object]) -> tuple[Ball, ...]:
    columns = {}
    count = len(values['balls.labels'])
    for name, width in _BALL_LISTS.items():
        flat = values[f'balls.{name}']
        if len(flat) != width * count:
            raise ParameterError(
                f'balls.{name} has {len(flat)} values; {count} balls.labels need {width * count}'
            )
        columns[name] = [
            tuple(flat[i : i + width]) if width > 1 else flat[i] for i in range(0, len(flat), width)
        ]
    rows = zip(*(columns[name] for name in _BALL_LISTS), strict=True)
    return tuple(
        Ball(label, mass, radius, position, color, is_cue=index == 0)
        for index, (label, mass, radius, position, color) in enumerate(rows)
    )


def _list(spec: ParameterSpec, value: object) -> list:
    try:
        items = [] if isinstance(value, str) else list(value)
    except TypeError:
        items = []
    if isinstance(spec.default[0], str):
        strings = bool(items) and all(isinstance(item, str) for item in items)
        _require(strings, spec.name, "a list of strings, like ['C', '1']", value)
        return items
    _require(bool(items), spec.name, 'a list of numbers', value)
    for index, item in enumerate(items):
        _require(_is_number(item), f'{spec.name}[{index}]', 'a finite number', item)
    return [float(item) for item in items]


def _is_number(value: object) -> bool:
    return type(value) in (int, float) and math.isfinite(value)


def _require(good: bool, name: str, wanted: str, value: object) -> None:
    if not good:
        shown = repr(value)
        shown = shown if len(shown) <= 60 else shown[:60] + '...'
        raise ParameterError(f'{name} must be {wanted}, not {shown}')
