"""Sequences: published points, evenness, and moments of the normals."""

import numpy as np
import pytest

from pool_sim_ros.oracle.sequences import BITS, PLASTIC, direction_vectors, r2, sobol_normals


def test_the_plastic_number_solves_its_equation():
    assert PLASTIC**3 == pytest.approx(PLASTIC + 1.0, abs=1e-14)


def test_r2_goes_on_where_it_was_left():
    shift = np.array([0.3, 0.9])
    whole = r2(0, 1000, shift)
    np.testing.assert_array_equal(np.concatenate([r2(0, 600, shift), r2(600, 400, shift)]), whole)
    assert (whole >= 0.0).all() and (whole < 1.0).all()


def test_r2_fills_the_square_more_evenly_than_chance_does():
    count, boxes = 4096, 16
    index = (r2(0, count, np.zeros(2)) * boxes).astype(int)
    counts = np.bincount(index[:, 0] * boxes + index[:, 1], minlength=boxes**2)
    assert counts.std() < 0.5 * np.sqrt(count / boxes**2)


def test_each_sobol_dimension_has_one_point_in_every_interval():
    """The property of a (0, m, 1) net, which only right direction numbers have."""
    vectors, index = direction_vectors(), np.arange(256)
    points = np.zeros((256, 5), np.int64)
    for bit in range(8):
        points ^= np.where((index >> bit & 1)[:, None], vectors[:, bit], 0)
    assert (np.sort(points >> (BITS - 8), axis=0) == np.arange(256)[:, None]).all()
    # The first points of Joe and Kuo's tables, in the order of their number's bits.
    first = points[:4] / (1 << BITS)
    np.testing.assert_array_equal(first[:2], [[0.0] * 5, [0.5] * 5])
    np.testing.assert_array_equal(first[2, :2], [0.25, 0.75])
    # Any two dimensions are spread over the square: 16 boxes with 16 points each.
    for i in range(5):
        for j in range(i):
            boxes = (points[:, i] >> (BITS - 2)) * 4 + (points[:, j] >> (BITS - 2))
            np.testing.assert_array_equal(np.bincount(boxes, minlength=16), 16)


def test_sobol_is_scipy_s():
    qmc = pytest.importorskip('scipy.stats.qmc')
    expected = np.sort(qmc.Sobol(5, scramble=False).random(64), axis=0)
    vectors, index = direction_vectors(), np.arange(64)
    points = np.zeros((64, 5), np.int64)
    for bit in range(6):
        points ^= np.where((index >> bit & 1)[:, None], vectors[:, bit], 0)
    gray = points[index ^ (index >> 1)] / (1 << BITS)
    np.testing.assert_array_equal(np.sort(gray, axis=0), expected)
    np.testing.assert_array_equal(gray, qmc.Sobol(5, scramble=False).random(64))


def test_sobol_normals_are_standard_and_differ_by_seed():
    one = sobol_normals(1024, np.random.default_rng(1))
    np.testing.assert_allclose(one.mean(axis=0), 0.0, atol=0.01)
    np.testing.assert_allclose(np.cov(one.T), np.eye(5), atol=0.05)
    np.testing.assert_array_equal(one, sobol_normals(1024, np.random.default_rng(1)))
    assert not (one == sobol_normals(1024, np.random.default_rng(2))).any()
