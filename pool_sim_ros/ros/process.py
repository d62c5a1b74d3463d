"""Bringing ROS up and down in a process of our own; what goes wrong is told in one line."""

from __future__ import annotations

import os
import re
import signal
import sys
import threading
import uuid

import rclpy
from rclpy.context import Context
from rclpy.exceptions import InvalidNamespaceException, InvalidNodeNameException
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args


class StartupError(Exception):
    """ROS could not be brought up; the message is for the user."""


INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells have it."""

NAME_ERRORS = (InvalidNamespaceException, InvalidNodeNameException)
"""What the node's constructor raises for a bad `__node` or `__ns`."""


def without_ros_args(args: list[str]) -> list[str]:
    """Return the command line arguments that are not for ROS.

    Raises
    ------
    StartupError
        Where those for ROS, or a parameter file that they name, cannot be read.
    """
    # What rcl logs about them comes a second time with the exception.
    set_logger_level('rcl', LoggingSeverity.FATAL)
    try:
        return remove_ros_args(['', *args])[1:]
    except RuntimeError as error:
        raise StartupError(_explain(str(error))) from error
    finally:
        set_logger_level('rcl', LoggingSeverity.UNSET)


def init_ros(args: list[str]) -> Context:
    """Bring ROS up with these command line arguments; signals are left alone.

    Raises
    ------
    StartupError
        Where the arguments, or a parameter file that they name, cannot be read.
    """
    set_logger_level('rcl', LoggingSeverity.FATAL)
    context = Context()
    try:
        rclpy.init(args=args, context=context, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        raise StartupError(_explain(str(error))) from error
    finally:
        set_logger_level('rcl', LoggingSeverity.UNSET)

    return context


def client_node(context: Context, kind: str, *, enable_rosout: bool = True) -> Node:
    """Return a node under a name that no other has, which offers no services.

    So many of them can be started, and a security policy need not know their names.
    """
    return Node(
        f'pool_{kind}_{uuid.uuid4().hex[:8]}',
        context=context,
        enable_rosout=enable_rosout,
        start_parameter_services=False,
        parameter_overrides=[Parameter('start_type_description_service', value=False)],
    )


def shut_down_on_signals(context: Context) -> None:
    """From now on have SIGINT and SIGTERM shut the context down, and do nothing else.

    To be called by the main thread.
    """
    # Not rclpy's own handlers: they wake the executor before they shut the context down, which at
    # times leaves it waiting for ever. Nor would Python's handlers do by themselves: they run in
    # the main thread once it has left the executor's wait.
    # Plain descriptors, which nothing closes while the process ends: a second signal may come then.
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: None)
    signal.set_wakeup_fd(writer, warn_on_full_buffer=False)

    def wait() -> None:
        os.read(reader, 1)
        context.try_shutdown()

    threading.Thread(target=wait, name='signals', daemon=True).start()


def leave_at_once(status: int) -> None:
    """End the process without waiting for threads that cannot be interrupted."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def _explain(message: str) -> str:
    message = re.sub(r', at \S+:\d+', '', message)
    message = re.sub(r'^(failed to initialize rcl|Failed to parse ROS arguments): ', '', message)
    pattern = r"Couldn't parse params file: '--params-file (.*)'\. Error: (.*)"
    found = re.match(pattern, message, re.S)
    if found is None:
        return f'the arguments cannot be read: {message}'
    file, reason = found.groups()
    if 'opening' in reason:
        return f'the parameter file {file} cannot be opened'
    if 'same type' in reason:
        reason += ' (in a list write all numbers with a decimal point, and quote all labels)'
    return f'the parameter file {file} cannot be read: {reason}'
