"""HTTP: the page, and a websocket for each open page."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import ipaddress
import logging
import socket
from collections.abc import Awaitable, Callable
from importlib import resources
from typing import Any
from urllib.parse import urlsplit

from aiohttp import WSCloseCode, WSMsgType, web
from aiohttp.http import HttpProcessingError

from pool_sim_ros.web_view.commands import LONGEST
from pool_sim_ros.web_view.pages import Page
from pool_sim_ros.web_view.view import View

HEARTBEAT = 20.0
"""Seconds between two pings of a page."""

REQUEST_PATIENCE = 10.0
"""Seconds in which a new connection must send a whole request; a page needs less than one."""

IDLE_PATIENCE = 30.0
"""Seconds in which an old one must send the next."""

LINGERING = 5.0
"""Seconds in which the rest of a request may come that was answered before its end."""

HEADERS = {
    'Content-Security-Policy': "default-src 'self'; img-src 'self' data:; object-src 'none'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    'X-Content-Type-Options': 'nosniff',
    'Referrer-Policy': 'no-referrer',
    'Cache-Control': 'no-cache',
}

TYPES = {
    '.css': 'text/css',
    '.html': 'text/html',
    '.js': 'text/javascript',
    '.svg': 'image/svg+xml',
}
"""Ending of a file of the page -> its type."""

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class Server:
    """Serves a view.

    Parameters
    ----------
    view : View
    host : str
        Address to listen at.
    port : int
        0 takes any that is free.
    """

    def __init__(self, view: View, host: str, port: int) -> None:
        self._view = view
        self._host, self._port = host, port
        self._sockets: set[web.WebSocketResponse] = set()
        self._silent: dict[Any, asyncio.TimerHandle] = {}
        application = web.Application(middlewares=[self._guard])
        application.on_shutdown.append(self._close_sockets)
        self._static = resources.files(__package__).joinpath('static')
        application.router.add_get('/', self._file)
        application.router.add_get('/static/{name}', self._file)
        application.router.add_get('/socket', self._socket)
        self._runner = web.AppRunner(
            application,
            access_log=None,
            shutdown_timeout=1.0,
            keepalive_timeout=IDLE_PATIENCE,
            lingering_time=LINGERING,
            logger=_logger(),
        )
        self._listening: asyncio.Server | None = None

    async def start(self) -> str:
        """Start to listen; return the page's address.

        Raises
        ------
        OSError
            If the address is taken, or is not one of this machine.
        """
        await self._runner.setup()
        loop = asyncio.get_running_loop()
        self._listening = await loop.create_server(self._connect, self._host, self._port)
        port = self._listening.sockets[0].getsockname()[1]
        unnamed = is_loopback(self._host) or self._host in ('0.0.0.0', '::')
        name = 'localhost' if unnamed else self._host
        return f'http://{f"[{name}]" if ":" in name else name}:{port}'

    async def stop(self) -> None:
        """Close every page's connection, and stop."""
        if self._listening is not None:
            self._listening.close()
        for timer in self._silent.values():
            timer.cancel()
        await self._runner.cleanup()

    def _connect(self) -> asyncio.Protocol:
        """Return the protocol of a new connection, which ends if it sends no whole request."""
        assert self._runner.server is not None, 'it is set up'
        protocol = self._runner.server()
        loop = asyncio.get_running_loop()
        self._silent[protocol] = loop.call_later(REQUEST_PATIENCE, self._drop, protocol)
        return protocol

    def _drop(self, protocol: Any) -> None:
        del self._silent[protocol]
        protocol.force_close()

    @web.middleware
    async def _guard(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        timer = self._silent.pop(request.protocol, None)
        if timer is not None:
            timer.cancel()
        response: web.StreamResponse
        try:
            if not is_own_name(request.host, self._host):
                raise web.HTTPForbidden(text='the Host is not a name of this server\n')
            response = await handler(request)
        except web.HTTPException as error:
            error.headers.update(HEADERS)
            raise
        if not response.prepared:
            response.headers.update(HEADERS)
        return response

    async def _file(self, request: web.Request) -> web.StreamResponse:
        """Answer with a file of the page; none but these names reaches the file system."""
        name = request.match_info.get('name', 'index.html')
        file = next((file for file in self._static.iterdir() if file.name == name), None)
        ending = '.' + name.rpartition('.')[2]
        if file is None or ending not in TYPES:
            raise web.HTTPNotFound
        return web.Response(body=file.read_bytes(), content_type=TYPES[ending], charset='utf-8')

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        # Browsers let every site open websockets to any server: the server has to refuse.
        if _place(request.headers.get('Origin', '')) != request.host.lower():
            raise web.HTTPForbidden(text='only for the page of this server\n')
        connection = web.WebSocketResponse(heartbeat=HEARTBEAT, max_msg_size=4 * LONGEST)
        try:
            await connection.prepare(request)
        except ValueError:  # a header of the handshake is not ASCII
            raise web.HTTPBadRequest(text='this is no handshake of a websocket\n') from None
        page = self._view.pages.open()
        self._sockets.add(connection)
        sending = asyncio.create_task(_send(connection, page))
        try:
            async for item in connection:
                if item.type is WSMsgType.TEXT:
                    await self._view.obey(page, item.data)
        finally:
            self._view.pages.close(page)
            self._sockets.discard(connection)
            sending.cancel()
            with contextlib.suppress(asyncio.CancelledError, ConnectionError):
                await sending
        return connection

    async def _close_sockets(self, _: web.Application) -> None:
        for connection in list(self._sockets):
            await connection.close(code=WSCloseCode.GOING_AWAY)


def _logger() -> logging.Logger:
    """Return a log without what is the fault of who asks: a flood of nonsense must not fill it."""

    def is_ours(record: logging.LogRecord) -> bool:
        return not (record.exc_info and isinstance(record.exc_info[1], HttpProcessingError))

    logger = logging.getLogger(__name__)
    logger.filters = [is_ours]
    return logger


def is_own_name(name: str, listening: str) -> bool:
    """Return whether the Host of a request can be a name of a server at an address.

    A foreign site can give its own name this machine's address, so that its pages seem to be ours.
    The Host is then that name.

    Parameters
    ----------
    name : str
        The Host, with or without a port.
    listening : str
        The address at which the server listens.
    """
    try:
        parts = urlsplit(f'//{name}')
        host, _ = parts.hostname or '', parts.port
    except ValueError:  # like [ or localhost:x
        return False
    if host == 'localhost' or host == listening:
        return True
    if is_loopback(listening):
        return is_loopback(host)
    return _is_address(host) or host in _names_of_this_machine()


def _place(origin: str) -> str | None:
    """Return host and port of an Origin; None if it is no address."""
    try:
        return urlsplit(origin).netloc.lower()
    except ValueError:
        return None


def is_loopback(host: str) -> bool:
    """Return whether an address or a name is a loopback."""
    return host == 'localhost' or (_is_address(host) and ipaddress.ip_address(host).is_loopback)


@functools.cache
def _names_of_this_machine() -> set[str]:
    return {socket.gethostname().lower(), socket.getfqdn().lower()}  # which may ask the network


def _is_address(host: str) -> bool:
    try:
        ipaddress.ip_address(host)
    except ValueError:
        return False
    return True


async def _send(connection: web.WebSocketResponse, page: Page) -> None:
    with contextlib.suppress(ConnectionError, RuntimeError):
        while not connection.closed:
            item = await page.next()
            if page.lost:
                await connection.close(code=WSCloseCode.TRY_AGAIN_LATER)
            elif isinstance(item, str):
                await connection.send_str(item)
            elif item is not None:
                await connection.send_bytes(item)
