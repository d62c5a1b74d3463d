"""The command `shot`: play one shot on a running simulator, or do something else to its table."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from pool_sim_ros.cli.shot_arguments import ShotParser, check_shot, what_to_play
from pool_sim_ros.console import ProgressLine, number
from pool_sim_ros.ros import ros_command

if TYPE_CHECKING:
    from rclpy.context import Context

    from pool_sim_ros.ros import ShotClient

ACTIONS = ('reset', 'pause', 'resume', 'step', 'place')
"""What the command does beside playing shots."""


class _Parser(ShotParser):
    """Reads a shot, or one of the actions."""

    def __init__(self) -> None:
        super().__init__(
            'shot',
            'Play one shot on a running simulator and print where the balls stop; or reset, pause, '
            'resume or step its table, or place balls on it.',
            _what,
            f"one of the report's shots, 1 to 4; or {', '.join(ACTIONS)}",
        )
        self.usage = (
            'shot [options] 1|2|3|4\n'
            '       shot [options] --velocity VX VY [--spin WX WY WZ]\n'
            '       shot [options] --cue SPEED AZIMUTH [--side X] [--above X] [--elevation X]\n'
            '       shot [options] reset | pause | resume | step\n'
            '       shot [options] place LABEL X Y [LABEL X Y ...]'
        )
        self.add_argument(
            'places',
            nargs='*',
            metavar='LABEL X Y',
            help='with place: where to put a ball, m; several balls may follow one another',
        )

    def parse_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: None = None
    ) -> argparse.Namespace:
        """Parse; end the process unless one thing is asked for."""
        options: argparse.Namespace = self.parse_intermixed_args(args, namespace)
        if options.shot not in ACTIONS:
            if options.places:
                self.error(f'{options.places[0]!r} is too much; only place takes LABEL X Y')
            self.check(options)
            return options
        for name in ('velocity', 'spin', 'cue', 'side', 'above', 'elevation'):
            if getattr(options, name) is not None:
                self.error(f'--{name} does not go with {options.shot}')
        if options.shot == 'place':
            options.places = self._places(options.places)
        elif options.places:
            self.error(f'{options.places[0]!r} is too much after {options.shot}')
        return options

    def _places(self, words: list[str]) -> dict[str, tuple[float, float]]:
        if not words or len(words) % 3:
            self.error('place needs LABEL X Y for each ball, as in: place 9 0.5 0.4')
        places = {}
        for label, *place in zip(words[::3], words[1::3], words[2::3], strict=True):
            if label in places:
                self.error(f'place: ball {label!r} is given twice')
            try:
                x, y = map(number, place)
            except argparse.ArgumentTypeError as error:
                self.error(f'place {label}: {error}')
            places[label] = x, y
        return places


def _what(text: str) -> int | str:
    if text in ACTIONS:
        return text
    try:
        return int(text)
    except ValueError:
        known = f'a shot, 1 to 4, nor {", ".join(ACTIONS[:-1])} or {ACTIONS[-1]}'
        raise argparse.ArgumentTypeError(f'{text!r} is neither {known}') from None


@ros_command('shot', _Parser, interrupted='shot: interrupted; the shot goes on')
def main(context: Context, options: argparse.Namespace) -> None:
    """Play one shot, or carry out an action."""
    from pool_sim_ros.ros import ShotClient

    acts = options.shot in ACTIONS
    if not acts:
        check_shot(options)
    client = ShotClient(context, options.node)
    try:
        client.wait_for_simulator(options.timeout)
        if acts:
            print(_act(client, options))
        else:
            _play(client, options)
    finally:
        client.close()


def _act(client: ShotClient, options: argparse.Namespace) -> str:
    """Carry out an action; return what came of it, in words."""
    from pool_sim_ros.ros import interface

    if options.shot == 'place':
        places = client.place(options.places, timeout=options.timeout)['place']
        return ', '.join(f'ball {label} at [{x:g}, {y:g}] m' for label, (x, y) in places.items())
    if options.shot in ('pause', 'resume'):
        paused = options.shot == 'pause'
        return client.call(interface.SET_PAUSED, timeout=options.timeout, data=paused)
    service = {'reset': interface.RESET, 'step': interface.STEP}[options.shot]
    return client.call(service, timeout=options.timeout)


def _play(client: ShotClient, options: argparse.Namespace) -> None:
    from pool_sim_ros.me212 import format_shot

    line = ProgressLine(sys.stdout)
    try:
        response = client.play(
            **what_to_play(options),
            timeout=options.timeout,
            on_accepted=_print_accepted,
            on_progress=line.show if line.wanted else None,
        )
    finally:
        line.clear()
    print(format_shot(response['shot'], response['velocity'], response['final_positions'].items()))
    if response['pocketed']:
        balls = (f'{label} in {pocket}' for label, pocket in response['pocketed'].items())
        print(f'    In pockets: {", ".join(balls)}')


def _print_accepted(response: dict[str, Any]) -> None:
    x, y = response['velocity']
    spin = ''
    if response['spin'] is not None:
        spin = f'spin [{", ".join(f"{w:.2f}" for w in response["spin"])}] rad/s, '
    print(
        f'{response["phase"]}: cue velocity [{x:.3f}, {y:.3f}] m/s, {spin}'
        f'integrator {response["integrator"]}',
        flush=True,
    )


if __name__ == '__main__':
    sys.exit(main())
