"""The arguments of commands that belong to a simulator, read without ROS."""

from __future__ import annotations

import argparse

from pool_sim_ros.console import positive
from pool_sim_ros.ros.names import NODE_NAME, node_name


def add_simulator(parser: argparse.ArgumentParser) -> None:
    """Add --node, the name of the simulator."""
    parser.add_argument(
        '--node',
        type=node_name,
        default=NODE_NAME,
        metavar='NAME',
        help='name of the simulator (default: %(default)s)',
    )


def add_timeout(parser: argparse.ArgumentParser) -> None:
    """Add --timeout, the patience of a client in s."""
    parser.add_argument(
        '--timeout',
        type=positive,
        default=10.0,
        metavar='S',
        help='give up after so many seconds without a sign of it (default: %(default)g)',
    )
