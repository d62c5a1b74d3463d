"""The command `shot`: play one shot on a running simulator."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from rclpy.context import Context

from pool_sim_ros.cli.shot_arguments import ShotParser
from pool_sim_ros.console import ProgressLine
from pool_sim_ros.me212 import format_shot
from pool_sim_ros.ros import ShotClient, SimulatorError, ros_command


def _parser() -> ShotParser:
    return ShotParser(
        'shot', 'Play one shot on a running simulator and print where the balls stop.'
    )


@ros_command('shot', _parser, SimulatorError, interrupted='shot: interrupted; the shot goes on')
def main(context: Context, options: argparse.Namespace) -> None:
    """Play one shot."""
    client = ShotClient(context, options.node)
    try:
        _play(client, options)
    finally:
        client.close()


def _play(client: ShotClient, options: argparse.Namespace) -> None:
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
