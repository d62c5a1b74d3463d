"""Wilson's interval: against its quadratic, and its coverage against the exact binomial."""

import math

import numpy as np
import pytest

from pool_sim_ros.oracle.intervals import Z, wilson


def test_its_ends_are_as_far_from_the_share_as_their_own_deviation_says():
    """The definition: |share - p| = z sqrt(p (1 - p) / n) at both ends."""
    for count in (1, 7, 100, 5000):
        for successes in range(count + 1)[:: max(count // 20, 1)]:
            for end in wilson(successes, count):
                if 0.0 < end < 1.0:
                    deviation = math.sqrt(end * (1.0 - end) / count)
                    assert abs(successes / count - end) == pytest.approx(Z * deviation, rel=1e-9)


def test_none_and_all_are_in_it():
    assert wilson(0, 50)[0] == 0.0 and wilson(50, 50)[1] == 1.0
    assert 0.0 < wilson(0, 50)[1] < 0.08 and 0.92 < wilson(50, 50)[0] < 1.0


def binomial(count, chance):
    """Probability of each number of successes, exactly."""
    k = np.arange(count + 1)
    logs = [math.lgamma(count + 1) - math.lgamma(i + 1) - math.lgamma(count - i + 1) for i in k]
    return np.exp(np.array(logs) + k * math.log(chance) + (count - k) * math.log1p(-chance))


def test_it_holds_the_truth_in_95_of_100_cases():
    count = 2000
    intervals = np.array([wilson(k, count) for k in range(count + 1)])
    for chance in (0.02, 0.1, 0.37, 0.5, 0.83, 0.97):
        weights = binomial(count, chance)
        assert weights.sum() == pytest.approx(1.0)
        holds = (intervals[:, 0] <= chance) & (chance <= intervals[:, 1])
        assert 0.94 < weights[holds].sum() < 0.96, chance
