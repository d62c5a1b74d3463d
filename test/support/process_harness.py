"""Commands of this package as child processes; nothing here sleeps blindly."""

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

from forked import Forked, can_fork
from waiting import PATIENCE, wait_until


class Process:
    """A command of this package as a child process; what it writes is read as it comes."""

    _running = []

    @classmethod
    def check_all(cls):
        """Fail where a process that is still needed has ended."""
        for process in cls._running:
            status = process._popen.poll()
            assert status is None, f'ended with status {status}:\n{process.stderr}'

    def __init__(
        self, module, *args, stdout=subprocess.PIPE, prefix=(), env=None, folder=None, anew=False
    ):
        """Start a module of the package, or a file; through the command `prefix`, if any.

        `anew` is as a user starts it; else it is forked, see `starter`, where that is the same.
        """
        environment = _environment(module) | (env or {})
        if anew or prefix or isinstance(module, Path) or not can_fork(environment):
            self._popen = _start_anew(module, args, stdout, prefix, environment, folder)
        else:
            order = {'module': f'pool_sim_ros.{module}', 'arguments': list(map(str, args))}
            self._popen = Forked(order, stdout, environment, folder)
        self._texts = {'stdout': [], 'stderr': []}
        self._readers = [
            threading.Thread(target=self._read, args=(name,), daemon=True)
            for name in self._texts
            if getattr(self._popen, name) is not None
        ]
        for reader in self._readers:
            reader.start()
        self._running.append(self)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._popen.poll() is None:
            self._popen.terminate()
        try:
            self.wait()
        except subprocess.TimeoutExpired:
            self._popen.kill()
            raise

    def _read(self, name):
        for line in getattr(self._popen, name):
            self._texts[name].append(line)

    @property
    def pid(self):
        return self._popen.pid

    @property
    def stdout(self):
        return ''.join(self._texts['stdout'])

    @property
    def stderr(self):
        return ''.join(self._texts['stderr'])

    def signal(self, number):
        self._forget()
        self._popen.send_signal(number)

    def interrupt(self):
        self.signal(signal.SIGINT)

    def wait(self):
        """Wait for the end of the process and return its exit status."""
        self._forget()
        status = self._popen.wait(PATIENCE)
        for reader in self._readers:
            reader.join(PATIENCE)
        return status

    def wait_for(self, text):
        """Wait until the process has written this."""

        def written():
            return text in self.stdout or text in self.stderr

        wait_until(lambda: written() or self._popen.poll() is not None, f'{text!r}')
        assert written(), f'ended without {text!r}:\n{self.stderr}'
        return self

    def _forget(self):
        if self in self._running:
            self._running.remove(self)


def _start_anew(module, args, stdout, prefix, environment, folder):
    command = [module] if isinstance(module, Path) else ['-m', f'pool_sim_ros.{module}']
    return subprocess.Popen(
        [*prefix, sys.executable, *command, *args],
        stdout=stdout,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        text=True,
        env=environment,
        cwd=folder,
    )


def start_node(*args, module='cli.sim_node', anew=False, **parameters):
    """Start sim_node as a process of its own."""
    settings = [word for name, value in parameters.items() for word in ('-p', f'{name}:={value}')]
    return Process(module, *args, '--ros-args', *settings, anew=anew)


def node_process(*args, **parameters):
    """Start sim_node as a process of its own, and wait until it is ready.

    Only then should clients be made: two that start together take seconds to find each other.
    """
    process = start_node(*args, **parameters)
    try:
        return process.wait_for('ready')
    except BaseException:
        process.signal(signal.SIGKILL)
        raise


def _environment(module):
    """Return the environment of a child; coverage would measure it, a node that runs fast apart."""
    env = os.environ | {'PYTHONUNBUFFERED': '1', 'RCUTILS_LOGGING_USE_STDOUT': '0'}
    if module == 'cli.sim_node':  # traced, it cannot keep up; nodes in this process are measured
        env.pop('COVERAGE_PROCESS_CONFIG', None)
    return env
