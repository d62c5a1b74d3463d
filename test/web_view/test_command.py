"""The command `web_view`: how it starts, fails and stops."""

import asyncio
import signal
import socket

import pytest

aiohttp = pytest.importorskip('aiohttp', reason='pip install aiohttp')

from process_harness import Process  # noqa: E402
from site_harness import talk, web_view  # noqa: E402


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_it_ends_when_told_to_also_with_a_page_open(domain, number):
    with web_view('--node', '/nobody') as site:

        async def attempt():
            async with talk(site.address) as page:
                await page.hear('simulator')
                site.signal(number)
                return await page.closed()

        assert asyncio.run(attempt()) == aiohttp.WSCloseCode.GOING_AWAY
        assert site.wait() == 0 and site.stderr == ''


def test_a_port_that_is_taken_is_one_clear_line_and_status_1(domain):
    with socket.create_server(('127.0.0.1', 0)) as taken:
        port = str(taken.getsockname()[1])
        with Process('web_view', '--port', port) as process:
            assert process.wait() == 1
            assert port in process.stderr and process.stderr.count('\n') == 1


@pytest.mark.parametrize(
    'args',
    [
        *[['--port', 'x'], ['--port', '70000'], ['--port', '-1'], ['--port', ''], ['more']],
        *[['--node', ''], ['--node', 'a b'], ['--node', '/'], ['--host', '']],
    ],
)
def test_wrong_arguments_are_told_with_status_2(domain, args):
    with Process('web_view', *args) as process:
        assert process.wait() == 2
        assert 'Traceback' not in process.stderr


def test_help_names_every_option(domain):
    with Process('web_view', '--help') as process:
        assert process.wait() == 0
        assert all(option in process.stdout for option in ('--host', '--port', '--node'))


@pytest.mark.parametrize(
    'host',
    [
        '192.0.2.1',
        'no.such.host.invalid',
        'ä' * 80,
        *(pytest.param(host, marks=pytest.mark.soak) for host in ('a b', '[', '1.2.3')),
    ],
)
def test_a_host_that_is_none_is_one_clear_line_and_status_1(domain, host):
    with Process('web_view', '--port', '0', '--host', host) as process:
        assert process.wait() == 1
        assert f'cannot listen at {host}' in process.stderr and process.stderr.count('\n') == 1
