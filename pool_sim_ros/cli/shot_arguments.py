"""The common arguments of the commands that play a shot."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from pool_sim_ros.ros import interface


class ShotParser(argparse.ArgumentParser):
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
            type=float,
            metavar=('VX', 'VY'),
            help='strike the cue ball where it lies, m/s',
        )
        self.add_argument(
            '--node',
            default=interface.NODE_NAME,
            metavar='NAME',
            help='name of the simulator (default: %(default)s)',
        )
        self.add_argument(
            '--timeout',
            type=float,
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
