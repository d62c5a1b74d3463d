"""The command `sim_node`: run the node until SIGINT or SIGTERM."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from pool_sim_ros.console import CommandError, Parser
from pool_sim_ros.ros import ros_command

if TYPE_CHECKING:
    from rclpy.context import Context

    from pool_sim_ros.simulator import ParameterSpec

SHUTDOWN_PATIENCE = 0.1
"""Seconds to wait for the end of a shot's computation before the process ends."""


def _parser() -> argparse.ArgumentParser:
    from pool_sim_ros.simulator import PARAMETERS

    epilog = [
        'ROS arguments: --ros-args --params-file FILE -p NAME:=VALUE -r __node:=NAME -r __ns:=/NS',
        '',
        'topics and services:',
        *_endpoints(),
        '',
        'parameters:',
        *(
            f'  {spec.name}: {spec.doc}{_choices(spec)} ({spec.when})'
            for spec in PARAMETERS.values()
        ),
    ]
    return Parser(
        prog='sim_node',
        description='A pool table on ROS topics. Without parameters: the table of the report.',
        epilog='\n'.join(epilog),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def _choices(spec: ParameterSpec) -> str:
    return f': {", ".join(spec.choices)}' if spec.choices else ''


def _endpoints() -> list[str]:
    try:
        from pool_sim_ros.ros import interface
    except ImportError:
        return ['  (listed where ROS 2 is installed)']
    endpoints = [item for item in vars(interface).values() if isinstance(item, interface.Endpoint)]
    return [f'  {endpoint.private}: {endpoint.doc}' for endpoint in endpoints]


@ros_command('sim_node', _parser)
def main(context: Context, _: argparse.Namespace) -> int:
    """Run the node; return 1 if one of its threads failed."""
    from pool_sim_ros.ros import (
        LastingExecutor,
        SimNode,
        leave_at_once,
        shut_down_on_signals,
    )
    from pool_sim_ros.simulator import ParameterError

    shut_down_on_signals(context)
    node = None
    try:
        node = SimNode(context=context)
        executor = LastingExecutor(context)
        executor.add_node(node)
        executor.spin()
    except ParameterError as error:
        raise CommandError(str(error)) from error
    except Exception:
        if context.ok():  # else the shutdown overtook whatever was going on
            raise
    finally:
        idle = node is None or node.runner.stop(SHUTDOWN_PATIENCE)
        if node is not None:
            node.destroy_node()
        context.try_shutdown()
    status = int(node is not None and node.failed)
    if not idle:
        leave_at_once(status)
    return status


if __name__ == '__main__':
    sys.exit(main())
