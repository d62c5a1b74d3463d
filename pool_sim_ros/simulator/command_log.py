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
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TextIO

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.simulator.parameter_table import PARAMETERS
from pool_sim_ros.simulator.parameter_values import coerce_all
from pool_sim_ros.simulator.settings import Settings, build_settings, values_of

FORMAT = 'pool_sim_ros command log'
VERSION = 1

MAX_LINE = 10_000_000
"""Characters of a line that are read: a layout of 100 000 balls has half of it."""

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
        Called once, with a message, where a line cannot be written; the log ends there.

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
            self._write({'tick': tick, 'command': 'reset'})
        else:
            rows = positions.tolist()
            self._write({'tick': tick, 'command': 'place', 'positions': rows})

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
            self._write({'tick': tick, 'command': 'set', 'parameters': changed})
            self._values = values
        if shot is None:
            self._write({'tick': tick, 'command': 'strike', 'velocity': velocity})
        else:
            self._write({'tick': tick, 'command': 'shot', 'shot': shot})

    def close(self, tick: int) -> None:
        """End the log before this tick."""
        self._write({'tick': tick, 'command': 'end'})
        file, self._file = self._file, None
        if file is not None:
            file.close()

    def _write(self, fields: dict[str, object]) -> None:
        if self._file is None:
            return
        try:
            self._file.write(json.dumps(fields, allow_nan=False) + '\n')
            self._file.flush()
        except OSError as error:
            self._file = None  # not closed: that would try to write once more
            self._on_error(f'recording ends here: {self._path} cannot be written: {_cause(error)}')


def read_log(path: str | Path) -> tuple[Settings, list[dict[str, Any]]]:
    """Read a command log.

    Parameters
    ----------
    path : str or Path

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
        with open(path, encoding='utf-8') as file:
            lines = list(_lines(file))
    except (OSError, UnicodeDecodeError) as error:
        raise LogError(f'{path} cannot be read: {_cause(error)}') from None
    number = 1
    try:
        settings = _header(lines[0] if lines else '')
        commands: list[dict[str, Any]] = []
        tick, ended = 0, False
        for number, line in enumerate(lines[1:], 2):  # noqa: B007
            _require(not ended, 'nothing may follow the end')
            command = _command(line, tick)
            tick, ended = command['tick'], command['command'] == 'end'
            commands.append(command)
    except ValueError as error:
        raise LogError(f'{path}, line {number}: {error}') from None
    return settings, commands


def _lines(file: TextIO) -> Iterator[str]:
    while line := file.readline(MAX_LINE):
        if not line.endswith('\n'):
            return  # the node was killed while it wrote this line
        yield line


def _header(line: str) -> Settings:
    fields = _object(line)
    _require(fields.get('format') == FORMAT, f'this is not a {FORMAT}')
    _require(fields.get('version') == VERSION, f'the version must be {VERSION}')
    values = fields.get('parameters')
    if not isinstance(values, dict) or set(values) != set(PARAMETERS):
        raise ValueError('parameters must have every parameter, and no other')
    return build_settings(coerce_all(values))


def _command(line: str, tick: int) -> dict[str, Any]:
    fields = _object(line)
    name = fields.get('command')
    if not isinstance(name, str) or name not in KEYS:
        raise ValueError(f'command must be one of {", ".join(KEYS)}')
    keys = KEYS[name] | {'tick', 'command'}
    _require(set(fields) == keys, f'{name} must have the keys {", ".join(sorted(keys))}')
    whole = type(fields['tick']) is int and fields['tick'] >= tick
    _require(whole, f'tick must be a whole number, {tick} or later')
    if name == 'set':
        _require(isinstance(fields['parameters'], dict), 'parameters must be an object')
        fields['parameters'] = coerce_all(fields['parameters'])
    if name == 'shot':
        _require(type(fields['shot']) is int, 'shot must be a whole number')
    if name == 'place':
        fields['positions'] = _array(fields['positions'], 2)
    if name == 'strike':
        velocity = _array(fields['velocity'], 1)
        _require(velocity.shape == (2,), 'velocity must be two numbers')
        fields['velocity'] = tuple(velocity.tolist())
    return fields


def _array(values: object, dimensions: int) -> NDArray[np.float64]:
    try:
        array = np.array(values, dtype=float)
    except (TypeError, ValueError, OverflowError):
        array = np.empty(())
    good = array.ndim == dimensions and bool(np.isfinite(array).all())
    _require(good, 'the numbers must be finite, and as many in each row')
    return array


def _object(line: str) -> dict[str, Any]:
    try:
        fields = json.loads(line)
    except (ValueError, RecursionError):
        fields = None
    if not isinstance(fields, dict):
        raise ValueError('this is not a JSON object')
    return fields


def _require(good: bool, message: str) -> None:
    if not good:
        raise ValueError(message)


def _cause(error: Exception) -> str:
    return getattr(error, 'strerror', None) or str(error)
