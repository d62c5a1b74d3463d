"""`python -m pool_sim_ros.cli.play`: a simulator and its page together, until Ctrl-C."""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import time

NAP = 0.05
"""Seconds between two looks at whether one of the two has ended."""

PATIENCE = 5.0
"""Seconds that they are given to end."""


def main(args: list[str] | None = None) -> int:
    """Start both and wait; return the exit status."""
    options = _parser().parse_args(args)
    # A table of its own, out of the way of any other on this machine or network.
    domain = os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 101))
    reach = os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    # Not as an exception: a second one would come in the midst of ending the two.
    signals: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _: signals.append(number))
    print(
        'Its topics, in another terminal: '
        f'export ROS_DOMAIN_ID={domain} ROS_AUTOMATIC_DISCOVERY_RANGE={reach}',
        flush=True,
    )
    processes: list[subprocess.Popen] = []
    try:
        for module in (['ros.sim_node'], ['web_view', '--port', str(options.port)]):
            processes.append(
                subprocess.Popen([sys.executable, '-m', f'pool_sim_ros.{module[0]}', *module[1:]])
            )
        while not signals and all(process.poll() is None for process in processes):
            time.sleep(NAP)
        return 0 if signals else 1
    finally:
        for process in processes:
            _end(process)


def _end(process: subprocess.Popen) -> None:
    process.terminate()
    try:
        process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='python -m pool_sim_ros.cli.play',
        description='Start a simulator and a page in the browser to play on it; Ctrl-C ends both.',
    )
    parser.add_argument(
        '--port',
        type=int,
        default=8080,
        metavar='N',
        help='port of the page; 0 takes any that is free (default: %(default)s)',
    )
    return parser


if __name__ == '__main__':
    sys.exit(main())
