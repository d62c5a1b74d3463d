"""The command `record_shot`: play one shot on a running simulator and keep its topics in a file."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from rclpy.context import Context

from pool_sim_ros.cli.shot_arguments import ShotParser
from pool_sim_ros.console import CommandError, ProgressLine
from pool_sim_ros.ros import Recorder, ShotClient, SimulatorError, ros_command


def _parser() -> ShotParser:
    parser = ShotParser(
        'record_shot',
        'Play one shot on a running simulator and write its topics to an MCAP file, which Foxglove '
        'and "ros2 bag play" open.',
    )
    parser.add_argument(
        '--out',
        type=Path,
        default=Path('shot.mcap'),
        metavar='FILE.mcap',
        help='file to write; one that is there is replaced (default: %(default)s)',
    )
    return parser


@ros_command(
    'record_shot',
    _parser,
    SimulatorError,
    interrupted='record_shot: interrupted; nothing was written',
)
def main(context: Context, options: argparse.Namespace) -> None:
    """Record one shot."""
    _check(options.out)
    try:
        _record(context, options)
    except OSError as error:
        raise CommandError(f'{options.out} cannot be written: {error.strerror}') from error


def _check(out: Path) -> None:
    try:
        import rosbags  # noqa: F401
    except ModuleNotFoundError:
        raise CommandError(
            "recording needs rosbags: pip install 'pool_sim_ros[record]', or pip install rosbags"
        ) from None
    if out.suffix != '.mcap':
        raise CommandError(f'--out: {out} must end in .mcap')
    if not out.parent.is_dir():
        raise CommandError(f'--out: there is no folder {out.parent}')


def _record(context: Context, options: argparse.Namespace) -> None:
    from pool_sim_ros.ros import write_bag

    line = ProgressLine(sys.stdout)
    client = ShotClient(context, options.node)
    try:
        client.wait_for_simulator(options.timeout)
        recorder = Recorder(context, options.node)
        try:
            recorder.wait_for_topics(options.timeout)
            response = client.play(
                options.shot,
                options.velocity,
                timeout=options.timeout,
                on_progress=line.show if line.wanted else None,
            )
            recorder.wait_for_end(response, options.timeout)
        finally:
            recorder.close()
    finally:
        line.clear()
        client.close()
    write_bag(options.out, recorder.messages)
    seconds = response['t_end'] - response['t_start']
    print(f'{options.out}: {len(recorder.messages)} messages, a shot of {seconds:.2f} s')


if __name__ == '__main__':
    sys.exit(main())
