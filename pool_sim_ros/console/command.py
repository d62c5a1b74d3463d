"""How every command starts, fails and stops."""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from typing import Protocol

from pool_sim_ros.console.errors import CommandError
from pool_sim_ros.console.missing import PACKAGE, import_line
from pool_sim_ros.console.output import (
    NOBODY_READS,
    BrokenOutputError,
    complain,
    guarded_output,
)
from pool_sim_ros.interrupts import kept_interrupts

INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells have it."""


class Main(Protocol):
    """The function that an entry point names."""

    def __call__(self, args: list[str] | None = None) -> int:
        """Run with these arguments, by default the process's own; return the exit status."""


def console_command(
    name: str,
    *errors: type[Exception],
    interrupted: str | None = None,
    interrupt_status: int = INTERRUPTED,
) -> Callable[[Callable[[list[str]], int | None]], Main]:
    """Return a decorator that makes the `main` of a command.

    The function takes the list of arguments and returns the exit status, where None stands for 0.
    A missing package is told in one line too, and so is an output that cannot be written.

    Parameters
    ----------
    name : str
        What the user calls the command.
    *errors : exception types
        Errors to tell in one line, like `CommandError`; the exit status is then 1.
    interrupted : str, optional
        Line to write after a KeyboardInterrupt.
    interrupt_status : int, optional
        Exit status after a KeyboardInterrupt.
    """

    told: tuple[type[Exception], ...] = (CommandError, *errors)

    def decorate(run: Callable[[list[str]], int | None]) -> Main:
        def attempt(args: list[str]) -> int:
            try:
                return run(args) or 0
            except told as error:
                complain(f'{name}: {error}')
                return 1
            except ImportError as error:
                if (error.name or '').partition('.')[0] == PACKAGE:
                    raise
                complain(f'{name}: {import_line(error)}')
                return 1
            except KeyboardInterrupt:
                # What was interrupted while it was made may raise once more when it goes.
                sys.unraisablehook = lambda _: None
                if interrupted is not None:
                    complain(interrupted)
                return interrupt_status

        @functools.wraps(run)
        def main(args: list[str] | None = None) -> int:
            try:
                with guarded_output(), kept_interrupts():
                    return attempt(sys.argv[1:] if args is None else args)
            except BrokenOutputError as error:
                if error.unread:
                    return NOBODY_READS
                complain(f'{name}: the output cannot be written: {error.reason}')
                return 1

        return main

    return decorate
