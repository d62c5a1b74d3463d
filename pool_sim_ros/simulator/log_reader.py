"""Reads a command log that anybody may have written."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from pool_sim_ros.physics import MOTIONS
from pool_sim_ros.simulator.bounded_file import FileError, open_bounded, read_lines
from pool_sim_ros.simulator.command_log import (
    FORMAT,
    MAX_LINES,
    MAX_LOG,
    MAX_TICK,
    VERSION,
    LogError,
    cause,
)
from pool_sim_ros.simulator.parameter_table import PARAMETERS, REPORT, parameters_of
from pool_sim_ros.simulator.parameter_values import coerce_all
from pool_sim_ros.simulator.settings import Settings, build_settings
from pool_sim_ros.simulator.strict_json import read_json_object

MAX_LINE = 10_000_000
"""Bytes of a line that are read: a layout of 100 000 balls has half of it."""

KEYS: dict[str, set[str]] = {
    'set': {'parameters'},
    'strike': {'velocity'},
    'shot': {'shot'},
    'reset': set(),
    'place': {'positions'},
    'end': set(),
}
"""The keys of each command, beside tick and command."""

OPTIONAL_KEYS = {'strike': {'spin'}, 'place': {'orientations'}}
"""Further keys on a table on which balls spin."""

VECTORS = {'velocity': 2, 'spin': 3}
ROWS = {'positions': 2, 'orientations': 4}
"""How many numbers a value has, or one of its rows for each ball."""

UNIT = 1e-6
"""Most by which a unit quaternion is off: numbers are written as they are."""

NEW_IN_2 = {'table.preset': REPORT, 'table.motion': 'disc'}
"""Parameters that a log of version 1 does not have, and what they were."""


def read_log(
    path: str | Path, on_note: Callable[[str], None] = lambda line: None
) -> tuple[Settings, list[dict[str, Any]]]:
    """Read a command log that anybody may have written.

    Parameters
    ----------
    path : str or Path
    on_note : callable, optional
        Called with a line for the user where the last line of the log is cut off, since the node
        was killed while it wrote it; all before it is returned.

    Returns
    -------
    settings : Settings
        At the start.
    commands : list of dict
        As they were written, positions as (n, 2) arrays in m; the ticks never go back.

    Raises
    ------
    LogError
        Where it is no log, or a line in it is wrong; names the line.
    """
    try:
        with open_bounded(path, MAX_LOG) as file:
            return _read(file, path, on_note)
    except (FileError, OSError) as error:
        raise LogError(f'{path} cannot be read: {cause(error)}') from None
    except MemoryError:
        raise LogError(f'{path} cannot be read: the memory is full') from None


def _read(
    file: BinaryIO, path: str | Path, on_note: Callable[[str], None]
) -> tuple[Settings, list[dict[str, Any]]]:
    settings: Settings | None = None
    commands: list[dict[str, Any]] = []
    number = 1
    try:
        for line, whole in read_lines(file, MAX_LINE):
            _require(number <= MAX_LINES, f'a log has at most {MAX_LINES} lines')
            try:
                if settings is None:
                    settings = _header(line)
                else:
                    commands.append(_command(line, commands[-1:], settings))
            except ValueError:
                if whole or settings is None or not _is_cut(line):
                    raise
                on_note(f'{path}, line {number} is cut off; what stands before it is played')
            number += 1
        if settings is None:
            raise ValueError('the file is empty')
    except ValueError as error:
        raise LogError(f'{path}, line {number}: {error}') from None
    return settings, commands


def _is_cut(line: str) -> bool:
    """Return whether a line without its end begins as the node writes it, and stops in between."""
    start = '{"tick": '
    if not (line.startswith(start) or start.startswith(line)):
        return False
    try:
        json.loads(line)
    except json.JSONDecodeError:
        return True
    except (ValueError, RecursionError):
        pass
    return False


def _header(line: str) -> Settings:
    fields = _object(line)
    _require(fields.get('format') == FORMAT, f'this is not a {FORMAT}')
    version = fields.get('version')
    known = type(version) is int and 1 <= version <= VERSION
    _require(known, f'the version must be 1 or {VERSION}')
    values = fields.get('parameters')
    if isinstance(values, dict) and version == 1:
        _require(not set(values) & set(NEW_IN_2), 'a log of version 1 has discs on its table')
        values = {**values, **NEW_IN_2}
    motion = values.get('table.motion') if isinstance(values, dict) else None
    names = parameters_of(motion) if motion in MOTIONS else PARAMETERS
    if not isinstance(values, dict) or set(values) != set(names):
        raise ValueError('parameters must have every parameter, and no other')
    return build_settings(coerce_all(values))


def _command(line: str, last: list[dict[str, Any]], settings: Settings) -> dict[str, Any]:
    fields = _object(line)
    _require(not last or last[0]['command'] != 'end', 'nothing may follow the end')
    least: int = last[0]['tick'] if last else 0
    name = fields.get('command')
    if not isinstance(name, str) or name not in KEYS:
        raise ValueError(f'command must be one of {", ".join(KEYS)}')
    keys = KEYS[name] | {'tick', 'command'}
    more = OPTIONAL_KEYS.get(name, set()) if settings.table.motion == 'ball' else set()
    _require(
        keys <= set(fields) <= keys | more,
        f'{name} must have the keys {", ".join(sorted(keys))}'
        + (f' and may have {", ".join(more)}' if more else ''),
    )
    whole = type(fields['tick']) is int and least <= fields['tick'] <= MAX_TICK
    _require(whole, f'tick must be a whole number from {least} to {MAX_TICK}')
    if name == 'set':
        _require(isinstance(fields['parameters'], dict), 'parameters must be an object')
        fields['parameters'] = coerce_all(fields['parameters'])
    if name == 'shot':
        _require(type(fields['shot']) is int, 'shot must be a whole number')
    count = len(settings.table.balls)
    for key, width in ROWS.items():
        if key in fields:
            rows = fields[key]
            right = isinstance(rows, list) and len(rows) == count
            _require(right, f'{key} must be {count} rows, one for each ball')
            fields[key] = np.array([_numbers(f'a row of {key}', row, width) for row in rows])
    if 'orientations' in fields:
        lengths = np.linalg.norm(fields['orientations'], axis=1)
        unit = bool(np.all(np.abs(lengths - 1.0) <= UNIT))
        _require(unit, 'orientations must be unit quaternions')
    for key, width in VECTORS.items():
        if key in fields:
            fields[key] = _numbers(key, fields[key], width)
    return fields


def _numbers(name: str, values: object, count: int) -> tuple[float, ...]:
    if isinstance(values, list) and len(values) == count:
        if all(type(value) in (int, float) and math.isfinite(value) for value in values):
            return tuple(map(float, values))
    raise ValueError(f'{name} must be {count} finite numbers')


def _object(line: str) -> dict[str, Any]:
    try:
        return read_json_object(line)
    except ValueError as error:
        raise ValueError(f'this cannot be read as a JSON object: {error}') from None


def _require(good: bool, message: str) -> None:
    if not good:
        raise ValueError(message)
