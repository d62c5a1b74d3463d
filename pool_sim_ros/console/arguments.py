"""Arguments of commands: a parser that knows negative numbers, and types that explain mistakes."""

from __future__ import annotations

import argparse
import math
import os
import re
from pathlib import Path
from typing import Any

SLOWEST, FASTEST = 1e-3, 1e4
"""Bounds of a speed, sim seconds per second: those of the node, and a second that takes 17 min."""

_NEGATIVE = re.compile(
    r'-(?:\d[\d_]*\.?[\d_]*|\.\d[\d_]*)(?:e[-+]?\d+)?$|-(?:inf|infinity|nan)$', re.IGNORECASE
)


class Parser(argparse.ArgumentParser):
    """A parser that takes whatever looks like a negative number for a value.

    Python before 3.14 takes ``-4.`` and ``-1e-1`` for options, and every Python ``-inf``.
    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._negative_number_matcher = _NEGATIVE


def number(text: str) -> float:
    """Read a finite number; raises ArgumentTypeError."""
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f'{text!r} is not a number') from None
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f'{text!r} is not a finite number')
    return value


def speed(text: str) -> float:
    """Read sim seconds per second, 0 for as fast as possible; raises ArgumentTypeError."""
    value = number(text)
    if value != 0.0 and not SLOWEST <= value <= FASTEST:
        raise argparse.ArgumentTypeError(
            f'{text!r} is neither 0 nor from {SLOWEST:g} to {FASTEST:g}'
        )
    return abs(value)


def positive(text: str) -> float:
    """Read a finite number above 0; raises ArgumentTypeError."""
    value = number(text)
    if value <= 0.0:
        raise argparse.ArgumentTypeError(f'{text!r} is not above 0')
    return value


def count(text: str) -> int:
    """Read a whole number above 0; raises ArgumentTypeError."""
    if not (text.isascii() and text.isdigit() and len(text) <= 18 and int(text) > 0):
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number above 0')
    return int(text)


def port(text: str) -> int:
    """Read the number of a port; raises ArgumentTypeError."""
    if not (text.isascii() and text.isdigit() and len(text) <= 5 and int(text) < 65536):
        raise argparse.ArgumentTypeError(f'{text!r} is not a port, 0 to 65535')
    return int(text)


def path(text: str) -> Path:
    """Read a path, in which ``~`` is the user's home; raises ArgumentTypeError."""
    if not text:
        raise argparse.ArgumentTypeError('the name is empty')
    if any(character < ' ' for character in text):
        raise argparse.ArgumentTypeError(f'{text!r} has a control character')
    return Path(os.path.expanduser(text))
