"""The log of a session: every (tick, command) that changed what the frames show, as JSON lines.

The first line has the parameters. Then come, each with the tick whose frame first shows it:

    {"tick": 12, "command": "set", "parameters": {"table.e_cue_ball": 0.95}}
    {"tick": 12, "command": "strike", "velocity": [-4.0, 0.0]}
    {"tick": 99, "command": "shot", "shot": 1}
    {"tick": 140, "command": "reset"}
    {"tick": 150, "command": "place", "positions": [[0.5, 0.5], [1.0, 0.5]]}
    {"tick": 200, "command": "end"}

Whatever was rejected, overtaken or never started is not in it; a pause shows no frames and needs no
line. Numbers are written so that they are read back bit for bit.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TextIO

import numpy as np

from pool_sim_ros.simulator.settings import (
    PARAMETERS,
    ParameterError,
    Settings,
    build_settings,
    coerce,
    values_of,
)

FORMAT = 'pool_sim_ros command log'
VERSION = 1

MAX_LINE = 10_000_000
"""Characters of a line that are read: a layout of 100 000 balls has half of it."""

KEYS = {
    'set': {'parameters'},
    'strike': {'velocity'},
    'shot': {'shot'},
    'reset': set(),
    'place': {'positions'},
    'end': set(),
}


class LogError(ValueError):
    """A log that cannot be written or read; the message is for the user."""


class CommandLog:
    """Writes the log; a line is in the file as soon as it is written.

    Parameters
    ----------
    path : str
        Must not exist yet: a session is not to overwrite another.
    settings : Settings
    on_error : callable, optional
        Called once, with words, where a line cannot be written; the log ends there.

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
            raise LogError(f'{path} cannot be written: {_words(error)}') from None
        self._write({'format': FORMAT, 'version': VERSION, 'parameters': self._values})

    def layout(self, tick: int, positions: np.ndarray | None) -> None:
        """Note that this tick shows the balls at (n, 2) positions in m; None: the start layout."""
        if positions is None:
            self._write({'tick': tick, 'command': 'reset'})
        else:
            places = positions.tolist()
            self._write({'tick': tick, 'command': 'place', 'positions': places})

    def strike(
        self,
        tick: int,
        settings: Settings,
        shot: int | None,
        velocity: tuple[float, float],
    ) -> None:
        """Note the tick that starts a shot, the settings that it is played with, and the shot."""
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
            self._on_error(f'recording ends here: {self._path} cannot be written: {_words(error)}')


def read_log(path: str | Path) -> tuple[Settings, list[dict]]:
    """Read a log.

    Returns
    -------
    settings : Settings
        At the start.
    commands : list of dict
        As they were written; the ticks never go back.

    Raises
    ------
    LogError
        Where it is no log, or a line in it is wrong; names the line.
    """
    try:
        with open(path, encoding='utf-8') as file:
            lines = list(_lines(file))
    except (OSError, UnicodeDecodeError) as error:
        raise LogError(f'{path} cannot be read: {_words(error)}') from None
    number = 1  # in the words about an error
    try:
        settings = _header(lines[0] if lines else '')
        commands, tick, ended = [], 0, False
        for number, line in enumerate(lines[1:], 2):  # noqa: B007
            _require(not ended, 'nothing may follow the end')
            command = _command(line, tick)
            tick, ended = command['tick'], command['command'] == 'end'
            commands.append(command)
    except ValueError as error:
        raise LogError(f'{path}, line {number}: {error}') from None
    return settings, commands


def _lines(file: TextIO):
    while line := file.readline(MAX_LINE):
        if not line.endswith('\n'):
            return  # what was being written when the node was killed
        yield line


def _header(line: str) -> Settings:
    fields = _object(line)
    _require(fields.get('format') == FORMAT, f'this is not a {FORMAT}')
    _require(fields.get('version') == VERSION, f'the version must be {VERSION}')
    values = fields.get('parameters')
    right = isinstance(values, dict) and set(values) == set(PARAMETERS)
    _require(right, 'parameters must have every parameter, and no other')
    return build_settings(coerced(values))


def _command(line: str, tick: int) -> dict:
    fields = _object(line)
    name = fields.get('command')
    _require(isinstance(name, str) and name in KEYS, f'command must be one of {", ".join(KEYS)}')
    keys = KEYS[name] | {'tick', 'command'}
    _require(set(fields) == keys, f'{name} must have the keys {", ".join(sorted(keys))}')
    whole = type(fields['tick']) is int and fields['tick'] >= tick
    _require(whole, f'tick must be a whole number, {tick} or later')
    if name == 'set':
        _require(isinstance(fields['parameters'], dict), 'parameters must be an object')
        fields['parameters'] = coerced(fields['parameters'])
    if name == 'place':
        fields['positions'] = _array(fields['positions'], 2)
    if name == 'strike':
        velocity = _array(fields['velocity'], 1)
        _require(velocity.shape == (2,), 'velocity must be two numbers')
        fields['velocity'] = tuple(velocity.tolist())
    return fields


def coerced(values: Mapping[str, object]) -> dict[str, object]:
    """Return parameters in their own types; raise ParameterError where one cannot be."""
    for name in values:
        if name not in PARAMETERS:
            raise ParameterError(f'{name} is not a parameter')
    return {name: coerce(name, value) for name, value in values.items()}


def _array(values: object, dimensions: int) -> np.ndarray:
    try:
        array = np.array(values, dtype=float)
    except (TypeError, ValueError):
        array = np.empty(())
    right = array.ndim == dimensions and np.isfinite(array).all()
    _require(bool(right), 'the numbers must be finite, and as many in each row')
    return array


def _object(line: str) -> dict:
    try:
        fields = json.loads(line)
    except (ValueError, RecursionError):
        fields = None
    _require(isinstance(fields, dict), 'this is not a JSON object')
    return fields


def _require(good: bool, words: str) -> None:
    if not good:
        raise ValueError(words)


def _words(error: Exception) -> str:
    return getattr(error, 'strerror', None) or str(error)
