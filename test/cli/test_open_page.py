"""`make play` opens the page where there is a browser with a window."""

import socket
import sys

import pytest
from waiting import wait_until

pytest.importorskip('aiohttp', reason='pip install aiohttp')

from process_harness import Process  # noqa: E402

from pool_sim_ros.cli.open_page import has_window, is_served, open_page  # noqa: E402


@pytest.fixture
def free_port():
    with socket.create_server(('127.0.0.1', 0)) as server:
        return server.getsockname()[1]


@pytest.fixture
def browser(tmp_path):
    """A browser that writes down what it is asked to open."""
    seen = tmp_path / 'seen'
    script = tmp_path / 'browser'
    script.write_text(f'#!/bin/sh\necho "$1" >> {seen}\n')
    script.chmod(0o755)
    return f'{script} %s', seen


@pytest.mark.skipif(sys.platform == 'darwin', reason='it always has windows')
@pytest.mark.parametrize(
    ('environment', 'has'),
    [
        ({}, False),
        ({'DISPLAY': ''}, False),
        ({'DISPLAY': ':0'}, True),
        ({'WAYLAND_DISPLAY': 'wayland-0'}, True),
        ({'BROWSER': 'lynx'}, False),
    ],
)
def test_a_window_needs_a_display(environment, has):
    assert has_window(environment) == has


def test_a_port_is_served_while_somebody_listens(free_port):
    assert not is_served('127.0.0.1', free_port)
    with socket.create_server(('127.0.0.1', free_port)):
        assert is_served('127.0.0.1', free_port)


def test_play_opens_the_page_once_it_is_there(domain, free_port, browser):
    command, seen = browser
    shown = {'BROWSER': command, 'DISPLAY': ':99'}
    with Process('cli.play', '--port', str(free_port), env=shown) as both:
        wait_until(seen.exists, 'the browser')
        wait_until(lambda: seen.read_text().endswith('\n'), 'the address')
        assert both.stdout.count('shows') == 1 and 'Traceback' not in both.stderr
    assert seen.read_text() == f'http://localhost:{free_port}\n'


def test_where_no_browser_starts_nothing_happens(monkeypatch, capfd):
    monkeypatch.setattr('webbrowser._tryorder', [])
    monkeypatch.setattr('webbrowser._browsers', {})
    open_page(8080)
    assert capfd.readouterr().err == ''
