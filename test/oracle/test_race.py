"""The race: the better aims are left, they move to what succeeds, luck is shared."""

import numpy as np
from tables import table_of

from pool_sim_ros.oracle import Goal, Noise
from pool_sim_ros.oracle.race import ROUNDS, SHOTS, common, race
from pool_sim_ros.oracle.space import Space
from pool_sim_ros.oracle.trials import Trials

TABLE = table_of([(0.5, 0.5), (1.0, 0.5)])
SPACE = Space((0.5, 3.0), 0.0)


def trials_of(noise=None, goal=None):
    goal = goal or Goal(ball='1', rectangle=(1.5, 0.3, 2.0, 0.7))
    return Trials(TABLE, goal, noise or Noise(0.1, 1.0), np.array(TABLE.positions), 1)


def aims_of(speeds, azimuths):
    aims = np.zeros((len(speeds), 5))
    aims[:, 0], aims[:, 1] = speeds, azimuths
    return aims


def test_the_last_aims_are_the_best_of_many_and_better_than_they_were():
    trials = trials_of()
    rng = np.random.default_rng(1)
    aims = aims_of(rng.uniform(0.5, 3.0, 200), rng.uniform(-12.0, 12.0, 200) % 360)
    wide = np.tile(trials.spread[:2], (200, 1))
    left = race(trials, SPACE, (aims, wide), SHOTS, 1, lambda: False)
    assert 1 <= len(left) <= ROUNDS[-1][0]
    before, _ = common(trials, aims, 1000, [1])
    after, _ = common(trials, left, 4000, [1])
    assert after.mean(axis=1).max() > before.mean(axis=1).max() - 0.01
    assert after[:8].mean(axis=1).min() > np.median(before.mean(axis=1))


def test_an_aim_beside_the_goal_moves_there():
    """The goal is a window of speeds round 1.5 m/s: its middle is the best aim."""
    trials = trials_of(Noise(speed=0.1), Goal(cue_to=(0.5, 0.5), within=2.0))
    trials.play = lambda strokes, layouts: Window(strokes)
    start = aims_of([1.7], [90.0])
    left = race(trials, SPACE, (start, np.array([[0.1, 5e-3]])), SHOTS, 1, lambda: False)
    assert abs(left[0, 0] - 1.5) < 0.03


class Window:
    def __init__(self, strokes):
        self.met = abs(strokes[:, 0] - 1.5) < 0.1


def test_it_ends_when_it_is_late():
    trials = trials_of()
    aims = aims_of(np.linspace(1.0, 3.0, 50), np.zeros(50))
    left = race(trials, SPACE, (aims, np.tile([0.1, 1.0], (50, 1))), SHOTS, 1, lambda: True)
    assert len(left) == 50 and trials.played == 50 * ROUNDS[0][1]


def test_all_aims_of_a_round_have_the_same_luck():
    trials = trials_of(Noise(0.1, 1.0, camera=1e-3))
    aims = aims_of([2.0, 2.0, 1.0], [1.0, 1.0, 0.0])
    met, normals = common(trials, aims, 200, [5])
    assert met.shape == (3, 200) and normals.shape == (200, 5)
    np.testing.assert_array_equal(met[0], met[1])
    assert (met[0] != met[2]).any()
