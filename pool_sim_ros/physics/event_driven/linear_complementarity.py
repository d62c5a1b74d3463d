"""The linear complementarity problem of a few contacts, solved directly.

``0 <= x``, ``0 <= A x - b``, ``x (A x - b) = 0`` for a symmetric, positive semidefinite A: the
least of ``x A x / 2 - b x`` over all x >= 0. The active set method of Lawson and Hanson (*Solving
Least Squares Problems*, 1974) finds it in about as many steps as there are contacts, however much
the masses differ. Where contacts outnumber the freedoms A is singular: proximal steps, each with a
little added to its diagonal, then go to one of the solutions without regard to the order.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.tolerances import (
    IMPULSE_PRECISION,
    MAX_PIVOTS,
    MAX_PROXIMAL_STEPS,
    PROXIMITY,
    SOLVABLE,
)

MAX_DIRECT = 64
"""Contacts up to which a problem is solved directly."""


class Problem(NamedTuple):
    """Room for the problem of up to MAX_DIRECT contacts."""

    matrix: NDArray[np.float64]  # A, (MAX_DIRECT, MAX_DIRECT)
    factor: NDArray[np.float64]  # of the part of A for the active ones, lower triangular
    vectors: NDArray[np.float64]  # (6, MAX_DIRECT), as the numbers below
    active: NDArray[np.int64]  # (MAX_DIRECT,): those with x > 0, and 0 or 1 for each


GIVEN, FOUND, SHIFTED, TRIAL, SLACK, BEFORE = range(6)
"""Rows of `Problem.vectors`: b, x, b of a proximal step, x of a trial, b - A x, x before it."""


def new_problem() -> Problem:
    """Return room for a problem."""
    square = (MAX_DIRECT, MAX_DIRECT)
    return Problem(
        np.zeros(square),
        np.zeros(square),
        np.zeros((6, MAX_DIRECT)),
        np.zeros(MAX_DIRECT, np.int64),
    )


@kernel
def solve(problem: Problem, count: int) -> bool:
    """Find x, in row FOUND, for a problem of `count` unknowns whose A and b are set.

    Returns whether there is one: what is wedged cannot part.
    """
    given, found = problem.vectors[GIVEN], problem.vectors[FOUND]
    shifted, before = problem.vectors[SHIFTED], problem.vectors[BEFORE]
    for i in range(count):
        found[i] = 0.0
        problem.active[i] = 0
    change = largest = 0.0
    for _ in range(MAX_PROXIMAL_STEPS):
        for i in range(count):
            before[i] = found[i]
            shifted[i] = given[i] + PROXIMITY * problem.matrix[i, i] * found[i]
        solve_strictly(problem, count)
        change, largest = 0.0, 0.0
        for i in range(count):
            change = max(change, abs(found[i] - before[i]) * problem.matrix[i, i])
            largest = max(largest, found[i] * problem.matrix[i, i])
        if change <= IMPULSE_PRECISION * largest:
            return True
    return change <= SOLVABLE * largest


@kernel
def solve_strictly(problem: Problem, count: int) -> None:
    """Find x for the problem with a little added to the diagonal, beginning at the x before."""
    found, trial, slack = (
        problem.vectors[FOUND],
        problem.vectors[TRIAL],
        problem.vectors[SLACK],
    )
    active = problem.active
    for _pivot in range(MAX_PIVOTS):
        # The x of the active ones, all above zero; else go as far as that holds.
        for _ in range(count + 1):
            if not solve_active(problem, count):
                break
            share = 1.0
            for i in range(count):
                if active[i] > 0 and trial[i] <= 0.0:
                    # Both are 0 where it has only begun to push.
                    fall = found[i] - trial[i]
                    share = min(share, found[i] / fall if fall > 0.0 else 0.0)
            if share == 1.0:
                for i in range(count):
                    found[i] = trial[i] if active[i] > 0 else 0.0
                break
            for i in range(count):
                if active[i] > 0:
                    found[i] += share * (trial[i] - found[i])
                    if trial[i] <= 0.0 and found[i] <= IMPULSE_PRECISION * abs(trial[i]):
                        found[i] = 0.0
                        active[i] = 0
        worst, enters = largest_slack(problem, count), -1
        for i in range(count):
            if active[i] == 0 and slack[i] > worst:
                worst, enters = slack[i], i
        if enters < 0:
            return
        active[enters] = 1


@inlined
def largest_slack(problem: Problem, count: int) -> float:
    """Find ``b - A x``, and return what of it is rounding."""
    matrix, found = problem.matrix, problem.vectors[FOUND]
    slack, shifted = problem.vectors[SLACK], problem.vectors[SHIFTED]
    scale = 0.0
    for i in range(count):
        total, size = shifted[i], abs(shifted[i])
        for k in range(count):
            part = matrix[i, k] * found[k]
            total -= part
            size += abs(part)
        slack[i] = total - PROXIMITY * matrix[i, i] * found[i]
        scale = max(scale, size)
    return IMPULSE_PRECISION * scale


@kernel
def solve_active(problem: Problem, count: int) -> bool:
    """Solve for the active unknowns alone, into row TRIAL; return whether there are any.

    By the Cholesky factor of their part of A. What is not active has a row of the unit matrix.
    """
    matrix, factor, active = problem.matrix, problem.factor, problem.active
    shifted, trial = problem.vectors[SHIFTED], problem.vectors[TRIAL]
    some = False
    for i in range(count):
        if active[i] == 0:
            trial[i] = 0.0
            continue
        some = True
        total = shifted[i]
        for k in range(i):
            if active[k] > 0:
                left = matrix[i, k]
                for m in range(k):
                    if active[m] > 0:
                        left -= factor[i, m] * factor[k, m]
                factor[i, k] = left / factor[k, k]
                total -= factor[i, k] * trial[k]
        pivot = matrix[i, i] * (1.0 + PROXIMITY)
        for k in range(i):
            if active[k] > 0:
                pivot -= factor[i, k] * factor[i, k]
        # Rounding must not make it negative.
        factor[i, i] = np.sqrt(max(pivot, 0.5 * PROXIMITY * matrix[i, i]))
        trial[i] = total / factor[i, i]
    for back in range(count):
        i = count - 1 - back
        if active[i] > 0:
            total = trial[i]
            for k in range(i + 1, count):
                if active[k] > 0:
                    total -= factor[k, i] * trial[k]
            trial[i] = total / factor[i, i]
    return some
