"""Writes the command log: every command that changed what the frames show, as JSON lines.

The first line has the parameters. Each further line has a command and the first tick that shows it:

    {"tick": 12, "command": "set", "parameters": {"table.e_cue_ball": 0.95}}
    {"tick": 12, "command": "strike", "velocity": [-4.0, 0.0]}
    {"tick": 99, "command": "shot", "shot": 1}
    {"tick": 140, "command": "reset"}
    {"tick": 150, "command": "place", "positions": [[0.5, 0.5], [1.0, 0.5]]}
    {"tick": 200, "command": "end"}

On a table on which balls spin, a strike has the spin too, and a placement the orientations of the
balls where any is turned. Version 1 knew no such tables, and so neither their parameters.

A command that was rejected, was overtaken or never started a shot is not in it; nor is a pause,
which shows no frames. Numbers are written so that they are read back bit for bit.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import TextIO

import numpy as np

from pool_sim_ros.simulator.layout import IDENTITY, Layout
from pool_sim_ros.simulator.settings import Settings, values_of

FORMAT = 'pool_sim_ros command log'
VERSION = 2

MAX_LOG = 100_000_000
"""Bytes of a log, written or read: a line has some 70, but a layout 50 for each ball."""

MAX_LINES = 1_000_000
"""Lines of a log, written or read: eleven days with a shot every second. Read, they take 400 MB."""

MAX_TICK = 100_000_000
"""Latest tick in a log, written or read: 19 days of 60 frames a second. Each is played again."""


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
            raise LogError(f'{path} cannot be written: {cause(error)}') from None
        self._write({'format': FORMAT, 'version': VERSION, 'parameters': self._values})

    def layout(self, tick: int, layout: Layout | None) -> None:
        """Note that this tick shows the balls like this; None: the start layout."""
        if layout is None:
            self._write({'tick': tick, 'command': 'reset'}, tick)
            return
        rows: dict[str, object] = {'positions': layout.positions.tolist()}
        turned = layout.orientations
        if turned is not None and np.any(turned != IDENTITY):
            rows['orientations'] = turned.tolist()
        self._write({'tick': tick, 'command': 'place', **rows}, tick)

    def strike(
        self,
        tick: int,
        settings: Settings,
        shot: int | None,
        velocity: tuple[float, float],
        spin: tuple[float, float, float] | None = None,
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
        spin : tuple of float or None, optional
            The same, rad/s; None on a table of discs.
        """
        values = values_of(settings)
        changed = {name: value for name, value in values.items() if value != self._values[name]}
        if changed:
            self._write({'tick': tick, 'command': 'set', 'parameters': changed}, tick)
            self._values = values
        if shot is None:
            turns = {} if spin is None else {'spin': spin}
            strike = {'tick': tick, 'command': 'strike', 'velocity': velocity, **turns}
            self._write(strike, tick)
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
            self._on_error(f'recording ends here: {self._path} cannot be written: {cause(error)}')


def cause(error: Exception) -> str:
    """Return why a file could not be used."""
    return getattr(error, 'strerror', None) or str(error)
