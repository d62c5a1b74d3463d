"""Opens the page in a browser, where there is one that has a window."""

from __future__ import annotations

import os
import socket
import sys
import webbrowser

PATIENCE = 0.2
"""Seconds to wait for a connection: the server is on this machine."""


def has_window(environment: dict[str, str] | None = None) -> bool:
    """Return whether a browser can have a window here; one in the terminal would be in the way."""
    known = os.environ if environment is None else environment
    return sys.platform == 'darwin' or bool(known.get('DISPLAY') or known.get('WAYLAND_DISPLAY'))


def is_served(host: str, port: int) -> bool:
    """Return whether somebody listens at a port."""
    try:
        socket.create_connection((host, port), PATIENCE).close()
    except OSError:
        return False
    return True


def open_page(port: int) -> None:
    """Open the page that this machine serves at a port, if a browser starts."""
    try:
        webbrowser.open(f'http://localhost:{port}')
    except (OSError, webbrowser.Error):
        return
