"""Random numbers by the index of the shot: which chunk or worker draws them changes nothing.

Philox (Salmon et al., SC 2011) makes four words of a key and a counter. Here the key is the seed
and the name of what is drawn, and the counter is the index of the shot; where a shot needs one word
alone, four shots share a value of it.
"""

from __future__ import annotations

import hashlib

import numpy as np
from numpy.typing import NDArray

WORDS = 4
"""That Philox makes of one value of its counter."""

BELOW_ONE = 2.0**-53
"""Makes a number from 0 up to 1 of the upper 53 bits of a word."""


def words_of(seed: int, name: str, first: int, count: int) -> NDArray[np.uint64]:
    """Return the words of so many shots from the first one on, (count, 4)."""
    return _blocks(seed, name, first, count).reshape(count, WORDS)


def single_words(seed: int, name: str, first: int, count: int) -> NDArray[np.uint64]:
    """Return one word for each of so many shots from the first one on, (count,)."""
    block, skipped = divmod(first, WORDS)
    blocks = (skipped + count + WORDS - 1) // WORDS
    return _blocks(seed, name, block, blocks)[skipped : skipped + count]


def _blocks(seed: int, name: str, first: int, count: int) -> NDArray[np.uint64]:
    """Return the words of so many values of the counter from the first one on, (4 count,)."""
    digest = hashlib.blake2b(f'{seed} {name}'.encode(), digest_size=16).digest()
    generator = np.random.Philox(key=int.from_bytes(digest, 'little'), counter=first)
    drawn: NDArray[np.uint64] = generator.random_raw(WORDS * count)
    return drawn


def uniforms(words: NDArray[np.uint64]) -> NDArray[np.float64]:
    """Return numbers from 0 up to 1, of the same shape."""
    return (words >> np.uint64(11)).astype(np.float64) * BELOW_ONE


def normals(words: NDArray[np.uint64]) -> NDArray[np.float64]:
    """Return standard normal numbers for words of shape (m, 4), as many (Box and Muller, 1958)."""
    numbers = uniforms(words)
    radii = np.sqrt(-2.0 * np.log(1.0 - numbers[:, :2]))
    angles = (2.0 * np.pi) * numbers[:, 2:]
    return np.concatenate([radii * np.cos(angles), radii * np.sin(angles)], axis=1)


def first_normals(words: NDArray[np.uint64]) -> NDArray[np.float64]:
    """Return the first column of `normals`, (m,), bit for bit, in a third of the time."""
    radii = np.sqrt(-2.0 * np.log(1.0 - uniforms(words[:, 0])))
    radii *= np.cos((2.0 * np.pi) * uniforms(words[:, 2]))
    return radii
