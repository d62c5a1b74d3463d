"""Read the node's parameter file without ROS."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from pool_sim_ros.report.errors import ReportError
from pool_sim_ros.report.strict_yaml import read_yaml
from pool_sim_ros.simulator import (
    FileError,
    ParameterError,
    Settings,
    build_settings,
    near_misses,
    read_text,
    values_from,
)

MAX_FILE = 10_000_000
"""Bytes of a parameter file: the lists of 50,000 balls."""


class TableFileError(ReportError):
    """A parameter file that cannot be used."""


def read_settings(path: Path) -> Settings:
    """Return the settings in a parameter file like ``config/report.yaml``.

    A name that is nearly one of the parameters is told on stderr.

    Parameters
    ----------
    path : Path

    Raises
    ------
    TableFileError
        If the file cannot be read, or if a node would refuse to start with it.
    """
    try:
        content = read_yaml(read_text(path, MAX_FILE))
    except (FileError, ValueError) as error:
        raise TableFileError(f'cannot read {path}: {error}') from error
    try:
        values = dict(_flat(_parameters(content)))
        settings = build_settings(values_from(values))
    except ParameterError as error:
        raise TableFileError(f'{path}: {error}') from error
    for name, ours in near_misses(values).items():
        print(f'{path}: {name} is not a parameter; did you mean {ours}?', file=sys.stderr)
    return settings


def _parameters(content: object) -> Mapping[str, object]:
    for key in ('/**', 'ros__parameters'):
        content = content.get(key) if isinstance(content, Mapping) else None
    if not isinstance(content, Mapping):
        raise ParameterError('it must have its parameters under /**: and ros__parameters:')
    return content


def _flat(tree: Mapping[str, object], prefix: str = '') -> Iterator[tuple[str, object]]:
    """Yield dotted names with their values."""
    for key, value in tree.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f'{prefix}{key}.')
        else:
            yield f'{prefix}{key}', value
