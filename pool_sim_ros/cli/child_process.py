"""Modules of this package that a command runs as processes of their own."""

from __future__ import annotations

import subprocess
import sys
from typing import IO

PATIENCE = 5.0
"""Seconds to wait for a process to end."""


def start_module(
    module: str, *args: str, output: IO[bytes] | None = None
) -> subprocess.Popen[bytes]:
    """Start a module below `pool_sim_ros`.

    Parameters
    ----------
    module : str
    *args : str
    output : file, optional
        Where it writes; by default where this process does.
    """
    command = [sys.executable, '-m', f'pool_sim_ros.{module}', *args]
    return subprocess.Popen(command, stdout=output, stderr=output)


def end(process: subprocess.Popen[bytes]) -> None:
    """End a process, and wait until it has ended."""
    process.terminate()
    try:
        process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
