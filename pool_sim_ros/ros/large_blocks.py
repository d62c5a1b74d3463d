"""Memory for messages of many MB, kept from message to message."""

from __future__ import annotations

import numpy as np

LARGEST = (32 << 20) - (64 << 10)
"""Bytes, just below the largest block that glibc is ready to keep."""


def keep_large_blocks() -> None:
    """Make the C library keep memory that is freed for the next message, up to 64 MB.

    By default each block of many MB comes fresh from the system, a page fault for each 4 KB of it:
    a message of 13 MB, which is copied several times on its way, takes longer for that than for the
    copies. glibc keeps blocks as large as the largest that was ever freed. So one is made here, and
    freed; nobody writes to it, so that it costs nothing. Other libraries of C may do as they like.
    """
    np.empty(LARGEST, np.uint8)
