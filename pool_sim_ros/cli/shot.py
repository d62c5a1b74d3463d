"""The command `shot`: play one shot on a running simulator."""

from __future__ import annotations

import argparse
import sys

from pool_sim_ros.cli.shot_arguments import ShotParser
from pool_sim_ros.console import ProgressLine
from pool_sim_ros.me212 import format_shot
from pool_sim_ros.ros import (
    INTERRUPTED,
    NAME_ERRORS,
    ShotClient,
    SimulatorError,
    StartupError,
    init_ros,
    without_ros_args,
)


def main(args: list[str] | None = None) -> int:
    """Play one shot; return the exit status."""
    args = sys.argv[1:] if args is None else args
    try:
        parser = ShotParser(
            'shot', 'Play one shot on a running simulator and print where the balls stop.'
        )
        options = parser.parse_args(without_ros_args(args))
        context = init_ros(args)
        try:
            client = ShotClient(context, options.node)
            try:
                _play(client, options)
            finally:
                client.close()
        finally:
            context.try_shutdown()
    except (StartupError, SimulatorError, *NAME_ERRORS) as error:
        print(f'shot: {error}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print('shot: interrupted; the shot goes on', file=sys.stderr)
        return INTERRUPTED
    return 0


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


def _print_accepted(response: dict) -> None:
    x, y = response['velocity']
    print(
        f'{response["phase"]}: cue velocity [{x:.3f}, {y:.3f}] m/s, '
        f'integrator {response["integrator"]}',
        flush=True,
    )


if __name__ == '__main__':
    sys.exit(main())
