"""The command log: every command that changed what the frames show, with its tick, as JSON lines.

The first line has the parameters. Each further line has a command and the first tick that shows it:

    {"tick": 12, "command": "set", "parameters": {"table.e_cue_ball": 0.95}}
    {"tick": 12, "command": "strike", "velocity": [-4.0, 0.0]}
    {"tick": 99, "command": "shot", "shot": 1}
    {"tick": 140, "command": "reset"}
    {"tick": 150, "command": "place", "positions": [[0.5, 0.5], [1.0, 0.5]]}
    {"tick": 200, "command": "end"}

A command that was rejected, was overtaken or never started a shot is not in it; nor is a pause,
which shows no frames. Numbers are written so that they are read back bit for bit.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO, TextIO

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.simulator.bounded_file import FileError, open_bounded, read_lines
from pool_sim_ros.simulator.parameter_table import PARAMETERS
from pool_sim_ros.simulator.parameter_values import coerce_all
from pool_sim_ros.simulator.settings import Settings, build_settings, values_of
from pool_sim_ros.simulator.strict_json import read_json_object

FORMAT = 'pool_sim_ros command log'
VERSION = 1

MAX_LINE = 10_000_000
"""Bytes of a line that are read: a layout of 100 000 balls has half of it."""

MAX_LOG = 100_000_000
"""Bytes of a log, written or read: a line has some 70, but a layout 50 for each ball."""

MAX_LINES = 1_000_000
"""Lines of a log, written or read: eleven days with a shot every second. Read, they take 400 MB."""

MAX_TICK = 100_000_000
"""Latest tick in a log, written or read: 19 days of 60 frames a second. Each is played again."""

KEYS: dict[str, set[str]] = {
    'set': {'parameters'},
    'strike': {'velocity'},
    'shot': {'shot'},
    'reset': set(),
    'place': {'positions'},
    'end': set(),
}
"""The keys of each command, beside tick and command."""


class LogError(ValueError):
    """A log that cannot be written or read; the message is for the user."""


class CommandLog:
    """Writes a command log; each line is in the file as soon as its command is noted.

    Parameters
    ----------
    path : str
        Must not exist yet, so that no log is overwritten.
    settings : Settings
    on_error : callable, optional
        Called once, with a message, where a line cannot be written, or the log has become as long
        as one that is read may be; it ends there.

    Raises
    ------
    LogError
        Where the file cannot be made.
    """

    def __init__(
        self, path: str, settings: Settings, on_error: Callable[[str], None] = lambda line: None
    ) -> None:
        self._path = path
        self._on_error = on_error
        self._size = self._lines = 0
        self._values = values_of(settings)
        self._file: TextIO | None = None
        try:
            self._file = open(path, 'x', encoding='utf-8')
        except FileExistsError:
            raise LogError(f'{path} exists; name a new file for the log') from None
        except (OSError, ValueError) as error:
            raise LogError(f'{path} cannot be written: {_cause(error)}') from None
        self._write({'format': FORMAT, 'version': VERSION, 'parameters': self._values})

    def layout(self, tick: int, positions: NDArray[np.float64] | None) -> None:
        """Note that this tick shows the balls at (n, 2) positions in m; None: the start layout."""
        if positions is None:
            self._write({'tick': tick, 'command': 'reset'}, tick)
        else:
            rows = positions.tolist()
            self._write({'tick': tick, 'command': 'place', 'positions': rows}, tick)

    def strike(
        self,
        tick: int,
        settings: Settings,
        shot: int | None,
        velocity: tuple[float, float],
    ) -> None:
        """Note a shot.

        Parameters
        ----------
        tick : int
            The one that starts it.
        settings : Settings
            Those at its strike; what has changed since the last shot is noted first.
        shot : int or None
            Number of a report shot.
        velocity : tuple of float
            Of the cue ball in any other shot, m/s.
        """
        values = values_of(settings)
        changed = {name: value for name, value in values.items() if value != self._values[name]}
        if changed:
            self._write({'tick': tick, 'command': 'set', 'parameters': changed}, tick)
            self._values = values
        if shot is None:
            self._write({'tick': tick, 'command': 'strike', 'velocity': velocity}, tick)
        else:
            self._write({'tick': tick, 'command': 'shot', 'shot': shot}, tick)

    def close(self, tick: int) -> None:
        """End the log before this tick."""
        self._write({'tick': tick, 'command': 'end'}, tick)
        file, self._file = self._file, None
        if file is not None:
            file.close()

    def _write(self, fields: dict[str, object], tick: int = 0) -> None:
        if self._file is None:
            return
        line = json.dumps(fields, allow_nan=False) + '\n'
        self._size += len(line)  # ASCII
        self._lines += 1
        try:
            if self._size > MAX_LOG or self._lines > MAX_LINES or tick > MAX_TICK:
                self._file.close()
                limits = f'{MAX_LOG} bytes, {MAX_LINES} lines or {MAX_TICK} ticks'
                raise OSError(f'it would have more than {limits}')
            self._file.write(line)
            self._file.flush()
        except OSError as error:
            self._file = None  # not closed: that would try to write once more
            self._on_error(f'recording ends here: {self._path} cannot be written: {_cause(error)}')


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
        raise LogError(f'{path} cannot be read: {_cause(error)}') from None
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
    _require(type(version) is int and version == VERSION, f'the version must be {VERSION}')
    values = fields.get('parameters')
    if not isinstance(values, dict) or set(values) != set(PARAMETERS):
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
    _require(set(fields) == keys, f'{name} must have the keys {", ".join(sorted(keys))}')
    whole = type(fields['tick']) is int and least <= fields['tick'] <= MAX_TICK
    _require(whole, f'tick must be a whole number from {least} to {MAX_TICK}')
    if name == 'set':
        _require(isinstance(fields['parameters'], dict), 'parameters must be an object')
        fields['parameters'] = coerce_all(fields['parameters'])
    if name == 'shot':
        _require(type(fields['shot']) is int, 'shot must be a whole number')
    if name == 'place':
        rows, count = fields['positions'], len(settings.table.balls)
        right = isinstance(rows, list) and len(rows) == count
        _require(right, f'positions must be {count} rows, one for each ball')
        fields['positions'] = np.array([_pair('a position', row) for row in rows])
    if name == 'strike':
        fields['velocity'] = _pair('velocity', fields['velocity'])
    return fields


def _pair(name: str, values: object) -> tuple[float, float]:
    if isinstance(values, list) and len(values) == 2:
        x, y = values
        numbers = type(x) in (int, float) and type(y) in (int, float)
        if numbers and math.isfinite(x) and math.isfinite(y):
            return float(x), float(y)
    raise ValueError(f'{name} must be two finite numbers')


def _object(line: str) -> dict[str, Any]:
    try:
        return read_json_object(line)
    except ValueError as error:
        raise ValueError(f'this cannot be read as a JSON object: {error}') from None


def _require(good: bool, message: str) -> None:
    if not good:
        raise ValueError(message)


def _cause(error: Exception) -> str:
    return getattr(error, 'strerror', None) or str(error)
