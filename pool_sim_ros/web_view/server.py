"""HTTP: the page, and a websocket for each open page."""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import socket
from collections.abc import Awaitable, Callable
from importlib import resources
from urllib.parse import urlsplit

from aiohttp import WSCloseCode, WSMsgType, web

from pool_sim_ros.web_view.commands import LONGEST
from pool_sim_ros.web_view.pages import Page
from pool_sim_ros.web_view.view import View

HEARTBEAT = 20.0
"""Seconds between two pings of a page."""

HEADERS = {
    'Content-Security-Policy': "default-src 'self'; img-src 'self' data:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'",
    'X-Content-Type-Options': 'nosniff',
    'Referrer-Policy': 'no-referrer',
    'Cache-Control': 'no-cache',
}

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
        application = web.Application(middlewares=[self._guard])
        application.on_shutdown.append(self._close_sockets)
        self._static = resources.files(__package__).joinpath('static')
        application.router.add_get('/', self._index)
        application.router.add_get('/socket', self._socket)
        application.router.add_static('/static', str(self._static))
        self._runner = web.AppRunner(application, access_log=None, shutdown_timeout=1.0)

    async def start(self) -> str:
        """Start to listen; return the page's address.

        Raises
        ------
        OSError
            If the address is taken, or is not one of this machine.
        """
        await self._runner.setup()
        await web.TCPSite(self._runner, self._host, self._port).start()
        port = self._runner.addresses[0][1]
        unnamed = is_loopback(self._host) or self._host in ('0.0.0.0', '::')
        name = 'localhost' if unnamed else self._host
        return f'http://{f"[{name}]" if ":" in name else name}:{port}'

    async def stop(self) -> None:
        """Close every page's connection, and stop."""
        await self._runner.cleanup()

    @web.middleware
    async def _guard(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        if not is_own_name(request.host, self._host):
            raise web.HTTPForbidden(text=f'{request.host} is not a name of this server\n')
        response = await handler(request)
        if not response.prepared:
            response.headers.update(HEADERS)
        return response

    async def _index(self, _: web.Request) -> web.StreamResponse:
        page = self._static.joinpath('index.html').read_text(encoding='utf-8')
        return web.Response(text=page, content_type='text/html')

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        # Browsers let every site open websockets to any server: the server has to refuse.
        if urlsplit(request.headers.get('Origin', '')).netloc.lower() != request.host.lower():
            raise web.HTTPForbidden(text='only for the page of this server\n')
        connection = web.WebSocketResponse(heartbeat=HEARTBEAT, max_msg_size=4 * LONGEST)
        await connection.prepare(request)
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
    host = urlsplit(f'//{name}').hostname or ''
    if host == 'localhost' or host == listening:
        return True
    if is_loopback(listening):
        return is_loopback(host)
    return _is_address(host) or host in (socket.gethostname().lower(), socket.getfqdn().lower())


def is_loopback(host: str) -> bool:
    """Return whether an address or a name is a loopback."""
    return host == 'localhost' or (_is_address(host) and ipaddress.ip_address(host).is_loopback)


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
