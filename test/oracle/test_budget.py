"""The error budget: beside a formula and beside fresh shots, its tolerances, and bad input."""

import math
import re

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import ErrorBudget, Goal, Noise, error_budget, find_shots
from pool_sim_ros.physics import pool_table

TABLE = table_of([(0.5, 0.5), (1.8, 0.9)])
AIM = {'speed': 1.0, 'azimuth': 0.0}


def run(speed):
    """Return how far a disc slides, m."""
    return speed**2 / (2.0 * TABLE.deceleration)


def test_the_chance_falls_as_the_formula_of_a_sliding_disc_says():
    """The cue ball stops within 5 cm where its speed is between two bounds."""
    end = 0.5 + run(1.0)
    budget = error_budget(TABLE, Goal(cue_to=(end, 0.5), within=0.05), AIM, shots=2000)
    slow, fast = (math.sqrt(2 * TABLE.deceleration * (run(1.0) + d)) for d in (-0.05, 0.05))
    for level, chance in zip(budget.levels['speed'][1:], budget.chances['speed'][1:], strict=True):
        below, above = ((bound - 1.0) / (level * math.sqrt(2)) for bound in (slow, fast))
        exact = 0.5 * (math.erf(above) - math.erf(below))
        assert chance == pytest.approx(exact, abs=0.01), level
    assert budget.chance == budget.chances['speed'][0] == 1.0
    assert list(budget.levels) == ['speed', 'azimuth', 'camera']
    low, high = budget.low['speed'], budget.high['speed']
    assert (low <= budget.chances['speed']).all() and (budget.chances['speed'] <= high).all()


def test_the_other_errors_stay_as_given():
    end = 0.5 + run(1.0)
    goal = Goal(cue_to=(end, 0.5), within=0.05)
    noise = Noise(speed=0.1)
    budget = error_budget(TABLE, goal, AIM, noise=noise, shots=500)
    alone = error_budget(TABLE, goal, AIM, shots=500)
    assert budget.chances['azimuth'][0] == budget.chance < 0.6
    np.testing.assert_array_equal(budget.chances['speed'], alone.chances['speed'])


def test_tolerances_are_where_the_chance_falls_below():
    levels = {name: np.array([0.0, 0.1, 0.2]) for name in ('speed', 'azimuth', 'camera')}
    chances = {
        'speed': np.array([1.0, 0.9, 0.5]),
        'azimuth': np.array([1.0, 1.0, 0.95]),
        'camera': np.array([0.7, 0.9, 0.2]),
    }
    budget = ErrorBudget(1.0, levels, chances, chances, chances)
    allowed = budget.tolerance(0.8)
    assert allowed['speed'] == pytest.approx(0.125)
    assert allowed['azimuth'] == math.inf and allowed['camera'] == 0.0


def test_words_and_picture():
    pytest.importorskip('matplotlib')
    budget = error_budget(TABLE, Goal(cue_to=(1.0, 0.5), within=0.1), AIM, shots=100)
    assert str(budget).splitlines()[0].startswith('speed     (m/s)  0: 100 %  0.01: 100 %')
    figure = budget.plot()
    assert [axis.get_xlabel() for axis in figure.axes] == [
        'speed (m/s)',
        'azimuth (degrees)',
        'camera (m)',
    ]
    x, y = figure.axes[0].lines[0].get_data()
    np.testing.assert_array_equal(y, budget.chances['speed'])
    np.testing.assert_array_equal(x, budget.levels['speed'])


def test_a_ranked_shot_with_its_cue():
    table = pool_table('7ft')
    goal = Goal(first_hit='1')
    plan = find_shots(table, goal, 'fastfiz', 1000)
    budget = error_budget(table, goal, plan[0], shots=100)
    assert list(budget.levels) == ['speed', 'azimuth', 'elevation', 'side', 'above', 'camera']
    assert budget.chance == 1.0


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        ({'shot': {'speed': 1.0}}, 'must be a RankedShot, or have speed, azimuth'),
        ({'shot': {'speed': 1.0, 'azimuth': 0.0, 'side': 0.1}}, 'must be a RankedShot'),
        ({'shot': (1.0, 0.0)}, 'shot: (1.0, 0.0) must be a RankedShot'),
        ({'shot': {'speed': math.nan, 'azimuth': 0.0}}, 'speed: nan is not finite'),
        ({'goal': Goal(keep='9')}, "goal: keep: '9' is not on the table"),
        ({'noise': 'pro'}, "noise: 'pro' is none"),
        ({'shots': 99}, 'shots: 99 must be at least 100'),
    ],
)
def test_bad_input(arguments, message):
    given = {'goal': Goal(keep='1'), 'shot': AIM} | arguments
    with pytest.raises(ValueError, match=re.escape(message)):
        error_budget(TABLE, given.pop('goal'), given.pop('shot'), **given)
