"""Keep a process on some cores."""

import contextlib
import os
from collections.abc import Iterator

import pytest


@contextlib.contextmanager
def cores(count: int) -> Iterator[None]:
    """Keep this thread, and the threads and processes it starts, on so many cores."""
    if not hasattr(os, 'sched_setaffinity'):
        pytest.skip('this system does not keep a process on some cores')
    allowed = os.sched_getaffinity(0)
    if len(allowed) < count:
        pytest.skip(f'needs {count} cores; this process may use {len(allowed)}')
    os.sched_setaffinity(0, sorted(allowed)[:count])
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)
