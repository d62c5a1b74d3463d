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
    ours, its = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    environment = os.environ | {'PYTHONUNBUFFERED': '1'}
    with its:
        command = [sys.executable, str(STARTER), str(its.fileno())]
        # It ends when this process does, which closes the other end of the socket.
        starter = subprocess.Popen(
            command, env=environment, stdin=subprocess.DEVNULL, pass_fds=[its.fileno()]
        )
    return ours, _at_start(environment), starter


class Forked:
    """A process of a module of the package, with the attributes of `subprocess.Popen`.

    Parameters
    ----------
    module : str
    arguments : sequence of str
    stdout : int
        A descriptor, or subprocess.PIPE.
    environment : dict
    """

    def __init__(self, module, arguments, stdout, environment):
        with contextlib.ExitStack() as stack:
            if stdout == subprocess.PIPE:
                self.stdout, out = self._pipe(stack)
            else:
                self.stdout, out = None, stdout
            self.stderr, err = self._pipe(stack)
            self._told, tell = os.pipe()
            stack.callback(os.close, tell)
            order = {
                'module': module,
                'arguments': list(map(str, arguments)),
                'folder': os.getcwd(),
                'environment': environment,
            }
            socket.send_fds(_starter()[0], [json.dumps(order).encode()], [out, err, tell])
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

    def send_signal(self, number):
        if self.poll() is None:
            os.kill(self.pid, number)

    def terminate(self):
        self.send_signal(15)

    def kill(self):
        self.send_signal(9)
