"""A command of the package in a process that is forked, see `starter`; as `subprocess.Popen` is."""

import contextlib
import functools
import json
import os
import select
import socket
import subprocess
import sys
from pathlib import Path

from starter import NUMBER

STARTER = Path(__file__).with_name('starter.py')
AT_START = ('AMENT_', 'COVERAGE_', 'LD_', 'NUMBA_', 'PYTHON', 'RMW_', 'XDG_')
"""Variables with these beginnings are read while Python or a package is loaded."""


def can_fork(environment):
    """Return whether a process with this environment is as if it had been started anew."""
    measured = 'COVERAGE_PROCESS_CONFIG' in environment
    return os.name == 'posix' and not measured and _at_start(environment) == _starter()[1]


def _at_start(environment):
    return {name: value for name, value in environment.items() if name.startswith(AT_START)}


@functools.cache
def _starter():
    """Return the socket that takes orders, the variables of the starter's beginning, and itself."""
    environment = os.environ | {'PYTHONUNBUFFERED': '1'}
    ours, starter = start_starter(environment)
    return ours, _at_start(environment), starter


def start_starter(environment, *modules):
    """Start a starter, which loads modules; return the socket that takes orders, and itself."""
    ours, its = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with its:
        command = [sys.executable, str(STARTER), str(its.fileno()), *modules]
        # It ends when this process does, which closes the other end of the socket.
        starter = subprocess.Popen(
            command, env=environment, stdin=subprocess.DEVNULL, pass_fds=[its.fileno()]
        )
    return ours, starter


class Forked:
    """A process that a starter has forked, with the attributes of `subprocess.Popen`.

    Parameters
    ----------
    order : dict
        What it is to run: `module` and `arguments`, or `script`.
    stdout : int
        A descriptor, or subprocess.PIPE.
    environment : dict
    folder : path, optional
        Where it runs; without it, here.
    starter : socket, optional
        Takes the order; without it, that of the starter of commands.
    """

    def __init__(self, order, stdout, environment, folder=None, starter=None):
        with contextlib.ExitStack() as stack:
            if stdout == subprocess.PIPE:
                self.stdout, out = self._pipe(stack)
            else:
                self.stdout, out = None, stdout
            self.stderr, err = self._pipe(stack)
            self._told, tell = os.pipe()
            stack.callback(os.close, tell)
            order = {**order, 'folder': str(folder or os.getcwd()), 'environment': environment}
            to = starter or _starter()[0]
            socket.send_fds(to, [json.dumps(order).encode()], [out, err, tell])
        self.pid, self.returncode = self._number(), None

    def _pipe(self, stack):
        reader, writer = os.pipe()
        stack.callback(os.close, writer)
        return os.fdopen(reader), writer

    def _number(self):
        return NUMBER.unpack(os.read(self._told, NUMBER.size))[0]

    def poll(self):
        return self._end(0)

    def wait(self, timeout):
        if self._end(timeout) is None:
            raise subprocess.TimeoutExpired(str(self.pid), timeout)
        return self.returncode

    def _end(self, timeout):
        if self.returncode is None and select.select([self._told], [], [], timeout)[0]:
            self.returncode = self._number()
            os.close(self._told)
        return self.returncode

    def communicate(self, timeout):
        """Return all that it writes, once it has ended; a pipe must hold it."""
        self.wait(timeout)
        with self.stdout as out, self.stderr as err:
            return out.read(), err.read()

    def send_signal(self, number):
        if self.poll() is None:
            os.kill(self.pid, number)

    def terminate(self):
        self.send_signal(15)

    def kill(self):
        self.send_signal(9)
