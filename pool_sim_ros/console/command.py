"""How every command starts, fails and stops."""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from typing import Protocol

INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells have it."""


class CommandError(Exception):
    """A command cannot do its work; the message is one line for the user."""


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
        @functools.wraps(run)
        def main(args: list[str] | None = None) -> int:
            try:
                return run(sys.argv[1:] if args is None else args) or 0
            except told as error:
                print(f'{name}: {error}', file=sys.stderr)
                return 1
            except KeyboardInterrupt:
                if interrupted is not None:
                    print(interrupted, file=sys.stderr)
                return interrupt_status

        return main

    return decorate
