"""How a command that takes part in ROS starts, fails and stops."""

from __future__ import annotations

import argparse
import functools
import os
from collections.abc import Callable
from typing import TYPE_CHECKING

from pool_sim_ros.console import INTERRUPTED, CommandError, Main, console_command
from pool_sim_ros.ros.environment import check_environment

if TYPE_CHECKING:
    from rclpy.context import Context

PARAMETER_FILE = '--params-file'
"""What stands before the name of a parameter file."""


def ros_command(
    name: str,
    parser: Callable[[], argparse.ArgumentParser],
    *errors: type[Exception],
    interrupted: str | None = None,
    interrupt_status: int = INTERRUPTED,
) -> Callable[[Callable[[Context, argparse.Namespace], int | None]], Main]:
    """Return a decorator that makes the `main` of a command which takes part in ROS.

    ROS is imported and up before the function runs, and goes down after it. The function takes the
    context and the parsed arguments; it returns the exit status, where None stands for 0. Where ROS
    is missing, the command still explains itself and its arguments.

    Parameters
    ----------
    name : str
        What the user calls the command.
    parser : callable
        Returns the parser of the arguments that are not for ROS.
    *errors, interrupted, interrupt_status
        As in `console.console_command`. Bad names of nodes and bad arguments for ROS are always
        told in one line.
    """

    def decorate(run: Callable[[Context, argparse.Namespace], int | None]) -> Main:
        @console_command(name, *errors, interrupted=interrupted, interrupt_status=interrupt_status)
        @functools.wraps(run)
        def main(args: list[str]) -> int | None:
            check_environment()  # some of ROS ends the process as soon as it is loaded
            args = with_home(args)
            try:
                from pool_sim_ros.ros.process import (
                    NAME_ERRORS,
                    init_ros,
                    start_error,
                    without_ros_args,
                )
            except ImportError:
                parser().parse_args(before_ros_args(args))
                raise
            check_text(args)
            options = parser().parse_args(without_ros_args(args))
            context = init_ros(args)
            try:
                return run(context, options)
            except NAME_ERRORS as error:
                raise CommandError(' '.join(str(error).split())) from error
            except RuntimeError as error:
                told = start_error(error)
                if told is None:
                    raise
                raise told from error
            finally:
                context.try_shutdown()

        return main

    return decorate


def with_home(args: list[str]) -> list[str]:
    """Return the arguments with the user's home for ``~`` in the names of parameter files.

    A shell leaves it where it does not begin a word, as in the arguments of `ros2 launch`.
    """
    before = ['', *args][: len(args)]
    return [
        os.path.expanduser(word) if last == PARAMETER_FILE else word
        for last, word in zip(before, args, strict=True)
    ]


def check_text(args: list[str]) -> None:
    """Return if ROS can read the arguments.

    Raises
    ------
    CommandError
        If one is not UTF-8: a name of a file may be any bytes.
    """
    for word in args:
        try:
            word.encode()
        except UnicodeEncodeError:
            raise CommandError(
                f'the argument {word!a} is no UTF-8 text, which ROS asks for'
            ) from None


def before_ros_args(args: list[str]) -> list[str]:
    """Return the arguments in front of those for ROS."""
    return args[: args.index('--ros-args')] if '--ros-args' in args else args
