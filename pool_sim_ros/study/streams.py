"""Random numbers by their place: what an environment draws depends on its seed and the episode."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

GOLDEN = np.uint64(0x9E3779B97F4A7C15)
FIRST, SECOND = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
SHIFTS = np.uint64(30), np.uint64(27), np.uint64(31)
"""Of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014)."""

WORD = 2**64


def mixed(words: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Return the output of SplitMix64 for states of any shape."""
    words = (words ^ (words >> SHIFTS[0])) * FIRST
    words = (words ^ (words >> SHIFTS[1])) * SECOND
    return words ^ (words >> SHIFTS[2])


def draws(seeds: NDArray[np.uint64], episodes: NDArray[np.uint64], below: int) -> NDArray[np.int64]:
    """Return a whole number from 0 up to `below`, for each seed and episode, of one shape.

    The seeds are `mixed` ones, so that neighbours have nothing in common.
    """
    return (mixed(seeds + GOLDEN * episodes) % np.uint64(below)).astype(np.int64)
