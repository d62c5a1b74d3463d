"""Values for the parameters, from outside: each one is checked and turned into its own type."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterable, Mapping
from typing import TypeGuard

from pool_sim_ros.simulator.parameter_table import (
    BALL_LISTS,
    PARAMETERS,
    ParameterSpec,
    ParameterValue,
    default_values,
)

SHOWN_LENGTH = 60
"""Characters of a wrong value that a message shows."""


class ParameterError(ValueError):
    """A parameter is wrong; the message names it and says what would be right."""


def values_from(overrides: Mapping[str, object]) -> dict[str, ParameterValue]:
    """Return the value of every parameter, given those that were set at start-up.

    Parameters
    ----------
    overrides : mapping
        Name -> value; names that are not the node's are ignored, unless they start with
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
    lists = [f'balls.{name}' for name in BALL_LISTS]
    missing = [name for name in lists if name not in overrides]
    if 0 < len(missing) < len(lists):
        raise ParameterError(f'{missing[0]} is missing; give all of {", ".join(lists)}, or none')
    given = {name: coerce(name, overrides[name]) for name in PARAMETERS if name in overrides}
    return {**default_values(), **given}


def coerce(name: str, value: object) -> ParameterValue:
    """Return the value of a parameter in its own type; a whole number may stand for a float.

    Raises
    ------
    ParameterError
        Where it is of another type, not finite or out of range.
    """
    spec = PARAMETERS[name]
    if isinstance(spec.default, list):
        return _coerce_list(spec, value)
    if isinstance(spec.default, bool):
        if not isinstance(value, bool):
            raise _wrong(name, 'true or false', value)
        return value
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
    if not isinstance(value, str) or (value == '' and not spec.may_be_empty):
        raise _wrong(spec.name, 'a string', value)
    if spec.choices and value not in spec.choices:
        raise _wrong(spec.name, ' or '.join(spec.choices), value)
    return value


def _coerce_number(spec: ParameterSpec, value: object) -> float:
    whole = isinstance(spec.default, int)
    wanted = f'{"a whole number" if whole else "a number"} from {spec.least:g} to {spec.most:g}'
    if spec.smallest:
        wanted += f' (0, or at least {spec.smallest:g})'
    if not (_is_number(value) and spec.least <= value <= spec.most):
        raise _wrong(spec.name, wanted, value)
    if 0.0 < value < spec.smallest:
        raise _wrong(spec.name, wanted, value)
    if not whole:
        return float(value)
    if value != int(value):
        raise _wrong(spec.name, wanted, value)
    return int(value)


def _coerce_list(spec: ParameterSpec, value: object) -> list[str] | list[float]:
    items: list[object] = []
    if isinstance(value, Iterable) and not isinstance(value, str):
        items = list(value)
    if spec.holds_strings:
        strings = [item for item in items if isinstance(item, str)]
        if not items or len(strings) < len(items):
            raise _wrong(spec.name, "a list of strings, like ['C', '1']", value)
        return strings
    if not items:
        raise _wrong(spec.name, 'a list of numbers', value)
    numbers = []
    for index, item in enumerate(items):
        if not _is_number(item):
            raise _wrong(f'{spec.name}[{index}]', 'a finite number', item)
        numbers.append(float(item))
    return numbers


def _is_number(value: object) -> TypeGuard[int | float]:
    if not isinstance(value, int | float) or type(value) not in (int, float):
        return False
    return abs(value) <= sys.float_info.max  # false for nan and for integers that no float can hold


def _wrong(name: str, wanted: str, value: object) -> ParameterError:
    shown = repr(value)
    shown = shown if len(shown) <= SHOWN_LENGTH else shown[:SHOWN_LENGTH] + '...'
    return ParameterError(f'{name} must be {wanted}, not {shown}')
