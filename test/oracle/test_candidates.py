"""What-if: bits of `simulate_many`, and candidates that are none."""

import math
import re

import numpy as np
import pytest

from pool_sim_ros.oracle import what_if
from pool_sim_ros.physics import pool_table, report_table, simulate_many

REPORT, POOL = report_table(), pool_table('7ft')


def test_discs_bit_for_bit():
    candidates = np.random.default_rng(1).uniform(-4, 4, (50, 2))
    one, other = what_if(REPORT, candidates, threads=1), simulate_many(REPORT, candidates)
    for mine, theirs in zip(one[:6], other[:6], strict=True):
        np.testing.assert_array_equal(mine, theirs)


def test_balls_that_spin_bit_for_bit_each_on_its_layout():
    rng = np.random.default_rng(2)
    candidates = rng.uniform(-3, 3, (20, 5)) * (1, 1, 20, 20, 20)
    layouts = np.tile(POOL.positions, (20, 1, 1))
    layouts[:, 0] += rng.uniform(-0.05, 0.05, (20, 2))
    mine = what_if(POOL, candidates, positions=layouts, events=True)
    theirs = simulate_many(
        POOL, candidates[:, :2], spins=candidates[:, 2:], positions=layouts, events=True
    )
    for one, other in zip(mine, theirs, strict=True):
        np.testing.assert_array_equal(one, other)


def test_one_bad_layout_is_marked_and_the_others_are_played():
    layouts = np.tile(REPORT.positions, (3, 1, 1))
    layouts[1, 0] = layouts[1, 1]
    result = what_if(REPORT, np.ones((3, 2)), positions=layouts)
    assert result.failed.tolist() == [0, 1, 0]


def test_none_is_an_answer():
    assert len(what_if(REPORT, np.empty((0, 2))).durations) == 0


@pytest.mark.parametrize(
    ('table', 'candidates', 'message'),
    [
        (REPORT, [1.0, 2.0], 'candidates: shape (2,) must be (m, 2) or (m, 5)'),
        (POOL, np.ones((4, 3)), 'candidates: shape (4, 3) must be'),
        (REPORT, np.ones((4, 11, 2)), 'candidates: shape (4, 11, 2) must be'),
        (REPORT, [['fast', 0.0]], 'candidates: they are not an array of numbers'),
        (REPORT, [[1.0, 2.0], [1.0]], 'candidates: they are not an array of numbers'),
        (REPORT, np.ones((4, 5)), 'spins: discs do not spin'),
        (REPORT, [[math.nan, 0.0]], 'velocities: nan is not finite'),
        (REPORT, [[1e9, 0.0]], 'velocities: 1e+09 m/s must be at most'),
        (POOL, [[1.0, 0.0, math.inf, 0.0, 0.0]], 'spins: inf is not finite'),
    ],
)
def test_what_are_no_candidates(table, candidates, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        what_if(table, candidates)
