"""The server, over HTTP and websockets, and the command that starts it."""

import asyncio
import re
import socket

import numpy as np
import pytest

aiohttp = pytest.importorskip('aiohttp', reason="pip install 'pool_sim_ros[web]'")

from plain_messages import to_collisions, to_poses  # noqa: E402
from site_harness import simulator, talk, web_view  # noqa: E402
from yarl import URL  # noqa: E402

from pool_sim_ros.physics import report_table, simulate  # noqa: E402
from pool_sim_ros.ros import interface, messages  # noqa: E402
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
    ends = {path['ball']: path['points'][-1] for path in prediction['paths']}
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
