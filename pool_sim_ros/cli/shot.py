"""The command `shot`: play one shot on a running simulator."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from pool_sim_ros.cli.shot_arguments import ShotParser, check_shot
from pool_sim_ros.console import ProgressLine
from pool_sim_ros.ros import ros_command

if TYPE_CHECKING:
    from rclpy.context import Context

    from pool_sim_ros.ros import ShotClient


def _parser() -> ShotParser:
    return ShotParser(
        'shot', 'Play one shot on a running simulator and print where the balls stop.'
    )


@ros_command('shot', _parser, interrupted='shot: interrupted; the shot goes on')
def main(context: Context, options: argparse.Namespace) -> None:
    """Play one shot."""
    from pool_sim_ros.ros import ShotClient

    check_shot(options)
    client = ShotClient(context, options.node)
    try:
        _play(client, options)
    finally:
        client.close()


def _play(client: ShotClient, options: argparse.Namespace) -> None:
    from pool_sim_ros.me212 import format_shot

    line = ProgressLine(sys.stdout)
    client.wait_for_simulator(options.timeout)
    try:
        response = client.play(
            options.shot,
            options.velocity,
            timeout=options.timeout,
            on_accepted=_print_accepted,
            on_progress=line.show if line.wanted else None,
        )
    finally:
        line.clear()
    print(format_shot(response['shot'], response['velocity'], response['final_positions'].items()))


def _print_accepted(response: dict[str, Any]) -> None:
    x, y = response['velocity']
    print(
        f'{response["phase"]}: cue velocity [{x:.3f}, {y:.3f}] m/s, '
        f'integrator {response["integrator"]}',
        flush=True,
    )


if __name__ == '__main__':
    sys.exit(main())
