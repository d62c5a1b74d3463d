"""Values for the parameters, from outside: each one is checked and turned into its own type."""

from __future__ import annotations

import difflib
import re
import reprlib
import sys
from collections.abc import Iterable, Mapping
from typing import TypeGuard

from pool_sim_ros.simulator.parameter_names import GROUPS, near_misses
from pool_sim_ros.simulator.parameter_table import (
    BALL_LISTS,
    PARAMETERS,
    ParameterSpec,
    ParameterValue,
)
from pool_sim_ros.simulator.presets import preset_values

SHOWN_LENGTH = 60
"""Characters of a wrong value that a message shows."""


TRUTHS = {'true': True, 'True': True, 'TRUE': True}
TRUTHS |= {'false': False, 'False': False, 'FALSE': False}
"""How YAML writes a bool; some tools send it as a string."""

LONGEST_NUMBER = 100
"""Characters of a number that is written as a string: no sensible one has 30."""

_NUMBER = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?', re.ASCII)
"""How a number is written; YAML 1.1, and so `ros2 param set`, takes 1e-6 for a string."""


class ParameterError(ValueError):
    """A parameter is wrong; the message names it and says what would be right."""


def values_from(overrides: Mapping[str, object]) -> dict[str, ParameterValue]:
    """Return the value of every parameter, given those that were set at start-up.

    The preset comes first, then each of these over it.

    Parameters
    ----------
    overrides : mapping
        Name -> value; names that are not the node's are ignored, unless they start with
        ``table.`` or ``balls.`` and are close to one of its own.

    Raises
    ------
    ParameterError
        Where a name is misspelt, a type is wrong, some but not all of ``balls.*`` are given, or
        parameters contradict each other.
    """
    for name, ours in near_misses(overrides).items():
        if name.startswith(GROUPS):
            raise ParameterError(f'{name} is not a parameter; did you mean {ours}?')
    lists = [f'balls.{name}' for name in BALL_LISTS]
    missing = [name for name in lists if name not in overrides]
    if 0 < len(missing) < len(lists):
        raise ParameterError(f'{missing[0]} is missing; give all of {", ".join(lists)}, or none')
    given = {name: coerce(name, overrides[name]) for name in PARAMETERS if name in overrides}
    try:
        return preset_values(given)
    except ValueError as error:
        raise ParameterError(str(error)) from error


def coerce(name: str, value: object) -> ParameterValue:
    """Return the value of a parameter in its own type.

    A whole number may stand for a float, and a string for the number or the bool that it spells.

    Raises
    ------
    ParameterError
        Where it is of another type, not finite or out of range.
    """
    spec = PARAMETERS[name]
    if isinstance(spec.default, list):
        return _coerce_list(spec, value)
    if isinstance(spec.default, bool):
        truth = TRUTHS.get(value) if isinstance(value, str) else value
        if not isinstance(truth, bool):
            raise _wrong(name, 'true or false', value)
        return truth
    if isinstance(spec.default, str):
        return _coerce_string(spec, value)
    return _coerce_number(spec, value)


def coerce_all(values: Mapping[str, object]) -> dict[str, ParameterValue]:
    """Return the values of some parameters, each as `coerce` returns it.

    Raises
    ------
    ParameterError
        Where there is no parameter of a name, and as `coerce` raises it.
    """
    for name in values:
        if name not in PARAMETERS:
            raise ParameterError(f'{name} is not a parameter')
    return {name: coerce(name, value) for name, value in values.items()}


def _coerce_string(spec: ParameterSpec, value: object) -> str:
    if spec.choices and value not in spec.choices:
        close = difflib.get_close_matches(str(value).lower(), spec.choices, 1)
        raise _wrong(spec.name, ' or '.join(spec.choices), value, *close)
    if not isinstance(value, str) or (value == '' and not spec.may_be_empty):
        raise _wrong(spec.name, 'a string', value)
    if spec.is_frame and value.startswith('/'):
        raise _wrong(spec.name, 'a name without a slash before it, as tf2 has them', value)
    return value


def _coerce_number(spec: ParameterSpec, value: object) -> float:
    whole = isinstance(spec.default, int)
    wanted = f'{"a whole number" if whole else "a number"} from {spec.least:g} to {spec.most:g}'
    if spec.smallest:
        wanted += f' (0, or at least {spec.smallest:g})'
    number = _read_number(value)
    if not (_is_number(number) and spec.least <= number <= spec.most):
        raise _wrong(spec.name, wanted, value)
    if 0.0 < number < spec.smallest:
        raise _wrong(spec.name, wanted, value)
    if not whole:
        return float(number)
    if number != int(number):
        raise _wrong(spec.name, wanted, value)
    return int(number)


def _coerce_list(spec: ParameterSpec, value: object) -> list[str] | list[float]:
    is_list = isinstance(value, Iterable) and not isinstance(value, str)
    items: list[object] = list(value) if is_list else []  # type: ignore[call-overload]
    if spec.holds_strings:
        strings = [item for item in items if isinstance(item, str)]
        if not items or len(strings) < len(items):
            raise _wrong(spec.name, "a list of strings, like ['C', '1']", value)
        return strings
    if not (items or (spec.may_be_empty and is_list)):
        raise _wrong(spec.name, 'a list of numbers', value)
    numbers = []
    for index, item in enumerate(items):
        number = _read_number(item)
        if not _is_number(number):
            raise _wrong(f'{spec.name}[{index}]', 'a finite number', item)
        numbers.append(float(number))
    return numbers


def _read_number(value: object) -> object:
    """Return the number that a string spells, and anything else as it is."""
    if not isinstance(value, str) or len(value) > LONGEST_NUMBER:
        return value
    return float(value) if _NUMBER.fullmatch(value.strip()) else value


def _is_number(value: object) -> TypeGuard[int | float]:
    if not isinstance(value, int | float) or type(value) not in (int, float):
        return False
    return abs(value) <= sys.float_info.max  # false for nan and for integers that no float can hold


def _wrong(name: str, wanted: str, value: object, *close: str) -> ParameterError:
    meant = f'; did you mean {close[0]!r}?' if close else ''
    return ParameterError(f'{name} must be {wanted}, not {_shown(value)}{meant}')


def _shown(value: object) -> str:
    """Return a value in brief; anybody may have written it."""
    if isinstance(value, int) and abs(value) > sys.float_info.max:
        return 'a number beyond all floats'  # str() refuses it, or takes long
    try:
        shown = reprlib.repr(value) if isinstance(value, list | tuple | dict) else repr(value)
    except ValueError:
        return f'a {type(value).__name__}'
    return shown if len(shown) <= SHOWN_LENGTH else shown[:SHOWN_LENGTH] + '...'
