"""`python -m pool_sim_ros.cli.play`: a simulator and its page together, until Ctrl-C."""

from __future__ import annotations

import argparse
import os
import signal
import socket
import subprocess
import sys
import time

from pool_sim_ros.cli.child_process import end, start_module
from pool_sim_ros.cli.open_page import has_window, is_served, open_page
from pool_sim_ros.console import CommandError, Parser, console_command, require
from pool_sim_ros.ros import check_environment

NAP = 0.05
"""Seconds between two checks of whether one of the two has ended."""

HOST = '127.0.0.1'
"""Where the page is served: on this machine only."""


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
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
    parser.add_argument(
        '--no-browser',
        action='store_true',
        help='open no browser; none is opened where there is no display, or with --port 0',
    )
    return parser


@console_command('play')
def main(args: list[str]) -> int:
    """Start both, and wait for a signal; return 1 where one of them ended before."""
    options = _parser().parse_args(args)
    require('rclpy', 'aiohttp')
    check_environment()
    _check_port(options.port)
    # A table of its own, out of the way of any other on this machine or network.
    domain = os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 101))
    reach = os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    # Not as an exception: a second one would interrupt the end of the two.
    signals: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _: signals.append(number))
    print(
        'Its topics, in another terminal: '
        f'export ROS_DOMAIN_ID={domain} ROS_AUTOMATIC_DISCOVERY_RANGE={reach}',
        flush=True,
    )
    processes: list[subprocess.Popen[bytes]] = []
    try:
        processes.append(start_module('cli.sim_node'))
        processes.append(start_module('web_view', '--host', HOST, '--port', str(options.port)))
        opens = bool(options.port) and has_window() and not options.no_browser
        while not signals and all(process.poll() is None for process in processes):
            if opens and is_served(HOST, options.port):
                opens = False
                open_page(options.port)
            time.sleep(NAP)
        return 0 if signals else 1
    finally:
        for process in processes:
            end(process)


def _check_port(port: int) -> None:
    """Return if the page can be served there; otherwise the simulator need not start."""
    try:
        socket.create_server((HOST, port)).close()
    except (OSError, OverflowError) as error:
        known = isinstance(error, OSError) and error.errno
        reason = os.strerror(known) if known else 'a port is 0 to 65535'
        raise CommandError(
            f'the page cannot be served at port {port}: {reason}; '
            'choose another one, as in: make play PORT=8081'
        ) from error


if __name__ == '__main__':
    sys.exit(main())
