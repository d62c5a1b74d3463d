"""Start Python on a script or a command and wait for what it prints."""

import os
import subprocess
import sys

TIMEOUT = 600.0


def run_python(*arguments: str, **environment: str) -> str:
    """Return the standard output of this interpreter with these arguments.

    Raises
    ------
    RuntimeError
        Where it fails; what it printed.
    """
    done = subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        timeout=TIMEOUT,
        env={**os.environ, **environment},
    )
    if done.returncode:
        raise RuntimeError(f'{" ".join(arguments)}: {done.stderr.strip()}')
    return done.stdout
