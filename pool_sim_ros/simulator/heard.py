"""What a client hears on `~/shot/response` and `~/state`: anybody may have sent it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from pool_sim_ros.simulator.shot_request import Phase
from pool_sim_ros.simulator.strict_json import read_json_object

LONGEST = 10_000_000
"""Characters that are read: the last response has half of it where a table has 20,000 balls."""

Check = Callable[[object], bool]


def response_from_json(text: str) -> dict[str, Any]:
    """Return the fields of a response, as `shot_request.Response` has them.

    Parameters
    ----------
    text : str
        As `~/shot/response` carries it.

    Returns
    -------
    dict
        A field that is missing and that need not be there is None; others may be there too.

    Raises
    ------
    ValueError
        Where this is no response that the node could have sent; says why, in one line.
    """
    read = _fields('response', text, _RESPONSE)
    fields: dict[str, Any] = {**dict.fromkeys(_RESPONSE), **read}
    needed = _NEEDED[fields['phase']]
    if fields['place'] is not None:  # it has no strike
        needed = tuple(name for name in needed if name not in ('velocity', 'integrator'))
    for name in needed:
        if fields[name] is None:
            raise ValueError(f'a response that is {fields["phase"]} has a {name}')
    return fields


def state_from_json(text: str) -> dict[str, Any]:
    """Return the fields of a state.

    Parameters
    ----------
    text : str
        As `~/state` carries it.

    Returns
    -------
    dict
        paused, moving, computing (bool) and tick (int); sim_time (s) and real_time_factor are
        numbers or missing, pocketed is a list of labels or missing, and others may be there too.

    Raises
    ------
    ValueError
        Where this is no state that the node could have sent; says why, in one line.
    """
    return _fields('state', text, _STATE)


def _fields(what: str, text: str, checks: Mapping[str, Check]) -> dict[str, Any]:
    if len(text) > LONGEST:
        raise ValueError(f'a {what} has at most {LONGEST} characters, not {len(text)}')
    try:
        fields = read_json_object(text)
    except ValueError as error:
        raise ValueError(f'this is no {what}: {error}') from None
    for name, check in checks.items():
        if not check(fields.get(name)):
            shown = str(fields.get(name))[:40]
            raise ValueError(f'this is no {what}: its {name} cannot be {shown!r}')
    return fields


def _is(*types: type) -> Check:
    return lambda value: type(value) in types


def _or_none(check: Check) -> Check:
    return lambda value: value is None or check(value)


def _is_number(value: Any) -> bool:
    return type(value) in (int, float) and math.isfinite(value)


def _is_pair(value: object) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(map(_is_number, value))


def _are_places(value: object) -> bool:
    return isinstance(value, dict) and all(map(_is_pair, value.values()))


def _is_spin(value: object) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(map(_is_number, value))


def _are_numbers(value: object) -> bool:
    return isinstance(value, dict) and all(map(_is_number, value.values()))


def _are_labels(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(label, str) for label in value)


def _is_time(value: Any) -> bool:
    return _is_number(value) and 0 <= value < 2**31  # what a stamp of ROS holds


_RESPONSE: dict[str, Check] = {
    'id': _or_none(_is(str)),
    'phase': lambda value: value in [phase.value for phase in Phase],
    'code': _is(str),
    'reason': _or_none(_is(str)),
    'shot': _or_none(_is(int)),
    'velocity': _or_none(_is_pair),
    'integrator': _or_none(_is(str)),
    't_start': _or_none(_is_time),
    't_end': _or_none(_is_time),
    'events': _or_none(_is(int)),
    'final_positions': _or_none(_are_places),
    'final_positions_in': _or_none(_are_places),
    'as_printed': _or_none(_is(bool)),
    'spin': _or_none(_is_spin),
    'cue': _or_none(_are_numbers),
    'place': _or_none(_are_places),
    'pocketed': _or_none(_are_numbers),
}

_NEEDED: dict[str, tuple[str, ...]] = {
    Phase.ACCEPTED.value: ('velocity', 'integrator'),
    Phase.REJECTED.value: ('reason',),
    Phase.DONE.value: ('velocity', 't_start', 't_end', 'final_positions', 'final_positions_in'),
    Phase.PREEMPTED.value: ('reason',),
}
"""What its readers rely on, beside phase and code."""

_STATE: dict[str, Check] = {
    'paused': _is(bool),
    'moving': _is(bool),
    'computing': _is(bool),
    'tick': _is(int),
    'sim_time': _or_none(_is_number),
    'real_time_factor': _or_none(_is_number),
    'pocketed': _or_none(_are_labels),
}
