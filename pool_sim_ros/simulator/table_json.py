"""The JSON of a table, as `~/table` carries it."""

from __future__ import annotations

import json
from dataclasses import asdict

from pool_sim_ros.physics import Ball, Table


def table_to_json(table: Table) -> str:
    """Return a table as JSON: its fields and those of its balls, under their own names."""
    return json.dumps(asdict(table), allow_nan=False)


def table_from_json(text: str) -> Table:
    """Return the table that `table_to_json` was given.

    Raises
    ------
    ValueError
        Where the text is not such JSON or its values make no table.
    """
    try:
        fields = json.loads(text)
        balls = tuple(Ball(**ball) for ball in fields.pop('balls'))
        return Table(balls=balls, **fields)
    except (AttributeError, KeyError, TypeError) as error:
        raise ValueError(f'this is not a table: {error}') from error
