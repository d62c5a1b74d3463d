"""The climb: chances by importance weights beside fresh samples, and its way up."""

import math

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Goal, Noise
from pool_sim_ros.oracle.climb import FARTHEST, WIDER, chances, climb, offsets
from pool_sim_ros.oracle.space import Space
from pool_sim_ros.oracle.trials import Trials

TABLE = table_of([(0.5, 0.5), (1.0, 0.5)])


def normal_between(low, high):
    """Probability that a standard normal is in an interval."""
    return 0.5 * (math.erf(high / math.sqrt(2)) - math.erf(low / math.sqrt(2)))


@pytest.mark.parametrize('dimensions', [1, 2, 4])
def test_weights_give_the_chance_of_a_box_at_every_offset(dimensions):
    rng = np.random.default_rng(1)
    count = 400_000
    shots = WIDER * rng.standard_normal((count, dimensions))
    box = (np.array([0.2, -1.0, -0.5, 0.0]) - 0.5)[:dimensions]
    met = ((shots > box) & (shots < box + 2.0)).all(axis=1)
    near = np.vstack([np.zeros(dimensions), 0.5 * np.ones(dimensions), -0.7 * np.ones(dimensions)])
    counted = WIDER**dimensions * chances(shots[met], near) / count
    for offset, chance in zip(near, counted, strict=True):
        exact = math.prod(normal_between(low, low + 2.0) for low in (box - offset).tolist())
        assert chance == pytest.approx(exact, rel=0.03)


def test_offsets_fill_a_ball_from_its_middle():
    near = offsets(2, np.random.default_rng(1))
    away = np.hypot(*near.T)
    assert away[0] == 0.0 and away.max() < FARTHEST
    # As many within half the area as beyond.
    assert (away < FARTHEST / math.sqrt(2)).mean() == pytest.approx(0.5, abs=0.01)


def test_it_climbs():
    goal = Goal(ball='1', rectangle=(1.5, 0.3, 2.0, 0.7))
    trials = Trials(TABLE, goal, Noise(0.1, 1.0), np.array(TABLE.positions), 1)
    space, rng = Space((0.5, 3.0), 0.0), np.random.default_rng(3)
    aim = np.array([1.6, 3.0, 0.0, 0.0, 0.0])
    before = chance(trials, aim)
    for _ in range(2):
        aim = climb(trials, space, aim, 4000, rng)
    assert chance(trials, aim) > before + 0.1
    assert not aim[2:].any()


def chance(trials, aim):
    normals = np.random.default_rng(8).standard_normal((10_000, 5))
    return trials.play(trials.executed(aim, normals)).met.mean()


def test_without_a_success_it_stays():
    goal = Goal(first_hit='1') & Goal(avoid='1')
    trials = Trials(TABLE, goal, Noise(0.1, 1.0), np.array(TABLE.positions), 1)
    aim = np.array([1.6, 3.0, 0.0, 0.0, 0.0])
    after = climb(trials, Space((0.5, 3.0), 0.0), aim, 100, np.random.default_rng(1))
    np.testing.assert_array_equal(after, aim)
