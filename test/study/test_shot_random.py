"""Random numbers by the index of the shot."""

import math
import statistics

import numpy as np
import pytest

from pool_sim_ros.study.shot_random import (
    first_normals,
    normals,
    single_words,
    uniforms,
    words_of,
)


def test_any_pieces_give_the_same_bits():
    whole = words_of(7, 'speed', 0, 1000)
    pieces = [words_of(7, 'speed', first, min(37, 1000 - first)) for first in range(0, 1000, 37)]
    np.testing.assert_array_equal(np.concatenate(pieces), whole)
    cut = np.concatenate([normals(piece) for piece in pieces])
    assert cut.tobytes() == normals(whole).tobytes()


@pytest.mark.parametrize('size', [1, 2, 3, 4, 37])
def test_any_pieces_give_the_same_single_words(size):
    whole = single_words(7, 'speed', 0, 200)
    pieces = [
        single_words(7, 'speed', first, min(size, 200 - first)) for first in range(0, 200, size)
    ]
    assert np.concatenate(pieces).tobytes() == whole.tobytes()
    assert whole.tobytes() == words_of(7, 'speed', 0, 50).tobytes()
    assert single_words(7, 'speed', 3, 0).shape == (0,)
    np.testing.assert_array_equal(
        single_words(7, 'speed', 2**42 + 3, 2), words_of(7, 'speed', 2**40, 2).ravel()[3:5]
    )


def test_the_first_normals_are_the_first_column():
    words = words_of(7, 'speed', 0, 1001)
    assert first_normals(words).tobytes() == normals(words)[:, 0].tobytes()


def test_far_shots_have_words_too():
    far = words_of(7, 'speed', 2**40, 4)
    np.testing.assert_array_equal(words_of(7, 'speed', 2**40 + 2, 2), far[2:])


def test_seed_and_name_choose_the_stream():
    streams = [
        words_of(seed, name, 0, 100) for seed in (0, 1, 2**70) for name in ('speed', 'angle')
    ]
    assert len({stream.tobytes() for stream in streams}) == 6
    assert len(np.unique(np.concatenate(streams))) == 6 * 400


def test_normals_are_those_of_box_and_muller():
    words = words_of(1, 'x', 0, 50)
    for row, found in zip(words.tolist(), normals(words), strict=True):
        u = [(word >> 11) / 2**53 for word in row]
        radii = [math.sqrt(-2 * math.log(1 - u[k])) for k in (0, 1)]
        turns = [2 * math.pi * u[k] for k in (2, 3)]
        expected = [
            r * f(a) for f in (math.cos, math.sin) for r, a in zip(radii, turns, strict=True)
        ]
        np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-15)


def test_they_have_the_mean_and_the_spread_that_they_should():
    """Within five standard errors of 0, 1; 1/2, 1/12."""
    words = words_of(3, 'speed', 0, 50_000)
    numbers, even = normals(words).ravel(), uniforms(words).ravel()
    assert abs(numbers.mean()) < 5 / math.sqrt(200_000)
    assert abs(statistics.pvariance(numbers) - 1.0) < 5 * math.sqrt(2 / 200_000)
    assert abs(even.mean() - 0.5) < 5 * math.sqrt(1 / 12 / 200_000)
    assert even.min() >= 0.0 and even.max() < 1.0
