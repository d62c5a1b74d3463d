"""What a page may say to the server: pure parsing and checks."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeGuard

from pool_sim_ros.simulator import cue_from

LONGEST = 2048
"""Most characters of a command: one that places a whole rack has about 1000."""

MOST_PLACED = 1000
"""Most balls in one command."""

_FIELDS: dict[str, tuple[tuple[str, ...], ...]] = {
    'aim': (('velocity',), ('velocity', 'spin'), ('cue',)),
    'strike': (('velocity',), ('velocity', 'spin'), ('cue',)),
    'shot': (('number',),),
    'pause': (('paused',),),
    'speed': (('factor',),),
    'place': (('places',),),
    'undo': ((),),
    'help': (('goal',),),
    'step': ((),),
    'reset': ((),),
}
"""Name of a command -> the fields that may go with it."""


@dataclass(frozen=True)
class Command:
    """One command of a page.

    Attributes
    ----------
    name : str
        aim (predict only), strike, shot, pause, speed, place, undo, help, step or reset.
    value : dict, int, bool, float or None
        aim, strike: the fields that a request has, velocity and spin, or cue; shot: a report shot's
        number; pause: bool; speed: the real time factor, 0 for as fast as possible; place: label to
        [x, y] in m; help: the fields of a goal; else None.
    """

    name: str
    value: Any = None


def parse_command(text: str) -> Command:
    """Read a command: JSON like ``{"do": "strike", "velocity": [-4.0, 0.0]}``.

    The simulator itself checks the ranges that it knows (shots, speeds).

    Raises
    ------
    ValueError
        If it is no command; the message says what is wrong.
    """
    if len(text) > LONGEST:
        raise ValueError(f'a command has at most {LONGEST} characters, not {len(text)}')
    try:
        fields = json.loads(text)
    except (ValueError, RecursionError):
        raise ValueError('a command must be JSON') from None
    if not isinstance(fields, dict):
        raise ValueError('a command must be a JSON object')
    name = fields.get('do')
    if not isinstance(name, str) or name not in _FIELDS:
        raise ValueError(f'do must be one of {", ".join(_FIELDS)}')
    given = set(fields) - {'do'}
    if not any(given == set(wanted) for wanted in _FIELDS[name]):
        takes = ', or '.join(' and '.join(wanted) or 'nothing' for wanted in _FIELDS[name])
        raise ValueError(f'{name} takes {takes}, and nothing else')
    values = {field: _CHECKS[field](fields[field]) for field in fields if field != 'do'}
    if name in ('aim', 'strike'):
        return Command(name, values)
    return Command(name, *values.values())


def _velocity(value: object) -> list[float]:
    return _numbers(value, 2, 'velocity must be two finite numbers, [x, y] in m/s')


def _spin(value: object) -> list[float]:
    return _numbers(value, 3, 'spin must be three finite numbers, [x, y, z] in rad/s')


def _places(value: object) -> dict[str, list[float]]:
    if not isinstance(value, dict) or not 0 < len(value) <= MOST_PLACED:
        raise ValueError('places must be an object, label to [x, y] in m')
    wrong = 'places must be two finite numbers for each ball, [x, y] in m'
    return {label: _numbers(place, 2, wrong) for label, place in value.items()}


def _goal(value: object) -> dict[str, Any]:
    if isinstance(value, dict):
        return value  # the oracle says what is wrong with it
    raise ValueError('goal must be an object like {"ball": "9", "pocket": "any"}')


def _numbers(value: object, count: int, otherwise: str) -> list[float]:
    if isinstance(value, list) and len(value) == count and all(map(_is_finite, value)):
        return [float(number) for number in value]
    raise ValueError(otherwise)


def _number(value: object) -> int:
    if type(value) is int:
        return value
    raise ValueError('number must be an integer, 1 to 4')


def _paused(value: object) -> bool:
    if isinstance(value, bool):
        return value
    raise ValueError('paused must be true or false')


def _factor(value: object) -> float:
    if _is_finite(value) and value >= 0.0:
        return float(value)
    raise ValueError('factor must be a finite number, 0 or more')


def _is_finite(value: object) -> TypeGuard[int | float]:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


_CHECKS: dict[str, Callable[[object], Any]] = {
    'velocity': _velocity,
    'spin': _spin,
    'cue': cue_from,
    'number': _number,
    'paused': _paused,
    'factor': _factor,
    'places': _places,
    'goal': _goal,
}
