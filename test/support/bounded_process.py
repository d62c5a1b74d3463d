"""Commands of this package within bounds of time and memory, and in an environment of their own."""

import os
import resource
import subprocess
import sys

SECONDS = 100
MEMORY = 4 << 30
"""Bytes of addresses: the libraries alone take more than 1 GB, and hardly use it."""


def run_bounded(module, *args, memory=MEMORY, **environment):
    """Run a module of the package; return its completed process.

    A variable of the environment that is None is taken away.
    """
    env = os.environ | {'PYTHONUNBUFFERED': '1', 'RCUTILS_LOGGING_USE_STDOUT': '0'}
    for name, value in environment.items():
        env.pop(name, None)
        if value is not None:
            env[name] = str(value)
    return subprocess.run(
        [sys.executable, '-m', f'pool_sim_ros.{module}', *map(str, args)],
        capture_output=True,
        stdin=subprocess.DEVNULL,
        text=True,
        timeout=SECONDS,
        env=env,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (memory, memory)),
    )


def assert_one_line(process, statuses, *words):
    """Assert that a command failed with one line on stderr that has all the words."""
    assert process.returncode in statuses, process.stderr
    assert process.stdout == '' and process.stderr.count('\n') == 1, process.stderr
    assert len(process.stderr) < 600
    for word in words:
        assert word in process.stderr
