"""The command line of the scripts that compare with pooltool and write a table."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from benchmark.ask_pooltool import Pooltool
from benchmark.results import write_between_marks


def run(what: str, compared: Callable[[Pooltool], str], marks: tuple[str, str]) -> int:
    """Print the table that `compared` makes, write it where asked to; return the exit status."""
    parser = argparse.ArgumentParser(description=what)
    parser.add_argument(
        '--pooltool',
        type=Path,
        default=Path('.venv-bench/bin/python'),
        metavar='PYTHON',
        help='Python of an environment with pooltool; default: .venv-bench/bin/python',
    )
    parser.add_argument(
        '--write', type=Path, metavar='FILE', help='write the table between the marks in this file'
    )
    arguments = parser.parse_args()
    if not arguments.pooltool.exists():
        parser.error(f'--pooltool: {arguments.pooltool} does not exist; `make bench` creates it')
    try:
        with tempfile.TemporaryDirectory() as home:
            table = compared(Pooltool(arguments.pooltool, Path(home)))
    except RuntimeError as error:
        print(str(error).splitlines()[-1], file=sys.stderr)
        return 1
    print(table)
    if arguments.write:
        try:
            write_between_marks(arguments.write, table, marks)
        except (OSError, ValueError) as error:
            print(f'--write: {error}', file=sys.stderr)
            return 1
    return 0
