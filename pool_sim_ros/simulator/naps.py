"""For how long the playback thread sleeps between two frames."""

from __future__ import annotations

LONGEST_NAP = 0.05
"""Longest sleep of the playback thread, s: it bounds how long resuming and stopping take."""

HEAD_START = 8e-4
"""Seconds before a frame is due at which a second, short sleep starts: it ends more exactly than a
long one."""

SHORTEST_NAP = 1e-4
"""Seconds for which the lock is free between two batches: a waiting thread can take it."""

BUSY_NAP = 1e-3
"""The same while requests keep coming: they need their share of the interpreter."""


def nap(wait: float, busy: bool) -> float:
    """Return for how long to sleep, s.

    Parameters
    ----------
    wait : float
        Seconds until the next frame is due; at most 0 where it is, inf where none will be.
    busy : bool
        Whether requests keep coming.
    """
    if wait > 0.0:
        return min(wait - HEAD_START if wait > HEAD_START else wait, LONGEST_NAP)
    return BUSY_NAP if busy else SHORTEST_NAP


def is_just_before(wait: float) -> bool:
    """Return whether the nap of a wait ends a head start before the frame."""
    return HEAD_START < wait <= LONGEST_NAP
