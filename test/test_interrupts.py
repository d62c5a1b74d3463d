"""Ctrl-C while a command still imports what it needs."""

import os
import signal
import subprocess
import sys

import pytest

ROOMS = ('cli', 'report', 'web_view')

INTERRUPTED = """
import signal, sys
import pool_sim_ros.{room}

class Finder:
    def find_spec(self, name, path=None, target=None):
        signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Finder())
import colorsys  # something that takes long to import
print('imported')
"""


@pytest.mark.parametrize('room', ROOMS)
def test_an_interrupted_import_prints_nothing_and_ends_the_process(room):
    ended = subprocess.run(
        [sys.executable, '-c', INTERRUPTED.format(room=room)],
        capture_output=True,
        text=True,
        timeout=60,
        env=os.environ,
    )
    assert (ended.stdout, ended.stderr) == ('', '')
    assert ended.returncode == -signal.SIGINT


def test_what_else_nobody_catches_is_printed():
    code = 'import pool_sim_ros.cli; raise ZeroDivisionError'
    ended = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, timeout=60)
    assert ended.returncode == 1 and ended.stderr.endswith('\nZeroDivisionError\n')
