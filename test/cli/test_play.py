"""`make play`: simulator and page together."""

import asyncio
import re
import signal
import socket
import subprocess
from pathlib import Path

import pytest

pytest.importorskip('aiohttp', reason='pip install aiohttp')

from process_harness import Process  # noqa: E402
from site_harness import talk  # noqa: E402

from pool_sim_ros.cli import play  # noqa: E402
from pool_sim_ros.cli.child_process import start_module  # noqa: E402

PROJECT = Path(__file__).parents[2]


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_it_prints_the_address_of_a_page_that_plays_and_ends_both(domain, number):
    with Process('cli.play', '--port', '0') as both:
        both.wait_for('shows')
        address = re.search(r'http://\S+', both.stdout)[0]

        async def play():
            async with talk(address) as page:
                await page.hear('state')
                await page.hear('frame')
                await page.say(do='shot', number=3)
                await page.hear('response', lambda response: response['phase'] == 'accepted')
                both.signal(number)
                both.signal(number)  # as an impatient user does
                await page.closed()

        asyncio.run(play())
        assert both.wait() == 0
        assert f'ROS_DOMAIN_ID={domain}' in both.stdout and 'Traceback' not in both.stderr


def test_where_one_cannot_start_the_other_ends_too(domain):
    with Process('cli.play', '--port', '99999') as both:
        assert both.wait() == 1
        assert '99999' in both.stderr


def test_a_port_that_is_taken_is_one_line_and_nothing_starts(domain):
    with socket.create_server(('127.0.0.1', 0)) as taken:
        port = str(taken.getsockname()[1])
        with Process('cli.play', '--port', port) as both:
            assert both.wait() == 1
            assert both.stdout == ''
            assert both.stderr.startswith(f'play: the page cannot be served at port {port}: ')
            assert 'make play PORT=' in both.stderr and both.stderr.count('\n') == 1


def test_where_one_ends_the_other_ends_too(domain, monkeypatch, capfd):
    started = []

    def start(module, *args, **options):
        # The page ends at once: its host is no address of this machine.
        args = [arg.replace(play.HOST, '192.0.2.1') for arg in args]
        started.append(start_module(module, *args, **options))
        return started[-1]

    monkeypatch.setattr(play, 'start_module', start)
    monkeypatch.setattr(play.signal, 'signal', lambda *_: None)  # this process keeps its own
    assert play.main(['--port', '0']) == 1
    assert [process.poll() is not None for process in started] == [True, True]
    err = capfd.readouterr().err
    assert 'cannot listen at 192.0.2.1' in err and 'Traceback' not in err


def test_make_hands_the_port_on():
    dry = ['make', '--dry-run', '--always-make', 'play']
    for words, wanted in ((['PORT=8081'], "--port '8081'"), ([], 'cli.play')):
        done = subprocess.run(
            [*dry, *words], cwd=PROJECT, capture_output=True, text=True, timeout=60, check=True
        )
        line = next(line for line in done.stdout.splitlines() if 'cli.play' in line)
        assert line.strip().endswith(wanted)
