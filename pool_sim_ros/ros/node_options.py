"""The options of a node, checked: rclpy's own errors about them do not say which one is wrong."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rclpy.context import Context
from rclpy.parameter import Parameter

KINDS: dict[str, tuple[type, str]] = {
    'node_name': (str, 'a string'),
    'context': (Context, 'a rclpy Context'),
    'cli_args': (list, 'a list of strings'),
    'namespace': (str, 'a string'),
    'parameter_overrides': (list, 'a list of rclpy Parameters'),
}
"""The type of each option that is no flag, and the same in words."""

ITEMS: dict[str, type] = {'cli_args': str, 'parameter_overrides': Parameter}
"""The type of what is in a list."""


def check_options(node_name: str, options: Mapping[str, Any]) -> None:
    """Check what rclpy's Node is given; None stands for its default.

    Raises
    ------
    TypeError
        Where an option has a wrong type; names it.
    """
    for name, value in {'node_name': node_name, **options}.items():
        kind, words = KINDS.get(name, (bool, 'true or false'))
        right = isinstance(value, kind) or (value is None and name in KINDS and name != 'node_name')
        if right and isinstance(value, list):
            right = all(isinstance(item, ITEMS[name]) for item in value)
        if not right:
            raise TypeError(f'{name} must be {words}, not {value!r:.100}')
