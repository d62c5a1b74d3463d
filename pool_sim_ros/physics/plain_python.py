"""The kernels as plain Python, for NUMBA_DISABLE_JIT=1: slow, but a debugger can step through."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np


def as_plain_python(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a kernel that does in plain Python what it would do compiled.

    There the fields of a record are attributes, and a division by zero is no warning.
    """

    @wraps(function)
    def call(*args: Any) -> Any:
        if getattr(_running, 'kernel', False):  # called by another kernel, which has seen to it
            return function(*args)
        _running.kernel = True
        try:
            with np.errstate(all='ignore'):
                return function(*map(with_attributes, args))
        finally:
            _running.kernel = False

    return call


def with_attributes(arrays: Any) -> Any:
    """Return arrays, in tuples at any depth, whose records have their fields as attributes."""
    if isinstance(arrays, np.ndarray):
        return arrays.view(np.recarray) if arrays.dtype.names else arrays
    if not isinstance(arrays, tuple):
        return arrays
    parts = map(with_attributes, arrays)
    return type(arrays)(*parts) if hasattr(arrays, '_fields') else tuple(parts)


_running = threading.local()
