"""The server as a process, and a page's side of its websocket."""

import asyncio
import contextlib
import json
import re

import aiohttp
import numpy as np
from process_harness import Process, node_process
from waiting import PATIENCE


@contextlib.contextmanager
def web_view(*args):
    """Start the server at a free port; yield its process, with `address`."""
    port = [] if '--port' in args else ['--port', '0']
    with Process('web_view', *port, *args) as process:
        process.wait_for('shows')
        process.address = re.search(r'http://\S+', process.stdout)[0]
        yield process


def simulator(*args, **parameters):
    """Start sim_node, and return it once it is ready."""
    return node_process(*args, **parameters).wait_for('ready')


class Talk:
    """What a page hears from the server, and says to it."""

    def __init__(self, socket):
        self._socket = socket
        self.heard = []

    async def say(self, **fields):
        await self._socket.send_json(fields)

    async def say_text(self, text):
        await self._socket.send_str(text)

    async def hear(self, kind, condition=lambda content: True):
        """Wait for something of a kind from now on, and return its content."""

        async def listen():
            async for item in self._socket:
                if item.type is aiohttp.WSMsgType.BINARY:
                    heard = 'frame', np.frombuffer(item.data, '<f8')
                else:
                    fields = json.loads(item.data)
                    heard = fields['kind'], fields['content']
                self.heard.append(heard)
                if heard[0] == kind and condition(heard[1]):
                    return heard[1]
            raise AssertionError(f'closed with {self._socket.close_code} instead of {kind}')

        return await asyncio.wait_for(listen(), PATIENCE)

    async def closed(self):
        """Wait for the end, and return its code."""
        with contextlib.suppress(AssertionError):
            await self.hear('nothing of this kind')
        return self._socket.close_code


@contextlib.asynccontextmanager
async def talk(address, **headers):
    """Open a page's websocket."""
    headers = {'Origin': address} | headers
    async with (
        aiohttp.ClientSession() as session,
        session.ws_connect(f'{address}/socket', headers=headers) as socket,
    ):
        yield Talk(socket)
