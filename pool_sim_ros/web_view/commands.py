"""What a page may say to the server: pure parsing and checks."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any, TypeGuard

LONGEST = 1024
"""Most characters of a command; the longest sensible one has about 100."""

_FIELDS = {
    'aim': 'velocity',
    'strike': 'velocity',
    'shot': 'number',
    'pause': 'paused',
    'speed': 'factor',
    'step': None,
    'reset': None,
}
"""Name of a command -> the one field that goes with it."""


@dataclass(frozen=True)
class Command:
    """One command of a page.

    Attributes
    ----------
    name : str
        aim (predict only), strike, shot, pause, speed, step or reset.
    value : tuple, int, bool, float or None
        aim, strike: (x, y) in m/s; shot: a report shot's number; pause: bool; speed: the real time
        factor, 0 for as fast as possible; else None.
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
    field = _FIELDS[name]
    wanted = {'do'} if field is None else {'do', field}
    if set(fields) != wanted:
        raise ValueError(f'{name} takes {field or "nothing"}, and nothing else')
    return Command(name, None if field is None else _CHECKS[field](fields[field]))


def _velocity(value: object) -> tuple[float, float]:
    if isinstance(value, list) and len(value) == 2 and all(map(_is_finite, value)):
        return float(value[0]), float(value[1])
    raise ValueError('velocity must be two finite numbers, [x, y] in m/s')


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


_CHECKS = {'velocity': _velocity, 'number': _number, 'paused': _paused, 'factor': _factor}
