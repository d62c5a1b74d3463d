"""Starts commands of the package by forking a process that has loaded ROS and the physics before.

To load them takes a second or two of processor time, for each command anew. What is forked is a
process of its own in every other respect: environment, folder, descriptors, signals and end.

    python starter.py DESCRIPTOR [MODULE ...]

reads orders from a socket: JSON, with the descriptors for standard output, standard error and what
is told of the process: its id, then its exit status. It loads other modules where they are named.
"""

import contextlib
import gc
import importlib
import io
import json
import os
import runpy
import signal
import socket
import struct
import sys
import types

LOADED = (
    'aiohttp.web',
    'matplotlib.backends.backend_agg',
    'pool_sim_ros.cli.shot_arguments',
    'pool_sim_ros.ros.client',
    'pool_sim_ros.ros.sim_node',
    'pool_sim_ros.ros.spin_thread',
)
"""What most commands load. None of it is a command: Python warns who runs what is loaded."""

NUMBER = struct.Struct('<i')


def serve(control):
    """Start what is ordered until nobody can order more; in what is started, return its order."""
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # so that those who wait below leave no zombie
    while True:
        order, descriptors, _, _ = socket.recv_fds(control, 1 << 20, 3)
        if not order:
            return None
        out, err, told = descriptors
        if os.fork() == 0:
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            control.close()
            child = os.fork()
            if child == 0:
                os.close(told)
                return json.loads(order), out, err
            os.close(out)
            os.close(err)
            wait(child, told)
        for descriptor in descriptors:
            os.close(descriptor)


def wait(child, told):
    """Tell the id of a process, and how it ends; end with it."""
    with contextlib.suppress(BrokenPipeError):
        os.write(told, NUMBER.pack(child))
        _, status = os.waitpid(child, 0)
        os.write(told, NUMBER.pack(os.waitstatus_to_exitcode(status)))
    os._exit(0)


def run(order, out, err):
    """Be the command, or the script, that is ordered."""
    with open(os.devnull) as nothing:
        for old, new in ((nothing.fileno(), 0), (out, 1), (err, 2)):
            os.dup2(old, new)
    for descriptor in (out, err):
        os.close(descriptor)
    # New ones: those from before know what they wrote to.
    sys.stdout = sys.__stdout__ = unbuffered(1, 'strict')
    sys.stderr = sys.__stderr__ = unbuffered(2, 'backslashreplace')
    signal.signal(signal.SIGINT, signal.default_int_handler)
    os.chdir(order['folder'])
    os.environ.clear()
    os.environ.update(order['environment'])
    sys.path[0] = order['folder']
    if 'script' in order:
        sys.argv = ['-c']
        sys.modules['__main__'] = main = types.ModuleType('__main__')
        exec(order['script'], vars(main))
    else:
        sys.argv = ['', *order['arguments']]
        runpy.run_module(order['module'], run_name='__main__', alter_sys=True)


def unbuffered(descriptor, errors):
    """Return a stream as Python has it where PYTHONUNBUFFERED is set."""
    raw = open(descriptor, 'wb', 0, closefd=False)
    return io.TextIOWrapper(raw, errors=errors, write_through=True)


def main():
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in sys.argv[2:] or LOADED:
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    gc.freeze()  # else the end of each process goes through all this, which takes most of its time
    with socket.socket(fileno=int(sys.argv[1])) as control:
        started = serve(control)
    if started:
        run(*started)


if __name__ == '__main__':
    main()
