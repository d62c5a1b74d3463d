"""Names of nodes, checked without ROS."""

from __future__ import annotations

import argparse
import re

NODE_NAME = 'pool_sim'
"""The node's name unless it is renamed."""

ORACLE_NAME = 'pool_oracle'
"""The name of the oracle's node unless it is renamed."""

LONGEST_NAME = 200
"""Characters of a node's name: those of its topics may have 247."""

_NAME = re.compile(r'/?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*')


def node_name(text: str) -> str:
    """Read the name of a node, relative to the own namespace or absolute.

    Raises
    ------
    ArgumentTypeError
        If no node can have it.
    """
    if len(text) > LONGEST_NAME:
        raise argparse.ArgumentTypeError(
            f'the name has {len(text)} characters; at most {LONGEST_NAME} are taken'
        )
    if not _NAME.fullmatch(text):
        raise argparse.ArgumentTypeError(
            f'{text!r} is not the name of a node, like {NODE_NAME} or /hall/{NODE_NAME}'
        )
    return text
