"""Points that fill a space evenly: the R2 sequence, and normals from a Sobol sequence."""

from __future__ import annotations

from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

PLASTIC = 1.32471795724474602596
"""The real root of x^3 = x + 1, from which the R2 sequence is made (Roberts 2018)."""

BITS = 30
"""Of a Sobol point: 2^30 points before the sequence repeats."""

DIRECTIONS = (
    (0, ()),
    (0, (1,)),
    (1, (1, 3)),
    (1, (1, 3, 1)),
    (2, (1, 1, 1)),
)
"""Polynomial and first direction numbers of each dimension (Joe and Kuo 2008, new-joe-kuo-6); the
first dimension needs none. A stroke has five numbers."""


def r2(first: int, count: int, shift: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points of the R2 sequence from number `first` on, (count, 2) in [0, 1).

    `shift`, (2,), is where the sequence begins.
    """
    steps = np.array([1.0 / PLASTIC, 1.0 / PLASTIC**2])
    points: NDArray[np.float64] = (shift + np.arange(first, first + count)[:, None] * steps) % 1.0
    return points


def sobol_normals(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return standard normals of five dimensions that are spread evenly, (count, 5).

    A random digital shift makes each of them exact in the mean, whatever the count.
    """
    points = np.zeros((count, len(DIRECTIONS)), np.int64)
    index = np.arange(count)
    vectors = direction_vectors()
    for bit in range(int(count).bit_length()):
        points ^= np.where((index >> bit & 1)[:, None], vectors[:, bit], 0)
    points ^= rng.integers(0, 1 << BITS, len(DIRECTIONS))
    inverse = NormalDist().inv_cdf
    uniform = ((points + 0.5) / (1 << BITS)).ravel().tolist()
    return np.array([inverse(u) for u in uniform]).reshape(points.shape)


def direction_vectors() -> NDArray[np.int64]:
    """Return what each bit of a point's number adds to it, (5, BITS), as integers of BITS bits."""
    vectors = np.zeros((len(DIRECTIONS), BITS), np.int64)
    for dimension, (polynomial, first) in enumerate(DIRECTIONS):
        degree = len(first)
        if degree == 0:
            vectors[dimension] = [1 << (BITS - 1 - bit) for bit in range(BITS)]
            continue
        v = [m << (BITS - 1 - bit) for bit, m in enumerate(first)]
        for bit in range(degree, BITS):
            new = v[bit - degree] ^ (v[bit - degree] >> degree)
            for k in range(1, degree):
                if polynomial >> (degree - 1 - k) & 1:
                    new ^= v[bit - k]
            v.append(new)
        vectors[dimension] = v
    return vectors
