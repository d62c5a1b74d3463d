"""The command `record_shot`: play one shot on a running simulator and keep its topics in a file."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from pool_sim_ros.cli.shot_arguments import ShotParser, check_shot, what_to_play
from pool_sim_ros.console import CommandError, ProgressLine, path, require
from pool_sim_ros.ros import ros_command

if TYPE_CHECKING:
    from rclpy.context import Context


def _parser() -> ShotParser:
    parser = ShotParser(
        'record_shot',
        'Play one shot on a running simulator and write its topics, stamped with sim time, to an '
        'MCAP file, which Foxglove and "ros2 bag play" open.',
    )
    parser.add_argument(
        '--out',
        type=path,
        default=Path('shot.mcap'),
        metavar='FILE.mcap',
        help='file to write (default: %(default)s)',
    )
    parser.add_argument('--force', action='store_true', help='replace the file if it is there')
    return parser


@ros_command('record_shot', _parser, interrupted='record_shot: interrupted; nothing was written')
def main(context: Context, options: argparse.Namespace) -> None:
    """Record one shot."""
    require('rosbags')
    _check(options.out, options.force)
    check_shot(options)
    try:
        _record(context, options)
    except FileExistsError as error:
        raise CommandError(_exists(options.out)) from error
    except OSError as error:
        raise CommandError(f'{options.out} cannot be written: {error.strerror}') from error


def _check(out: Path, force: bool) -> None:
    if out.suffix != '.mcap':
        raise CommandError(f'--out: {out} must end in .mcap')
    if not out.parent.is_dir():
        raise CommandError(f'--out: there is no folder {out.parent}')
    if not os.access(out.parent, os.W_OK | os.X_OK):
        raise CommandError(f'--out: nothing can be written to the folder {out.parent}')
    if out.is_dir():
        raise CommandError(f'--out: {out} is a folder')
    if out.exists() and not force:
        raise CommandError(_exists(out))


def _exists(out: Path) -> str:
    return f'--out: {out} is there already; choose another name, or replace it with --force'


def _record(context: Context, options: argparse.Namespace) -> None:
    from pool_sim_ros.ros import Recorder, ShotClient, write_bag

    line = ProgressLine(sys.stdout)
    client = ShotClient(context, options.node)
    try:
        client.wait_for_simulator(options.timeout)
        recorder = Recorder(context, options.node)
        try:
            recorder.wait_for_topics(options.timeout)
            response = client.play(
                **what_to_play(options),
                timeout=options.timeout,
                on_progress=line.show if line.wanted else None,
            )
            recorder.wait_for_end(response, options.timeout)
        finally:
            recorder.close()
    finally:
        line.clear()
        client.close()
    messages = recorder.messages
    write_bag(options.out, messages, replace=options.force)
    seconds = response['t_end'] - response['t_start']
    print(f'{options.out}: {len(messages)} messages, a shot of {seconds:.2f} s')


if __name__ == '__main__':
    sys.exit(main())
