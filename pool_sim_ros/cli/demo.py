"""`python -m pool_sim_ros.cli.demo`: play the report's four shots and compare with its print."""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO, TYPE_CHECKING

from pool_sim_ros.cli.child_process import end, start_module
from pool_sim_ros.console import (
    CommandError,
    Parser,
    ProgressLine,
    console_command,
    require,
    speed,
)
from pool_sim_ros.ros import check_environment

if TYPE_CHECKING:
    from pool_sim_ros.ros import ShotClient

PATIENCE = 300.0
"""Seconds without a sign of the node after which to give up; the slowest machine compiles the
physics in less."""

NODE = f'pool_demo_{os.getpid()}'
"""A name of its own, out of the way of any other simulator."""


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog='python -m pool_sim_ros.cli.demo',
        description="Start the node, play the report's four shots over its topics, and compare "
        'where the balls stop with what the report printed.',
    )
    parser.add_argument(
        '--speed',
        type=speed,
        default=1.0,
        metavar='FACTOR',
        help='how many times faster than real time; 0 = as fast as possible (default: %(default)g)',
    )
    return parser


@console_command('demo', interrupted='\ndemo: interrupted')
def main(args: list[str]) -> int:
    """Play the four shots; return 0 where all positions equal the printed ones."""
    options = _parser().parse_args(args)
    require('rclpy')
    check_environment()
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    # Like Ctrl-C, so that the node does not outlive the demo.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with tempfile.TemporaryFile() as log:
        try:
            with _simulator(options.speed, log) as process:
                return _play_all(process, options.speed)
        except CommandError as error:
            said = _text(log).strip()
            raise CommandError(f'{error}\n{said}' if said else str(error)) from error


@contextmanager
def _simulator(speed: float, log: IO[bytes]) -> Iterator[subprocess.Popen[bytes]]:
    arguments = ['--ros-args', '-r', f'__node:={NODE}', '-p', f'real_time_factor:={speed}']
    process = start_module('cli.sim_node', *arguments, output=log)
    try:
        print('Starting the node; on the first run it compiles the physics, for about 20 s ...')
        _wait_until_ready(process, log)
        yield process
    finally:
        end(process)


def _wait_until_ready(process: subprocess.Popen[bytes], log: IO[bytes]) -> None:
    # A client waits until it is ready: two that start together take seconds to find each other.
    end = time.monotonic() + PATIENCE
    while 'ready' not in _text(log):
        if process.poll() is not None:
            raise CommandError('the node has ended')
        if time.monotonic() > end:
            raise CommandError(f'the node was not ready after {PATIENCE:g} s')
        time.sleep(0.02)


def _text(log: IO[bytes]) -> str:
    # Read past the file's own position, which belongs to the process that writes it.
    return os.pread(log.fileno(), 1 << 20, 0).decode(errors='replace')


def _play_all(process: subprocess.Popen[bytes], speed: float) -> int:
    from pool_sim_ros.me212 import (
        attitude_to_nearest,
        format_aim,
        nearest_ball,
        published_final_positions,
    )
    from pool_sim_ros.ros import ShotClient, init_ros
    from pool_sim_ros.simulator import table_from_json

    context = init_ros([])
    client = ShotClient(context, NODE, has_ended=lambda: process.poll() is not None)
    line = ProgressLine(sys.stdout)
    try:
        client.wait_for_simulator(PATIENCE)
        pace = f'at {speed:g} x real speed' if speed else 'as fast as possible'
        print(f"Playing the report's four shots over the topics of {client.simulator}, {pace}.")
        print('Beside each position: whether it equals the one that the report printed.\n')
        table = table_from_json(client.table_json(PATIENCE))
        print(format_aim(table.labels[nearest_ball(table)], attitude_to_nearest(table)))
        published = published_final_positions()
        equal = sum(_play(client, line, shot, printed) for shot, printed in published.items())
    finally:
        line.clear()
        client.close()
        context.try_shutdown()
    total = sum(len(printed) for printed in published.values())
    print(f'{equal} of {total} positions equal the print.')
    return 0 if equal == total else 1


def _play(
    client: ShotClient, line: ProgressLine, shot: int, printed: dict[str, tuple[float, float]]
) -> int:
    """Play one shot and print its part of the log; return how many positions equal the print."""
    from pool_sim_ros.me212 import format_position, format_shot_head

    def show(words: str) -> None:
        line.show(f'Simulation {shot}: {words}')

    response = client.play(shot, timeout=PATIENCE, on_progress=show if line.wanted else None)
    line.clear()
    print(format_shot_head(shot, response['velocity']), end='')
    equal = 0
    for label, position in response['final_positions'].items():
        same = tuple(response['final_positions_in'][label]) == printed[label]
        equal += same
        x, y = printed[label]
        mark = 'as printed' if same else f'NOT as printed: [{x:5.2f}, {y:5.2f}]'
        print(f'{format_position(label, position)}   {mark}')
    print(flush=True)
    return equal


if __name__ == '__main__':
    sys.exit(main())
