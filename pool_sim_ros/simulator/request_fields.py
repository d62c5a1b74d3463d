"""The fields of a request in JSON: numbers, a cue and places, each checked with a message."""

from __future__ import annotations

import json
import math

CUE_NEEDED = ('speed', 'azimuth')
CUE_KEYS = (*CUE_NEEDED, 'elevation', 'side', 'above')
"""What a request says of the cue, as `cue_strike` takes it."""


class FieldError(ValueError):
    """A field of the wrong form; the message says what would be right."""


class NotFiniteError(ValueError):
    """A field with a number that is infinite or none; the message names it."""


def numbers_from(name: str, value: object, axes: str, unit: str) -> tuple[float, ...]:
    """Return a list of as many numbers as there are axes; they may be infinite or no numbers.

    Raises FieldError where it is none.
    """
    right = isinstance(value, list) and len(value) == len(axes) and all(map(_is_number, value))
    if not right:
        count = {2: 'two', 3: 'three'}[len(axes)]
        raise FieldError(f'{name} must be {count} numbers, [{", ".join(axes)}] in {unit}')
    assert isinstance(value, list), 'checked above'
    return tuple(map(_float, value))


def cue_from(value: object) -> dict[str, float]:
    """Return what a request says of the cue: speed, azimuth, and what else is given.

    Raises FieldError for other keys and values, and NotFiniteError.
    """
    if not isinstance(value, dict):
        raise FieldError('cue must be an object like {"speed": 2.0, "azimuth": 180.0}')
    _check_keys('cue', value, CUE_KEYS)
    for key in CUE_NEEDED:
        if key not in value:
            raise FieldError(f'cue has no {key}; it needs {" and ".join(CUE_NEEDED)}')
    for key in value:
        if not _is_number(value[key]):
            raise FieldError(f'cue: {key} must be a number')
    cue = {key: _float(value[key]) for key in CUE_KEYS if key in value}
    for key, number in cue.items():
        if not math.isfinite(number):
            raise NotFiniteError(f'cue: {key} is {number:g}, which is not finite')
    return cue


def places_from(value: object) -> dict[str, tuple[float, float]]:
    """Return where balls are to be placed, by their labels, m.

    Raises FieldError for anything else, and NotFiniteError.
    """
    if not isinstance(value, dict) or not value:
        raise FieldError('place must be an object like {"9": [0.5, 0.4]}, labels with [x, y] in m')
    places: dict[str, tuple[float, float]] = {}
    for label, place in value.items():
        x, y = numbers_from(f'place: {quote(label)}', place, 'xy', 'm')
        if not (math.isfinite(x) and math.isfinite(y)):
            raise NotFiniteError(f'place: {quote(label)} at [{x:g}, {y:g}] is not finite')
        places[label] = x, y
    return places


def quote(text: str, limit: int = 40) -> str:
    """Return a text in quotes, cut after so many characters: anybody may have sent it."""
    return json.dumps(text if len(text) <= limit else text[:limit] + '...')


def _check_keys(name: str, value: dict[str, object], known: tuple[str, ...]) -> None:
    unknown = sorted(set(value) - set(known))
    if unknown:
        keys = f'{", ".join(known[:-1])} and {known[-1]}'
        raise FieldError(f'{name}: unknown key {quote(unknown[0])}; the keys are {keys}')


def _is_number(value: object) -> bool:
    return type(value) in (int, float)


def _float(number: float) -> float:
    try:
        return float(number)
    except OverflowError:
        return math.inf if number > 0 else -math.inf
