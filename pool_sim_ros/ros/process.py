"""How ROS comes up and goes down in a process of our own."""

from __future__ import annotations

import os
import re
import signal
import sys
import threading
import warnings

import rclpy
from rclpy.context import Context
from rclpy.exceptions import NameValidationException
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from pool_sim_ros.ros.environment import StartupError, check_arguments, check_environment

NAME_ERRORS = (NameValidationException,)
"""What ROS raises for a bad `__node` or `__ns`, and for names that are too long with them."""

NO_NODE = 'error creating node: '
ARGUMENTS = 'the arguments cannot be read'
STARTS = {
    'failed to initialize rcl: ': 'ROS cannot start',
    'failed to initialize logging: ': 'ROS cannot keep a log',
    'Failed to parse ROS arguments: ': ARGUMENTS,
    NO_NODE: 'ROS cannot make a node',
}
"""How the errors of rclpy begin, and what is told instead."""


def without_ros_args(args: list[str]) -> list[str]:
    """Return the command line arguments that are not for ROS.

    Raises
    ------
    StartupError
        If ROS cannot read its arguments, or a parameter file that they name.
    """
    check_arguments(args)
    # The exception repeats what rcl logs about them.
    set_logger_level('rcl', LoggingSeverity.FATAL)
    try:
        return remove_ros_args(['', *args])[1:]
    except RuntimeError as error:
        raise StartupError(_explain(str(error))) from error
    finally:
        set_logger_level('rcl', LoggingSeverity.UNSET)


def init_ros(args: list[str]) -> Context:
    """Bring ROS up with these command line arguments, and leave signals alone.

    Raises
    ------
    StartupError
        If ROS cannot read its arguments, or a parameter file that they name, or cannot start here.
    """
    check_environment()
    check_arguments(args)
    # Printed beside the error that is told.
    warnings.filterwarnings('ignore', 'Failed to fini rosout publisher', RuntimeWarning)
    set_logger_level('rcl', LoggingSeverity.FATAL)
    context = Context()
    try:
        rclpy.init(args=args, context=context, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        raise StartupError(_explain(str(error))) from error
    finally:
        set_logger_level('rcl', LoggingSeverity.UNSET)
    return context


def shut_down_on_signals(context: Context) -> None:
    """Make SIGINT and SIGTERM shut the context down, and do nothing else, from now on.

    Only the main thread may call this.
    """
    # rclpy's own handlers wake the executor before they shut the context down, and at times it then
    # waits for ever. Python's handlers alone run too late: in the main thread, after the executor's
    # wait. The descriptors are plain, so that nothing closes them while the process ends: a second
    # signal may come then.
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


def start_error(error: RuntimeError) -> StartupError | None:
    """Return an error in one line where ROS could not make a node; None for any other error."""
    message = str(error)
    return StartupError(_explain(message)) if message.startswith(NO_NODE) else None


def _explain(message: str) -> str:
    message = ' '.join(re.sub(r', at \S+:\d+', '', message).split())
    start = next(filter(message.startswith, STARTS), '')
    words, message = STARTS.get(start, ARGUMENTS), message.removeprefix(start)
    if message.startswith(("Couldn't parse", 'Enclave name')):
        words = ARGUMENTS
    pattern = r"Couldn't parse params file: '--params-file (.*?)'\. Error: (.*)"
    found = re.match(pattern, message, re.S)
    if found is None:
        return f'{words}: {message}'
    file, reason = found.groups()
    if 'opening' in reason:
        return f'the parameter file {file} cannot be opened'
    if 'same type' in reason:
        reason += ' (in a list write all numbers with a decimal point, and quote all labels)'
    return f'the parameter file {file} cannot be read: {reason}'
