"""The command `replay`: show a recorded session again, on the topics it was recorded from."""

from __future__ import annotations

import argparse
import sys
import time
from typing import TYPE_CHECKING, Any

from pool_sim_ros.console import CommandError, Parser, path, speed
from pool_sim_ros.ros import ros_command

if TYPE_CHECKING:
    from rclpy.context import Context

    from pool_sim_ros.simulator import Settings

NAP = 0.05
"""Longest time between two checks of whether to go on, s."""

DELIVERY_PATIENCE = 5.0
"""Seconds to wait until the last frames have reached their readers."""


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog='replay',
        description='Show a session again that sim_node recorded (its parameter record): the same '
        'bytes on ball_poses, ball_velocities and collisions.',
        epilog='ROS arguments, like --ros-args -r __ns:=/NS, may follow.',
    )
    parser.add_argument('file', type=path, metavar='FILE', help='the log that sim_node wrote')
    parser.add_argument(
        '--speed',
        type=speed,
        default=1.0,
        metavar='FACTOR',
        help='sim seconds per second; 0 = as fast as possible (default: %(default)g)',
    )
    parser.add_argument(
        '--wait',
        action='store_true',
        help='begin once somebody reads ball_poses, ball_velocities and collisions',
    )
    parser.add_argument(
        '--digest',
        action='store_true',
        help='show nothing, but print the SHA-256 of what would be sent on each topic',
    )
    return parser


def _note(line: str) -> None:
    print(f'replay: {line}', file=sys.stderr)


@ros_command('replay', _parser)
def main(context: Context, options: argparse.Namespace) -> None:
    """Replay a session, or print the digests of what it sends."""
    from pool_sim_ros.ros import digests, shut_down_on_signals
    from pool_sim_ros.simulator import LogError, read_log, replay_frames

    try:
        settings, commands = read_log(options.file, _note)
        if options.digest:
            for topic, digest in digests(settings, replay_frames(settings, commands)).items():
                print(f'{digest}  {topic}')
            return
        shut_down_on_signals(context)
        _play(context, settings, commands, options)
    except LogError as error:
        raise CommandError(str(error)) from error


def _play(
    context: Context,
    settings: Settings,
    commands: list[dict[str, Any]],
    options: argparse.Namespace,
) -> None:
    from rclpy.duration import Duration
    from rclpy.node import Node

    from pool_sim_ros.ros import NODE_NAME, Publishers
    from pool_sim_ros.simulator import Pacer, replay_frames

    node = Node(NODE_NAME, context=context, start_parameter_services=False)
    try:
        output = Publishers(node, settings)
        output.table(settings)
        while options.wait and context.ok() and not output.is_read():
            time.sleep(NAP)
        pacer = Pacer(settings.publish_rate, options.speed)
        for frame in replay_frames(settings, commands):
            while context.ok() and (wait := pacer.wait(moving=True)) > 0.0:
                time.sleep(min(wait, NAP))
            if not context.ok():
                return
            output.frame(frame)
            pacer.shown()
        output.wait_for_delivery(Duration(seconds=DELIVERY_PATIENCE))
    except Exception:
        if context.ok():  # else a signal overtook whatever was going on
            raise
    finally:
        node.destroy_node()


if __name__ == '__main__':
    sys.exit(main())
