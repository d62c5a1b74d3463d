"""The common arguments of the commands that play a shot."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from typing import Any

from pool_sim_ros.console import CommandError, Parser, number
from pool_sim_ros.ros import add_simulator, add_timeout

CUE_OPTIONS = ('elevation', 'side', 'above')
"""What may be said of a cue beside its speed and azimuth."""


class ShotParser(Parser):
    """Reads which shot to play on which simulator; a command may add arguments."""

    def __init__(
        self,
        prog: str,
        description: str,
        shot: Callable[[str], Any] = int,
        shots: str = "one of the report's shots, 1 to 4",
    ) -> None:
        super().__init__(
            prog=prog,
            description=description,
            epilog='ROS arguments, like --ros-args -r __ns:=/NS, may follow.',
        )
        self.add_argument('shot', nargs='?', type=shot, help=shots)
        self.add_argument(
            '--velocity',
            nargs=2,
            type=number,
            metavar=('VX', 'VY'),
            help='strike the cue ball where it lies, m/s',
        )
        self.add_argument(
            '--spin',
            nargs=3,
            type=number,
            metavar=('WX', 'WY', 'WZ'),
            help='with --velocity, where balls spin: rad/s, z up',
        )
        self.add_argument(
            '--cue',
            nargs=2,
            type=number,
            metavar=('SPEED', 'AZIMUTH'),
            help='strike with a cue of this speed, m/s, that points to this azimuth, degrees '
            'counterclockwise from +x; where balls spin',
        )
        for name, words in (
            ('side', 'where its tip hits: so many radii to the left as the player sees it'),
            ('above', 'and so many radii above the middle'),
            ('elevation', 'how steep it is, degrees'),
        ):
            self.add_argument(f'--{name}', type=number, metavar='X', help=f'with --cue: {words}')
        add_simulator(self)
        add_timeout(self)

    def parse_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: None = None
    ) -> argparse.Namespace:
        """Parse; end the process unless exactly one of shot, velocity and cue is given."""
        options = super().parse_args(args, namespace)
        self.check(options)
        return options

    def check(self, options: argparse.Namespace) -> None:
        """End the process unless exactly one of shot, velocity and cue is given."""
        given = [
            value for value in (options.shot, options.velocity, options.cue) if value is not None
        ]
        if len(given) != 1:
            self.error(
                'give either the number of a shot or --velocity VX VY, or --cue SPEED AZIMUTH'
            )
        if options.spin is not None and options.velocity is None:
            self.error('--spin goes with --velocity')
        for name in CUE_OPTIONS:
            if getattr(options, name) is not None and options.cue is None:
                self.error(f'--{name} goes with --cue')


def what_to_play(options: argparse.Namespace) -> dict[str, Any]:
    """Return what `ShotClient.play` is asked for."""
    what = {name: getattr(options, name) for name in ('shot', 'velocity', 'spin')}
    if options.cue is not None:
        speed, azimuth = options.cue
        more = {name: getattr(options, name) for name in CUE_OPTIONS}
        what['cue'] = {'speed': speed, 'azimuth': azimuth, **more}
        what['cue'] = {name: value for name, value in what['cue'].items() if value is not None}
    return {name: value for name, value in what.items() if value is not None}


def check_shot(options: argparse.Namespace) -> None:
    """Return if some simulator could play the shot; so nobody waits for one in vain.

    Raises
    ------
    CommandError
        If every simulator would reject it.
    """
    from pool_sim_ros.simulator import Code, Phase, parse_request

    request = parse_request(json.dumps(what_to_play(options)))
    if request.code is not Code.OK:
        raise CommandError(f'{Phase.REJECTED.value} ({request.code.value}): {request.reason}')
