"""A scheduler of Dask and its workers, each a process of its own, as on a cluster."""

import json
import os
import subprocess
import sys
from contextlib import ExitStack, contextmanager

import distributed  # noqa: F401, what is started
from waiting import wait_until


@contextmanager
def _process(module, *args):
    process = subprocess.Popen(
        [sys.executable, '-m', f'distributed.cli.{module}', *args],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        stdin=subprocess.DEVNULL,
    )
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@contextmanager
def dask_processes(folder, workers):
    """Start them; give the address and the processes, the scheduler's first."""
    file = folder / 'scheduler.json'
    with ExitStack() as stack:
        where = ('--scheduler-file', str(file))
        scheduler = _process(
            'dask_scheduler', '--host', '127.0.0.1', '--port', '0', '--no-dashboard', *where
        )
        processes = [stack.enter_context(scheduler)]
        wait_until(lambda: file.exists() and file.read_text().endswith('}'), 'the scheduler')
        quiet = ('--nthreads', '1', '--no-nanny', '--no-dashboard')
        quiet += ('--local-directory', os.fspath(folder))
        for _ in range(workers):
            processes.append(stack.enter_context(_process('dask_worker', *where, *quiet)))
        yield json.loads(file.read_text())['address'], processes
