"""The command `record_shot`: play one shot on a running simulator and keep its topics in a file."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from pool_sim_ros.cli.shot_arguments import ShotParser
from pool_sim_ros.console import ProgressLine
from pool_sim_ros.ros import (
    INTERRUPTED,
    NAME_ERRORS,
    Recorder,
    ShotClient,
    SimulatorError,
    StartupError,
    init_ros,
    without_ros_args,
)


def main(args: list[str] | None = None) -> int:
    """Record one shot; return the exit status."""
    args = sys.argv[1:] if args is None else args
    try:
        options = _parser().parse_args(without_ros_args(args))
        _check(options.out)
        context = init_ros(args)
        try:
            _record(context, options)
        finally:
            context.try_shutdown()
    except (StartupError, SimulatorError, *NAME_ERRORS) as error:
        print(f'record_shot: {error}', file=sys.stderr)
        return 1
    except OSError as error:
        print(f'record_shot: {options.out} cannot be written: {error.strerror}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print('record_shot: interrupted; nothing was written', file=sys.stderr)
        return INTERRUPTED
    return 0


def _check(out: Path) -> None:
    try:
        import rosbags  # noqa: F401
    except ModuleNotFoundError:
        raise StartupError(
            "recording needs rosbags: pip install 'pool_sim_ros[record]', or pip install rosbags"
        ) from None
    if out.suffix != '.mcap':
        raise StartupError(f'--out: {out} must end in .mcap')
    if not out.parent.is_dir():
        raise StartupError(f'--out: there is no folder {out.parent}')


def _record(context, options: argparse.Namespace) -> None:
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


if __name__ == '__main__':
    sys.exit(main())
