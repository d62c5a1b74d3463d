"""What ROS is given from outside, looked at before it starts: it would end, hang or write lines.

This imports nothing of ROS: some of it ends the process as soon as it is loaded.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from pool_sim_ros.console import CommandError
from pool_sim_ros.simulator import FileError, read_text

LARGEST_DOMAIN = 232
"""Largest domain id for which DDS has ports."""

MAX_FILE = 4_000_000
"""Bytes of a parameter file: the lists of 20,000 balls have half of it."""

MOST_ITEMS = 200_000
"""Commas and lines of a parameter file: the lists of 20,000 balls have 160,000. The time that ROS
takes for a list grows with the square of its length: some 20 s for one of that many numbers."""

DEEPEST = 100
"""Brackets within one another: the time that ROS takes grows with the square of their depth too."""

SWITCHES = (
    'RCUTILS_COLORIZED_OUTPUT',
    'RCUTILS_LOGGING_BUFFERED_STREAM',
    'RCUTILS_LOGGING_USE_STDOUT',
)
"""Variables that are 0 or 1."""


class StartupError(CommandError):
    """ROS could not be brought up; the message is for the user."""


def check_environment(environment: Mapping[str, str] = os.environ) -> None:
    """Return if ROS can start with these variables; make the folder of its logs.

    Raises
    ------
    StartupError
        If not; names the variable, and says what it may be.
    """
    _check_middleware(environment)
    _check_domain(environment.get('ROS_DOMAIN_ID', ''))
    for name in SWITCHES:
        if environment.get(name, '') not in ('', '0', '1'):
            raise StartupError(f'{name} must be 0 or 1, not {environment[name]!r}')
    _check_security(environment)
    _make_log_folder(environment)


def check_arguments(arguments: Sequence[str]) -> None:
    """Return if ROS can read the parameter files and values in these arguments in short time.

    Raises
    ------
    StartupError
        If not; names the file.
    """
    for file in _parameter_files(arguments):
        try:
            text = read_text(file, MAX_FILE)
        except FileError as error:
            raise StartupError(f'the parameter file {file} cannot be opened: {error}') from None
        items = text.count(',') + text.count('\n')
        if items > MOST_ITEMS:
            raise StartupError(
                f'the parameter file {file} cannot be read: it has {items} commas and lines; '
                f'at most {MOST_ITEMS} are read'
            )
        if _depth(text) > DEEPEST:
            raise StartupError(
                f'the parameter file {file} cannot be read: it is nested too deeply, in more than '
                f'{DEEPEST} brackets'
            )
    for argument in arguments:
        if _depth(argument) > DEEPEST:
            raise StartupError(f'the argument {argument[:20]}... is nested too deeply')


def _check_middleware(environment: Mapping[str, str]) -> None:
    wanted = environment.get('RMW_IMPLEMENTATION', '')
    found = sorted(set(_middleware(environment)))
    if wanted and found and wanted not in found:
        raise StartupError(
            f'RMW_IMPLEMENTATION is {wanted!r}, which is not installed; there is {", ".join(found)}'
        )


def _middleware(environment: Mapping[str, str]) -> Iterator[str]:
    """Yield the names of what is installed, as far as it says so in the index of ament."""
    for prefix in (*environment.get('AMENT_PREFIX_PATH', '').split(os.pathsep), sys.prefix):
        folder = Path(prefix, 'share', 'ament_index', 'resource_index', 'rmw_typesupport')
        if prefix and folder.is_dir():
            yield from (file.name for file in folder.iterdir() if file.name != 'rmw_implementation')


def _check_domain(text: str) -> None:
    digits = text.strip().removeprefix('+')
    right = digits.isascii() and digits.isdigit() and len(digits) < 10
    if text and not (right and int(digits) <= LARGEST_DOMAIN):
        raise StartupError(
            f'ROS_DOMAIN_ID must be a whole number from 0 to {LARGEST_DOMAIN}, not {text[:40]!r}'
        )


def _check_security(environment: Mapping[str, str]) -> None:
    enforced = (
        environment.get('ROS_SECURITY_ENABLE') == 'true'
        and environment.get('ROS_SECURITY_STRATEGY') == 'Enforce'
    )
    if enforced and not environment.get('ROS_SECURITY_KEYSTORE'):
        raise StartupError(
            'ROS_SECURITY_ENABLE and ROS_SECURITY_STRATEGY ask for security, and '
            'ROS_SECURITY_KEYSTORE is not set to a keystore'
        )


def _make_log_folder(environment: Mapping[str, str]) -> None:
    home = environment.get('HOME', '')
    folder = environment.get('ROS_LOG_DIR', '')
    if not folder:
        folder = os.path.join(environment.get('ROS_HOME', '') or os.path.join('~', '.ros'), 'log')
    if folder.startswith('~'):
        if not home:
            raise StartupError(
                'HOME is not set, so ROS has no folder for its logs; set HOME or ROS_LOG_DIR'
            )
        folder = home + folder[1:]
    reason = None
    try:
        os.makedirs(folder, exist_ok=True)
    except (OSError, ValueError) as error:
        reason = getattr(error, 'strerror', None) or str(error)
    else:
        if not os.access(folder, os.W_OK | os.X_OK):
            reason = 'Permission denied'
    if reason is not None:
        raise StartupError(
            f'ROS cannot keep its logs in {folder}: {reason}; set ROS_LOG_DIR to another folder'
        )


def _parameter_files(arguments: Sequence[str]) -> Iterator[str]:
    ours = False
    for before, argument in zip(('', *arguments), arguments, strict=False):
        if argument in ('--ros-args', '--'):
            ours = argument == '--ros-args'
        elif ours and before == '--params-file':
            yield argument


def _depth(text: str) -> int:
    """Return how many brackets stand within one another, wherever they stand."""
    deepest = depth = 0
    for character in text:
        if character in '[{':
            depth += 1
            deepest = max(deepest, depth)
        elif character in ']}':
            depth = max(depth - 1, 0)
    return deepest
