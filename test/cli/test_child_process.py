"""Modules as processes of their own."""

import signal
import subprocess
import sys

from pool_sim_ros.cli import child_process
from pool_sim_ros.cli.child_process import end, start_module


def test_a_module_is_started_with_its_arguments_and_writes_where_it_is_told_to(tmp_path):
    with (tmp_path / 'log').open('w+b') as log:
        assert start_module('cli.demo', '--help', output=log).wait(60) == 0
        assert start_module('cli.demo', '--fast', output=log).wait(60) == 2
        log.seek(0)
        text = log.read().decode()
    assert '--speed' in text and 'unrecognized arguments: --fast' in text


def test_one_that_does_not_want_to_end_is_killed(monkeypatch):
    code = (
        'import signal, sys\n'
        'signal.signal(signal.SIGTERM, signal.SIG_IGN)\n'
        'print("deaf", flush=True)\n'
        'sys.stdin.read()'
    )
    monkeypatch.setattr(child_process, 'PATIENCE', 0.1)
    process = subprocess.Popen(
        [sys.executable, '-c', code], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    with process:
        assert process.stdout.readline() == b'deaf\n'
        end(process)
        assert process.returncode == -signal.SIGKILL


def test_one_that_has_ended_is_no_trouble(tmp_path):
    with (tmp_path / 'log').open('w+b') as log:
        process = start_module('cli.demo', '--help', output=log)
        process.wait(60)
        end(process)
    assert process.returncode == 0
