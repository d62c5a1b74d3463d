"""The common arguments of the commands that play a shot."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence

from pool_sim_ros.console import CommandError, Parser, number, positive
from pool_sim_ros.ros import NODE_NAME, node_name


class ShotParser(Parser):
    """Reads which shot to play on which simulator; a command may add arguments."""

    def __init__(self, prog: str, description: str) -> None:
        super().__init__(
            prog=prog,
            description=description,
            epilog='ROS arguments, like --ros-args -r __ns:=/NS, may follow.',
        )
        self.add_argument('shot', nargs='?', type=int, help="one of the report's shots, 1 to 4")
        self.add_argument(
            '--velocity',
            nargs=2,
            type=number,
            metavar=('VX', 'VY'),
            help='strike the cue ball where it lies, m/s',
        )
        self.add_argument(
            '--node',
            type=node_name,
            default=NODE_NAME,
            metavar='NAME',
            help='name of the simulator (default: %(default)s)',
        )
        self.add_argument(
            '--timeout',
            type=positive,
            default=10.0,
            metavar='S',
            help='give up after so many seconds without a sign of it (default: %(default)g)',
        )

    def parse_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: None = None
    ) -> argparse.Namespace:
        """Parse; end the process unless exactly one of shot and velocity is given."""
        options = super().parse_args(args, namespace)
        if (options.shot is None) == (options.velocity is None):
            self.error('give either the number of a shot or --velocity VX VY')
        return options


def check_shot(options: argparse.Namespace) -> None:
    """Return if some simulator could play the shot; so nobody waits for one in vain.

    Raises
    ------
    CommandError
        If every simulator would reject it.
    """
    from pool_sim_ros.simulator import Code, Phase, parse_request

    asked = {'shot': options.shot, 'velocity': options.velocity}
    fields = {name: value for name, value in asked.items() if value is not None}
    request = parse_request(json.dumps(fields))
    if request.code is not Code.OK:
        raise CommandError(f'{Phase.REJECTED.value} ({request.code.value}): {request.reason}')
