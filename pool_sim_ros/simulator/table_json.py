"""The JSON of a table, as `~/table` carries it."""

from __future__ import annotations

import json

from pool_sim_ros.physics import Table, table_from_fields, table_to_fields
from pool_sim_ros.simulator.strict_json import read_json_object

LONGEST = 10_000_000
"""Characters that are read: enough for 40,000 balls."""


def table_to_json(table: Table) -> str:
    """Return a table as JSON: its fields and those of its balls, under their own names."""
    return json.dumps(table_to_fields(table), allow_nan=False)


def table_from_json(text: str) -> Table:
    """Return the table that `table_to_json` was given.

    Raises
    ------
    ValueError
        Where the text is not such JSON or its values make no table.
    """
    if len(text) > LONGEST:
        raise ValueError(f'a table has at most {LONGEST} characters, not {len(text)}')
    try:
        return table_from_fields(read_json_object(text))
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise ValueError(f'this is no table: {error}') from error
