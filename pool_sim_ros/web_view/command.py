"""The command `web_view`: serve the page until Ctrl-C."""

from __future__ import annotations

import argparse
import asyncio
import signal
import sys
from typing import TYPE_CHECKING

from pool_sim_ros.console import CommandError, Parser, port, require
from pool_sim_ros.ros import add_simulator, ros_command

if TYPE_CHECKING:
    from rclpy.context import Context

HOST, PORT = '127.0.0.1', 8080


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog='web_view',
        description='Serve a page that shows a running simulator and lets you play on it.',
        epilog='ROS arguments, like --ros-args -r __ns:=/NS, may follow.',
    )
    parser.add_argument(
        '--host',
        type=_host,
        default=HOST,
        metavar='ADDRESS',
        help='address to listen at; 0.0.0.0 lets everybody on the network watch and play '
        '(default: %(default)s, this machine only)',
    )
    parser.add_argument(
        '--port',
        type=port,
        default=PORT,
        metavar='N',
        help='port to listen at; 0 takes any that is free (default: %(default)s)',
    )
    add_simulator(parser)
    return parser


def _host(text: str) -> str:
    if not text:  # which would open the page to the network
        raise argparse.ArgumentTypeError('the address is empty')
    return text


@ros_command('web_view', _parser, interrupt_status=0)
def main(context: Context, options: argparse.Namespace) -> None:
    """Serve the page until SIGINT or SIGTERM."""
    require('aiohttp')
    asyncio.run(_serve(context, options))


async def _serve(context: Context, options: argparse.Namespace) -> None:
    from pool_sim_ros.web_view.server import Server
    from pool_sim_ros.web_view.view import View

    ended = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, ended.set)
    view = View(context, options.node)
    try:
        server = Server(view, options.host, options.port)
        try:
            try:
                address = await server.start()
            except (OSError, UnicodeError) as error:
                reason = error.strerror if isinstance(error, OSError) else 'this is no address'
                raise CommandError(
                    f'cannot listen at {options.host}, port {options.port}: {reason}; '
                    'choose others with --host and --port'
                ) from error
            print(f'{address} shows {view.simulator}; Ctrl-C ends this', flush=True)
            await ended.wait()
        finally:
            await server.stop()
    finally:
        view.close()


if __name__ == '__main__':
    sys.exit(main())
