"""The command `oracle`: answer what-ifs and make plans until SIGINT or SIGTERM."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from pool_sim_ros.console import CommandError, Parser, count
from pool_sim_ros.ros import add_simulator, ros_command

if TYPE_CHECKING:
    from rclpy.context import Context

SHUTDOWN_PATIENCE = 0.1
"""Seconds to wait for the end of a search before the process ends."""


def _parser() -> argparse.ArgumentParser:
    epilog = [
        'ROS arguments, like --ros-args -r __node:=NAME -r __ns:=/NS, may follow.',
        'With -p scheduler:=tcp://host:8786 among them a Dask cluster plays the shots.',
        '',
        'topics:',
        *_endpoints(),
    ]
    parser = Parser(
        prog='oracle',
        description='Answer what would happen on the table of a running simulator, and what to do.',
        epilog='\n'.join(epilog),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_simulator(parser)
    parser.add_argument(
        '--threads',
        type=count,
        metavar='N',
        help='play in at most so many threads (default: one for each core)',
    )
    return parser


def _endpoints() -> list[str]:
    try:
        from pool_sim_ros.ros import oracle_interface
    except ImportError:
        return ['  (listed where ROS 2 is installed)']
    return [f'  {topic.private}: {topic.doc}' for topic in oracle_interface.TOPICS]


@ros_command('oracle', _parser)
def main(context: Context, options: argparse.Namespace) -> None:
    """Run the node."""
    from pool_sim_ros.oracle import ClusterError
    from pool_sim_ros.ros import (
        LastingExecutor,
        OracleNode,
        leave_at_once,
        shut_down_on_signals,
    )

    shut_down_on_signals(context)
    node = None
    try:
        node = OracleNode(simulator=options.node, threads=options.threads, context=context)
        executor = LastingExecutor(context)
        executor.add_node(node)
        executor.spin()
    except ClusterError as error:
        raise CommandError(str(error)) from None
    except Exception:
        if context.ok():  # else the shutdown overtook whatever was going on
            raise
    finally:
        idle = node is None or node.stop(SHUTDOWN_PATIENCE)
        if node is not None:
            node.destroy_node()
        context.try_shutdown()
    if not idle:
        leave_at_once(0)


if __name__ == '__main__':
    sys.exit(main())
