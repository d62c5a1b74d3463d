"""The direct solution of a linear complementarity problem, against one that tries every set."""

import naive_events
import numpy as np
import pytest

from pool_sim_ros.physics.event_driven.linear_complementarity import (
    FOUND,
    GIVEN,
    MAX_DIRECT,
    new_problem,
    solve,
)


def solved(matrix, offset):
    problem, n = new_problem(), len(offset)
    # What an earlier problem left must not matter.
    for array in (problem.matrix, problem.factor, problem.vectors):
        array[:] = 7.0
    problem.matrix[:n, :n] = matrix
    problem.vectors[GIVEN, :n] = offset
    solve(problem, n)
    return problem.vectors[FOUND, :n].copy()


def contact_matrix(rng, contacts, balls, mass_ratio):
    """Return J M^-1 J^T of contacts between random pairs, as contacts have it."""
    jacobian = np.zeros((contacts, 2 * balls))
    for row in jacobian:
        a, b = rng.choice(balls + 1, 2, replace=False)
        normal = rng.normal(size=2)
        normal /= np.hypot(*normal)
        for ball, sign in ((a, -1.0), (b, 1.0)):
            if ball < balls:
                row[2 * ball : 2 * ball + 2] = sign * normal
    masses = mass_ratio ** rng.random(balls)
    return jacobian @ (jacobian / np.repeat(masses, 2)).T


@pytest.mark.parametrize('mass_ratio', [1.0, 1e2, 1e6])
@pytest.mark.parametrize('balls', [2, 3, 8])
def test_against_every_set(balls, mass_ratio):
    """The product A x is unique, even where x is not."""
    rng = np.random.default_rng(1)
    compared = 0
    for _ in range(100):
        n = int(rng.integers(1, 7))
        matrix = contact_matrix(rng, n, balls, mass_ratio)
        offset = rng.normal(size=n)
        expected = naive_events.solve_lcp(matrix, -offset)
        if expected is None:
            continue  # wedged: there is none
        found = solved(matrix, offset)
        assert found.min() >= 0.0
        np.testing.assert_allclose(matrix @ found, matrix @ expected, atol=1e-9)
        compared += 1
    assert compared > 50


@pytest.mark.parametrize('n', [1, 5, 20, MAX_DIRECT])
def test_it_is_a_solution(n):
    rng = np.random.default_rng(2)
    for _ in range(10):
        matrix = contact_matrix(rng, n, n, 1e4)
        offset = matrix @ rng.normal(size=n)
        found = solved(matrix, offset)
        slack = matrix @ found - offset
        scale = np.abs(matrix) @ found + np.abs(offset)
        assert found.min() >= 0.0
        assert np.all(slack >= -1e-10 * scale.max())
        assert np.all(np.minimum(found * np.diag(matrix), slack) <= 1e-9 * scale.max())


def test_the_order_does_not_matter():
    """Not even where contacts outnumber the freedoms."""
    rng = np.random.default_rng(3)
    for _ in range(30):
        matrix = contact_matrix(rng, 8, 3, 10.0)
        offset = matrix @ rng.uniform(0.0, 1.0, 8)
        order = rng.permutation(8)
        found = solved(matrix, offset)
        shuffled = solved(matrix[np.ix_(order, order)], offset[order])
        np.testing.assert_allclose(shuffled, found[order], atol=1e-7)


def test_nothing_pushes_where_all_part():
    assert not solved(np.eye(3), -np.ones(3)).any()
