"""A table as a JSON file."""

from __future__ import annotations

import dataclasses
import json
import os
from pathlib import Path
from typing import Any

import numpy as np

from pool_sim_ros.physics.balls import Ball
from pool_sim_ros.physics.cushions import Cushions
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.validation import shown

FORMAT = 'pool_sim_ros table'
VERSION = 1
LARGEST = 64 * 1024 * 1024
"""Bytes that are read at most: a table with a hundred thousand balls has some 20 MB."""


def save_table(table: Table, path: str | os.PathLike[str]) -> None:
    """Write a table to a JSON file."""
    Path(path).expanduser().write_text(table_text(table), encoding='utf-8')


def load_table(path: str | os.PathLike[str]) -> Table:
    """Read a table from a JSON file.

    Raises
    ------
    ValueError
        Where it is no such file; names the file, and the field that is wrong.
    OSError
    """
    file = Path(path).expanduser()
    try:
        with open(file, 'rb') as opened:
            text = opened.read(LARGEST + 1)
        if len(text) > LARGEST:
            raise ValueError(f'it has more than {LARGEST // 2**20} MiB')
        return table_of_text(text)
    except ValueError as error:
        raise ValueError(f'{file}: {error}') from None


def table_text(table: Table) -> str:
    """Return a table as JSON."""
    content = {'format': FORMAT, 'version': VERSION, **table_to_fields(table)}
    return json.dumps(content, indent=1) + '\n'


def table_to_fields(table: Table) -> dict[str, Any]:
    """Return the fields of a table and of its balls as numbers, texts and lists.

    Parameters
    ----------
    table : Table

    Returns
    -------
    dict
    """
    return {field.name: _plain(getattr(table, field.name)) for field in dataclasses.fields(table)}


def table_of_text(text: str | bytes) -> Table:
    """Return the table that `table_text` made JSON of; raise ValueError, naming the field."""
    try:
        content = json.loads(text)
    except RecursionError:
        raise ValueError('it is nested too deep') from None
    if not isinstance(content, dict) or content.pop('format', None) != FORMAT:
        raise ValueError(f'it is no {FORMAT}')
    version = content.pop('version', None)
    if version != VERSION:
        raise ValueError(f'version: {shown(version)} must be {VERSION}')
    return table_from_fields(content)


def _plain(value: Any) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {field.name: _plain(getattr(value, field.name)) for field in _fields(value)}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return value


def _fields(value: Any) -> tuple[dataclasses.Field[Any], ...]:
    return dataclasses.fields(value)


def table_from_fields(content: dict[str, Any]) -> Table:
    """Return the table of which `table_to_fields` gives these.

    Parameters
    ----------
    content : dict

    Returns
    -------
    Table

    Raises
    ------
    ValueError
        Where a field is missing, unknown or wrong; names it.
    """
    balls = content.get('balls')
    if not isinstance(balls, list):
        raise ValueError(f'balls: {shown(balls)} must be a list')
    made = {**content, 'balls': [_made(Ball, f'balls[{k}]', b) for k, b in enumerate(balls)]}
    if content.get('cushions') is not None:
        made['cushions'] = _made(Cushions, 'cushions', content['cushions'])
    return _made(Table, 'table', made)


def _made(kind: type, name: str, given: Any) -> Any:
    """Return a dataclass from its fields; raise ValueError for what it has not."""
    if not isinstance(given, dict):
        raise ValueError(f'{name}: {shown(given)} must be an object')
    known = {field.name: field for field in dataclasses.fields(kind)}
    for key in given:
        if key not in known:
            raise ValueError(f'{name}: {key!r} is not a field; there are {", ".join(known)}')
    for key, field in known.items():
        if key not in given and field.default is dataclasses.MISSING:
            raise ValueError(f'{name}: {key!r} is missing')
    return kind(**given)
