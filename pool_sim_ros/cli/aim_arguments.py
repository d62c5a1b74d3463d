"""The arguments of `aim`: what a shot is to do, and how it is sought."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from pool_sim_ros.console import Parser, count, number, positive
from pool_sim_ros.ros import add_simulator, add_timeout

if TYPE_CHECKING:
    from pool_sim_ros.oracle import Noise

WITHIN = 0.1
"""Distance from a point, m, that is near enough unless somebody says so."""

NOISES = ('fastfiz', 'sjtu', 'none')


class AimParser(Parser):
    """Reads what a shot is to do, and how it is sought."""

    def __init__(self) -> None:
        super().__init__(
            prog='aim',
            description='Find the shots on a running simulator that most likely do what is asked, '
            'given how badly somebody shoots and sees; print them, best first.',
            epilog='Several goals must all be met. ROS arguments, like --ros-args -r __ns:=/NS, '
            'may follow.',
        )
        self._add_goals()
        self._add_search()
        self.add_argument('--shoot', action='store_true', help='play the best shot')
        add_simulator(self)
        add_timeout(self)

    def _add_goals(self) -> None:
        add = self.add_argument_group('what the shot is to do').add_argument
        add('--ball', metavar='LABEL', help='the ball that is to go somewhere, with --to or --pot')
        add('--to', nargs=2, type=number, metavar=('X', 'Y'), help='it ends near this point, m')
        add(
            '--pot',
            nargs='?',
            const='any',
            type=_pocket,
            metavar='POCKET',
            help='a pocket catches it: the one of this number, or any',
        )
        add(
            '--cue-to',
            nargs=2,
            type=number,
            metavar=('X', 'Y'),
            help='the cue ball ends near this point, m',
        )
        add(
            '--within',
            type=positive,
            default=WITHIN,
            metavar='M',
            help='how near to a point (default: %(default)g)',
        )
        for name, words in (
            ('first-hit', 'the cue ball touches this ball first'),
            ('touches', 'it touches this ball'),
            ('avoid', 'it never touches this ball'),
            ('keep', 'no pocket catches this ball'),
        ):
            add(f'--{name}', action='append', default=[], metavar='LABEL', help=words)
        add('--goal', type=_json, metavar='JSON', help='a goal as a request for a plan has it')

    def _add_search(self) -> None:
        add = self.add_argument_group('how it is sought').add_argument
        add(
            '--noise',
            choices=NOISES,
            default='fastfiz',
            help='how badly the shot is executed (default: %(default)s)',
        )
        add('--scale', type=positive, default=1.0, metavar='X', help='times so much')
        add(
            '--camera',
            type=positive,
            default=None,
            metavar='M',
            help='how badly the balls are seen: standard deviation of each coordinate',
        )
        add(
            '--shots',
            type=count,
            default=330_000,
            metavar='N',
            help='shots that are played to find it (default: %(default)d)',
        )
        add('--seconds', type=positive, metavar='S', help='end the search after so long')
        add('--seed', type=int, default=0, metavar='N', help='of its luck (default: 0)')
        add('--count', type=count, default=5, metavar='N', help='shots to print (default: 5)')
        add(
            '--offset',
            type=number,
            default=0.0,
            metavar='X',
            help='where balls spin: hit up to so many radii beside the middle (default: 0)',
        )

    def parse_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: None = None
    ) -> argparse.Namespace:
        """Parse; end the process unless there is something to do."""
        options = super().parse_args(args, namespace)
        if (options.ball is None) != (options.to is None and options.pot is None):
            self.error('--ball goes with --to X Y or --pot')
        if not parts_of(options):
            self.error('say what the shot is to do, as in: --ball 9 --to 0.30 0.20')
        return options


def _pocket(text: str) -> int | str:
    if text == 'any':
        return text
    if not (text.isascii() and text.isdigit() and len(text) < 10):
        raise argparse.ArgumentTypeError(f"{text!r} is neither the number of a pocket nor 'any'")
    return int(text)


def _json(text: str) -> dict[str, Any]:
    try:
        fields = json.loads(text)
    except (ValueError, RecursionError):
        fields = None
    if not isinstance(fields, dict):
        raise argparse.ArgumentTypeError(f'{text!r:.60} is no JSON object')
    return fields


def parts_of(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Return the goals that are asked for, each as its fields."""
    parts: list[dict[str, Any]] = []
    if options.to is not None:
        parts.append({'ball': options.ball, 'to': options.to, 'within': options.within})
    if options.pot is not None:
        parts.append({'ball': options.ball, 'pocket': options.pot})
    if options.cue_to is not None:
        parts.append({'cue_to': options.cue_to, 'within': options.within})
    for name in ('first_hit', 'touches', 'avoid', 'keep'):
        parts += ({name: label} for label in getattr(options, name))
    if options.goal is not None:
        parts.append(options.goal)
    return parts


def noise_of(options: argparse.Namespace) -> Noise:
    """Return how badly somebody shoots and sees."""
    from dataclasses import replace

    from pool_sim_ros.oracle import Noise

    noise = Noise() if options.noise == 'none' else Noise.preset(options.noise)
    scaled: Noise = options.scale * noise
    return replace(scaled, camera=options.camera or 0.0)
