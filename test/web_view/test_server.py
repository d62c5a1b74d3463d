"""The server, over HTTP and websockets, and the command that starts it."""

import asyncio
import contextlib
import os
import re
import socket
import struct
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest

aiohttp = pytest.importorskip('aiohttp', reason='pip install aiohttp')

from plain_messages import to_collisions, to_poses  # noqa: E402
from site_harness import simulator, talk, web_view  # noqa: E402
from thinned import every  # noqa: E402
from waiting import PATIENCE, wait_until  # noqa: E402
from yarl import URL  # noqa: E402

from pool_sim_ros.physics import report_table, simulate  # noqa: E402
from pool_sim_ros.ros import interface, messages  # noqa: E402
from pool_sim_ros.web_view import server as module  # noqa: E402
from pool_sim_ros.web_view.pages import Pages  # noqa: E402
from pool_sim_ros.web_view.server import is_own_name  # noqa: E402

TABLE = report_table()


@pytest.fixture(scope='module')
def alone(domain):
    """A server without a simulator."""
    with web_view('--node', '/nobody') as site:
        yield site


@pytest.fixture(scope='module')
def played(domain):
    """A server that has found its simulator."""
    named = ['--ros-args', '-r', '__node:=shown']
    with simulator(*named), web_view('--node', 'shown') as site:

        async def wait_for_simulator():
            async with talk(site.address) as page:
                await page.hear('state')

        asyncio.run(wait_for_simulator())
        yield site


def get(address, path, **headers):
    async def fetch():
        async with aiohttp.ClientSession() as session:
            # As it stands: a client tidies up paths like /a/../b itself.
            url = URL(address + path, encoded=True)
            async with session.get(url, headers=headers) as response:
                return response.status, response.headers, await response.text()

    return asyncio.run(fetch())


@pytest.mark.parametrize(
    ('path', 'type_'),
    [
        ('/', 'text/html'),
        ('/static/main.js', 'javascript'),
        ('/static/style.css', 'text/css'),
        ('/static/icon.svg', 'image/svg'),
    ],
)
def test_the_page_is_served_and_may_load_nothing_from_elsewhere(alone, path, type_):
    status, headers, text = get(alone.address, path)
    assert status == 200 and text
    assert type_ in headers['Content-Type']
    assert "default-src 'self'" in headers['Content-Security-Policy']


@pytest.mark.parametrize(
    'path',
    [
        '/nothing',
        '/static/../server.py',
        '/static/%2e%2e/server.py',
        '/static//etc/passwd',
        '/static/',
    ],
)
def test_nothing_else_is_served(alone, path):
    assert get(alone.address, path)[0] in (403, 404)


@pytest.mark.parametrize('origin', ['http://example.com', 'null', '', 'http://localhost:1'])
def test_pages_of_other_sites_are_refused(alone, origin):
    async def attempt():
        async with talk(alone.address, Origin=origin):
            pass

    with pytest.raises(aiohttp.WSServerHandshakeError) as error:
        asyncio.run(attempt())
    assert error.value.status == 403


def test_a_foreign_name_for_this_machine_is_refused(alone):
    port = alone.address.rsplit(':', 1)[1]
    assert get(alone.address, '/', Host=f'example.com:{port}')[0] == 403
    assert get(alone.address, '/', Host=f'127.0.0.1:{port}')[0] == 200


@pytest.mark.parametrize(
    ('name', 'listening', 'own'),
    [
        ('localhost:8080', '127.0.0.1', True),
        ('127.0.0.1', '127.0.0.1', True),
        ('[::1]:8080', '127.0.0.1', True),
        ('192.168.0.7', '127.0.0.1', False),
        ('example.com', '127.0.0.1', False),
        ('localhost.example.com', '127.0.0.1', False),
        ('', '127.0.0.1', False),
        ('192.168.0.7:8080', '0.0.0.0', True),
        (socket.gethostname(), '0.0.0.0', True),
        ('example.com', '0.0.0.0', False),
        ('[fe80::1]:80', '::', True),
    ],
)
def test_names_of_this_server(name, listening, own):
    assert is_own_name(name, listening) is own


def test_without_a_simulator_it_says_so_in_words(alone):
    async def attempt():
        async with talk(alone.address) as page:
            told = await page.hear('simulator')
            await page.say(do='shot', number=1)
            return told, await page.hear('problem')

    told, answer = asyncio.run(attempt())
    assert told['name'] == '/nobody'
    assert 'ros2 run pool_sim_ros sim_node' in told['problem']
    assert 'No simulator answers as /nobody' in answer


def test_what_a_page_says_is_checked_and_the_rest_goes_on(played):
    async def attempt():
        async with talk(played.address) as page, talk(played.address) as other:
            await page.hear('frame')
            await page.say_text('{"do": "strike", "velocity": [1, NaN]}')
            assert 'velocity' in await page.hear('problem')
            await page.say(do='strike', velocity=[99.0, 0.0])
            response = await page.hear('response')
            assert (response['phase'], response['code']) == ('rejected', 'TOO_FAST')
            await page.say(do='speed', factor=1e300)
            assert 'real_time_factor' in await page.hear('problem')
            await page.say(do='step')
            assert 'paused' in await page.hear('problem')
            await page.say_text('x' * 100_000)
            assert await page.closed() == aiohttp.WSCloseCode.MESSAGE_TOO_BIG
            await other.hear('frame')

    asyncio.run(attempt())


def test_two_pages_see_a_shot_and_its_prediction_comes_true(played):
    velocity = (-2.4, 0.3)

    async def attempt():
        async with talk(played.address) as page, talk(played.address) as other:
            await page.hear('predicts')
            await page.say(do='reset')
            await page.hear('frame', lambda frame: np.array_equal(frame[1:], TABLE.positions.flat))
            await page.say(do='aim', velocity=velocity)
            prediction = await page.hear('prediction')
            await page.say(do='strike', velocity=velocity)
            done = await page.hear('result')
            assert await other.hear('result') == done
            await other.hear('frame', lambda frame: frame[0] > done['t_end'])
            collisions = [row for kind, rows in other.heard if kind == 'collisions' for row in rows]
            return prediction, done, collisions, other.heard[-1][1][1:].reshape(-1, 2)

    prediction, done, collisions, rest = asyncio.run(attempt())
    shot = simulate(TABLE, velocity)
    assert np.array_equal(rest, shot.final_positions)
    assert len(collisions) == np.count_nonzero(shot.events['kind'] < 2)
    ends = {int(row[0]): prediction['ends'][int(row[0])] for row in prediction['segments']}
    assert prediction['velocity'] == list(velocity) and 0 in ends
    for ball, end in ends.items():
        assert end == list(done['final_positions'][TABLE.labels[ball]])
    assert done['printed'] is None


def test_pause_step_and_speed(played):
    async def attempt():
        async with talk(played.address) as page:
            await page.say(do='pause', paused=True)
            paused = await page.hear('state', lambda state: state['paused'])
            await page.say(do='step')
            frame = await page.hear('frame', lambda frame: frame[0] > paused['sim_time'] + 0.001)
            assert frame[0] == pytest.approx(paused['sim_time'] + 1 / 60, abs=1e-6)
            await page.say(do='speed', factor=2.0)
            await page.hear('state', lambda state: state['real_time_factor'] == 2.0)
            await page.say(do='speed', factor=1.0)
            await page.say(do='pause', paused=False)
            await page.hear('state', lambda state: not state['paused'])

    asyncio.run(attempt())


def test_a_report_shot_comes_with_what_was_printed_also_for_a_late_page(played):
    async def attempt():
        async with talk(played.address) as page:
            await page.hear('state', lambda state: not state['moving'])
            await page.say(do='shot', number=4)
            done = await page.hear('result', lambda result: result['shot'] == 4)
        async with talk(played.address) as late:
            assert await late.hear('result') == done
        return done

    done = asyncio.run(attempt())
    assert done['printed'] == done['final_positions_in'] and len(done['printed']) == 11


def test_topics_that_make_no_sense_are_left_out(played, ros):
    node = ros.node()
    nonsense = [
        (interface.STATE, messages.to_string('{')),
        (interface.TABLE, messages.to_string('{"length": 1}')),
        (interface.SHOT_RESPONSE, messages.to_string('3')),
        (interface.COLLISIONS, to_collisions(np.full((1, 10), np.nan))),
        (interface.BALL_POSES, to_poses('table', 1, np.zeros((3, 2)), [0.05] * 3)),
    ]
    publishers = [
        node.create_publisher(topic.type, topic.of('/shown'), topic.qos) for topic, _ in nonsense
    ]
    ros.spin_until(lambda: all(p.get_subscription_count() for p in publishers), 'the web view')
    for publisher, (_, message) in zip(publishers, nonsense, strict=True):
        publisher.publish(message)
    played.wait_for('left out')

    async def attempt():
        async with talk(played.address) as page:
            await page.hear('frame', lambda frame: len(frame) == 23)
            return [content for kind, content in page.heard if kind == 'table']

    (table,) = asyncio.run(attempt())
    assert [ball['label'] for ball in table['balls']] == list(TABLE.labels)


def test_the_names_in_the_page_are_those_of_its_elements(alone):
    _, _, html = get(alone.address, '/')
    for script in ('main', 'panel'):
        _, _, source = get(alone.address, f'/static/{script}.js')
        names = re.findall(r"(?:\$|say)\('([\w-]+)'", source)
        assert names
        for name in names:
            assert f'id="{name}"' in html, f'{script}.js looks for {name}'


def ask(address, request, whole=True):
    """Send bytes as they are; return the status of the answer, and all of it or its beginning."""
    host, port = urlsplit(address).hostname, urlsplit(address).port
    with socket.create_connection((host, port), timeout=PATIENCE) as connection:
        connection.sendall(request)
        answer = b''
        while (whole or not answer) and (chunk := connection.recv(65536)):
            answer += chunk
    return int(answer.split(b' ', 2)[1]), answer


def request(path=b'/', host=b'localhost', method=b'GET', more=b''):
    return b'%s %s HTTP/1.1\r\nHost: %s\r\nConnection: close\r\n%s\r\n' % (method, path, host, more)


HOSTS = [
    *[b'[', b']', b'[::1', b'::1]', b'[]', b'[localhost]', b'localhost:x', b'@', b'a@b:c', b'\xff'],
    *[
        b'\xe2\x84\x80',
        b'localhost\xff',
        b'',
        b' ',
        b'a' * 6000,
        b'[' * 100,
        b'example.com',
        b'%00',
    ],
]


@pytest.mark.parametrize('host', HOSTS, ids=lambda host: repr(host[:30]))
def test_a_host_that_is_none_of_ours_is_the_fault_of_who_asks(alone, host):
    status, answer = ask(alone.address, request(host=host))
    assert 400 <= status < 500, answer


PATHS = [
    *[
        b'/' + b'a' * 6000,
        b'/static/' + b'a' * 6000,
        b'/static/' + b'a/' * 3000,
        b'/' + b'%61' * 2000,
    ],
    *[
        b'/static/main.js%00',
        b'/static/%00',
        b'/%ff',
        b'/static/%ff',
        b'/static/%2e%2e%2fserver.py',
    ],
    *[
        b'/static/..%5cserver.py',
        b'/static/.',
        b'/static/..',
        b'//[',
        b'/static/main.js/x',
        b'/\xff',
    ],
    *[b'/static/CON', b'/static/%e2%84%80', b'*', b'http://[/', b'http://[::1', b'/' + b'?' * 6000],
]


@pytest.mark.parametrize('path', PATHS, ids=lambda path: repr(path[:30]))
def test_no_path_is_an_error_of_the_server(alone, path):
    status, answer = ask(alone.address, request(path))
    assert 400 <= status < 500 or path.startswith(b'/?'), answer


HEADERS = [
    b'Origin: http://[\r\n',
    b'Origin: \xff\r\n',
    b'Origin: http://localhost:99999\r\n',
    b'Upgrade: websocket\r\n',
    b'Sec-WebSocket-Version: x\r\n',
    b'Content-Length: -1\r\n',
    b'Content-Length: 10\r\n',
    b'Transfer-Encoding: chunked\r\n',
    b'Range: bytes=9-1\r\n',
    b'If-Modified-Since: never\r\n',
    b'Cookie: ' + b'a' * 9000 + b'\r\n',
]


@pytest.mark.parametrize(
    ('path', 'more'), every(2, [b'/', b'/socket'], HEADERS), ids=lambda given: repr(given[:30])
)
def test_no_header_is_an_error_of_the_server(alone, path, more):
    # A body that is announced and does not come is waited for, once the answer is sent.
    whole = more not in (b'Content-Length: 10\r\n', b'Transfer-Encoding: chunked\r\n')
    status, answer = ask(alone.address, request(path, more=more), whole)
    assert 200 <= status < 500, answer


HANDSHAKE = {
    b'Connection': b'Upgrade',
    b'Upgrade': b'websocket',
    b'Sec-WebSocket-Version': b'13',
    b'Sec-WebSocket-Key': b'dGhlIHNhbXBsZSBub25jZQ==',
    b'Sec-WebSocket-Protocol': b'chat',
    b'Sec-WebSocket-Extensions': b'permessage-deflate',
}


@pytest.mark.parametrize('header', HANDSHAKE, ids=lambda header: header.decode())
@pytest.mark.parametrize('value', [b'\xff', b'', b'[', b'\xc3\xa4', b'x' * 3000])
def test_no_handshake_is_an_error_of_the_server(alone, header, value):
    place = alone.address.removeprefix('http://').encode()
    lines = {b'Host': place, b'Origin': b'http://' + place, **HANDSHAKE, header: value}
    head = b''.join(b'%s: %s\r\n' % line for line in lines.items())
    status, answer = ask(alone.address, b'GET /socket HTTP/1.1\r\n' + head + b'\r\n', whole=False)
    assert status == 101 or 400 <= status < 500, answer


def test_nonsense_does_not_fill_the_log(domain):
    with web_view('--node', '/nobody') as site:
        for nonsense in (b'\xff\xff\r\n\r\n', b'GET / HTTP/9\r\n\r\n', request(host=b'[')):
            assert 400 <= ask(site.address, nonsense)[0] < 500
        site.interrupt()
        assert site.wait() == 0
        assert site.stderr == ''


@pytest.mark.parametrize('method', [b'POST', b'PUT', b'DELETE', b'OPTIONS', b'TRACE', b'NONSENSE'])
def test_the_page_can_only_be_read(alone, method):
    assert ask(alone.address, request(method=method))[0] in (400, 405)


@pytest.mark.parametrize('path', ['/', '/nothing', '/static/main.js', '/static/nothing'])
def test_every_answer_has_the_policy(alone, path):
    _, headers, _ = get(alone.address, path)
    policy = headers['Content-Security-Policy']
    assert "default-src 'self'" in policy and 'unsafe' not in policy
    assert "object-src 'none'" in policy and headers['X-Content-Type-Options'] == 'nosniff'


class Bare:
    """A view for servers that nobody plays on."""

    def __init__(self):
        self.pages = Pages()


HALVES = {
    'nothing': b'',
    'half a line': b'GET / HT',
    'half a head': b'GET / HTTP/1.1\r\nHost: localhost\r\n',
    'half a second request': request().replace(b'close', b'keep-alive') + b'GET / HT',
    'half a body': request(method=b'POST', more=b'Content-Length: 9\r\n') + b'1234',
}


@pytest.mark.parametrize('half', HALVES.values(), ids=HALVES)
def test_half_a_request_is_not_waited_for_for_ever(monkeypatch, half):
    for name in ('REQUEST_PATIENCE', 'IDLE_PATIENCE', 'LINGERING'):
        monkeypatch.setattr(module, name, 0.3)

    async def attempt():
        server = module.Server(Bare(), '127.0.0.1', 0)
        address = urlsplit(await server.start())
        descriptors = len(os.listdir('/proc/self/fd'))
        try:
            for _ in range(5):
                reader, writer = await asyncio.open_connection('127.0.0.1', address.port)
                writer.write(half)
                await asyncio.wait_for(reader.read(), PATIENCE)  # to its end
                writer.close()
                with contextlib.suppress(ConnectionError):
                    await writer.wait_closed()
            while len(os.listdir('/proc/self/fd')) > descriptors:
                await asyncio.sleep(0.01)
        finally:
            await server.stop()

    asyncio.run(asyncio.wait_for(attempt(), PATIENCE))


def test_a_whole_request_and_an_open_page_are_not_cut_off(monkeypatch):
    monkeypatch.setattr(module, 'REQUEST_PATIENCE', 0.1)
    monkeypatch.setattr(module, 'IDLE_PATIENCE', 0.1)

    async def attempt():
        view = Bare()
        server = module.Server(view, '127.0.0.1', 0)
        address = await server.start()
        try:
            async with talk(address) as page:
                await asyncio.sleep(0.5)  # five times its patience
                view.pages.tell('state', 'still here')
                assert await page.hear('state') == 'still here'
        finally:
            await server.stop()

    asyncio.run(asyncio.wait_for(attempt(), PATIENCE))


def test_connections_that_break_leave_no_descriptor(alone):
    descriptors = Path(f'/proc/{alone.pid}/fd')
    ask(alone.address, request())
    before = len(list(descriptors.iterdir()))
    host, port = urlsplit(alone.address).hostname, urlsplit(alone.address).port
    for index in range(200):
        with socket.create_connection((host, port)) as connection:
            connection.sendall([b'', b'GET / HT', request(), request(b'/socket')][index % 4])
            # With a reset instead of an orderly end.
            linger = struct.pack('ii', 1, 0)
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
    wait_until(lambda: len(list(descriptors.iterdir())) <= before + 2, 'the descriptors')
