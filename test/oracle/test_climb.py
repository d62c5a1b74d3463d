"""The climb: chances by importance weights beside fresh samples, its way up, and its choice."""

import math

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Goal, Noise
from pool_sim_ros.oracle.climb import (
    ROUNDS,
    WIDER,
    Climber,
    chances,
    climb_best,
    importance,
)
from pool_sim_ros.oracle.space import Space
from pool_sim_ros.oracle.trials import Trials
from pool_sim_ros.physics import pool_table

TABLE = table_of([(0.5, 0.5), (1.0, 0.5)])
SPACE = Space((0.5, 3.0), 0.0)
WINDOW = Goal(ball='1', rectangle=(1.5, 0.3, 2.0, 0.7))


def trials_of(goal=WINDOW, noise=None):
    return Trials(TABLE, goal, noise or Noise(0.1, 1.0), np.array(TABLE.positions), 1)


def aim_of(speed, azimuth):
    return np.array([speed, azimuth, 0.0, 0.0, 0.0])


def normal_between(low, high):
    """Probability that a standard normal is in an interval."""
    return 0.5 * (math.erf(high / math.sqrt(2)) - math.erf(low / math.sqrt(2)))


@pytest.mark.parametrize('dimensions', [2, 4])
def test_weights_give_the_chance_of_a_box_at_every_aim(dimensions):
    """Shots from two normals count together, in proportion to how many there were."""
    rng = np.random.default_rng(1)
    centres = [(np.zeros(dimensions), 300_000), (np.full(dimensions, 0.5), 100_000)]
    shots = np.concatenate(
        [c + WIDER * rng.standard_normal((count, dimensions)) for c, count in centres]
    )
    box = (np.array([0.2, -1.0, -0.5, 0.0]) - 0.5)[:dimensions]
    met = ((shots > box) & (shots < box + 2.0)).all(axis=1)
    axes = [np.array([-0.7, 0.1 * k, 0.5]) for k in range(dimensions)]
    found = chances(shots[met], importance(shots[met], centres), axes)
    grid = np.stack(np.meshgrid(*axes, indexing='ij'), axis=-1).reshape(-1, dimensions)
    assert len(found) == len(grid) == 3**dimensions
    for aim, chance in zip(grid, found, strict=True):
        exact = math.prod(normal_between(low, low + 2.0) for low in (box - aim).tolist())
        assert chance == pytest.approx(exact, rel=0.04)


def chance_of(trials, aim, count=10_000):
    normals = np.random.default_rng(8).standard_normal((count, 5))
    return trials.play(trials.executed(aim, normals)).met.mean()


def test_it_climbs_and_knows_the_chance_there():
    trials, rng = trials_of(), np.random.default_rng(3)
    climber = Climber(trials, SPACE, aim_of(1.6, 3.0))
    before = chance_of(trials, climber.aim)
    for _ in range(3):
        climber.climb(3000, rng)
    after = chance_of(trials, climber.aim, 40_000)
    assert after > before + 0.1
    assert climber.chance == pytest.approx(after, rel=0.04)
    assert not climber.aim[2:].any()


def test_the_fastest_aim_is_judged_as_it_is():
    """The faster the better: the best aim is at the limit, none beyond it counts."""
    trials = trials_of(Goal(ball='1', rectangle=(1.4, 0.3, 2.0, 0.7)), Noise(0.3, 1.0))
    climber = Climber(trials, Space((0.5, 1.2), 0.0), aim_of(1.0, 0.0))
    rng = np.random.default_rng(1)
    for _ in range(2):
        climber.climb(4000, rng)
    assert climber.aim[0] == pytest.approx(1.2)
    # Four standard deviations. At 1.4 m/s, where a grid without an end would go, it is 0.5.
    truth = chance_of(trials, climber.aim, 40_000)
    assert climber.chance == pytest.approx(truth, rel=0.16)


def test_an_aim_that_starts_at_azimuth_0_climbs_to_either_side():
    trials = trials_of(Goal(ball='1', rectangle=(1.5, 0.5, 2.0, 1.0)), Noise(0.1, 0.5))
    found = []
    for azimuth in (0.2, 359.8):
        climber = Climber(trials, SPACE, aim_of(2.0, azimuth))
        rng = np.random.default_rng(2)
        for _ in range(3):
            climber.climb(3000, rng)
        found.append(climber.aim[1])
    low, high = sorted((azimuth + 180.0) % 360.0 - 180.0 for azimuth in found)
    assert high - low < 0.5 and all(0.0 <= azimuth < 360.0 for azimuth in found)


def test_the_tip_stays_within_its_limit():
    table = pool_table('7ft')
    places = np.array(table.positions)
    places[1:] = [(0.2 + 0.1 * k, 0.1) for k in range(len(places) - 1)]
    # The cue ball comes back towards the cue: the lower the tip, the better.
    trials = Trials(table, Goal(cue_to=(1.4, 0.5), within=0.3), Noise(0.2, 1.0), places, 1)
    climber = Climber(trials, Space((0.5, 3.0), 0.2), np.array([1.5, 180.0, 0.0, 0.0, 0.0]))
    rng = np.random.default_rng(1)
    for _ in range(3):
        climber.climb(1000, rng)
        assert np.hypot(*climber.aim[3:]) <= 0.2 + 1e-9


def test_without_a_success_it_stays():
    trials = trials_of(Goal(first_hit='1') & Goal(avoid='1'))
    climber = Climber(trials, SPACE, aim_of(1.6, 3.0))
    climber.climb(100, np.random.default_rng(1))
    np.testing.assert_array_equal(climber.aim, aim_of(1.6, 3.0))
    assert climber.chance == 0.0


def test_the_best_of_many_are_found_ranked_and_differ():
    trials = trials_of()
    rng = np.random.default_rng(1)
    aims = np.array([aim_of(*rng.uniform((0.6, -12.0), (3.0, 12.0))) for _ in range(12)])
    aims[:, 1] %= 360.0
    best = climb_best(trials, SPACE, aims, (40_000, 3), 1, lambda: False)
    assert 1 <= len(best) <= 3
    found = [chance_of(trials, aim) for aim in best]
    assert found[0] > max(chance_of(trials, aim) for aim in aims)
    assert found[0] > max(found) - 0.01
    for k, aim in enumerate(best):
        assert (np.hypot(*((best[:k] - aim)[:, :2] / (0.1, 1.0)).T) >= 2.0).all()


def test_it_ends_when_it_is_late():
    trials = trials_of()
    aims = np.array([aim_of(1.0 + 0.2 * k, 0.0) for k in range(10)])
    best = climb_best(trials, SPACE, aims, (3000, 2), 1, lambda: True)
    assert len(best) == 2 and trials.played <= ROUNDS[0][0] * 100
