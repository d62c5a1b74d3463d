"""Of the 95 % intervals that searches report, 95 % contain the truth: by a formula, not by shots.

A disc alone in the middle of a wide table rolls v^2 / (2 mu g) far, straight on. So the chance that
it ends within r of a point is an integral over its speed alone, which is done to seven digits.
"""

import math

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Goal, Noise, find_shots
from pool_sim_ros.oracle.assess import assess
from pool_sim_ros.oracle.trials import Trials

TABLE = table_of([(10.0, 10.0)], length=20.0, width=20.0)
STEPS = np.linspace(-7.0, 7.0, 701)
DENSITY = np.exp(-0.5 * STEPS**2) / math.sqrt(2.0 * math.pi)


def below(values):
    """Return the probability that a standard normal is below each value."""
    return 0.5 * (1.0 + np.array([math.erf(v / math.sqrt(2.0)) for v in values]))


def truth(shot, distance, azimuth, within, noise):
    """Return the chance of a shot to end within some metres of a point."""
    speeds = np.maximum(shot.speed + noise.speed * STEPS, 0.0)
    far = speeds**2 / (2.0 * TABLE.mu_ball_surface * TABLE.gravity)
    # Law of cosines: how much the direction may differ for the end to be within the circle.
    cosine = (far**2 + distance**2 - within**2) / (2.0 * np.maximum(far, 1e-9) * distance)
    turn = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    aim = (shot.azimuth - azimuth + 180.0) % 360.0 - 180.0
    hit = below((turn - aim) / noise.azimuth) - below((-turn - aim) / noise.azimuth)
    return (DENSITY * hit * (cosine < 1.0)).sum() * (STEPS[1] - STEPS[0])


def problem(seed):
    """Return distance, azimuth and radius of a place, how badly one shoots, and the goal."""
    rng = np.random.default_rng(seed)
    distance, azimuth, within = rng.uniform((0.5, 0.0, 0.05), (3.0, 360.0, 0.3))
    noise = Noise(speed=rng.uniform(0.03, 0.15), azimuth=rng.uniform(0.5, 4.0))
    place = 10.0 + distance * np.array([math.cos(a := math.radians(azimuth)), math.sin(a)])
    return (distance, azimuth, within, noise), Goal(cue_to=tuple(place.tolist()), within=within)


def holds(shot, given):
    """Return whether the interval of a shot contains the truth."""
    return shot.low <= truth(shot, *given) <= shot.high


def held(seeds):
    """Return for each interval that searches report whether it contains the truth."""
    result = []
    for seed in seeds:
        given, goal = problem(seed)
        plan = find_shots(TABLE, goal, given[3], 5000, seed, threads=1, speeds=(0.3, 3.5))
        result += [holds(shot, given) for shot in plan]
    return result


def test_the_formula_is_what_is_played():
    noise = Noise(speed=0.1, azimuth=3.0)
    goal = Goal(cue_to=(11.5, 10.0), within=0.2)
    plan = find_shots(TABLE, goal, noise, 400_000, speeds=(0.3, 3.5))
    for shot in plan:
        chance = truth(shot, 1.5, 0.0, 0.2, noise)
        assert abs(shot.chance - chance) < 4.0 * math.sqrt(chance * (1.0 - chance) / shot.shots)
    assert plan[0].chance > 0.3


def test_intervals_of_any_aim_contain_the_truth():
    """Four standard deviations either way."""
    found, rng = [], np.random.default_rng(1)
    for seed in range(10):
        (distance, azimuth, within, noise), goal = problem(seed)
        trials = Trials(TABLE, goal, noise, np.array(TABLE.positions), 1)
        best = math.sqrt(2.0 * TABLE.mu_ball_surface * TABLE.gravity * distance)
        for _ in range(50):
            aim = np.array([best, azimuth, 0.0, 0.0, 0.0])
            aim[:2] += rng.uniform(-1.0, 1.0, 2) * trials.spread[:2]
            shot = assess(trials, aim, 500, rng)
            found.append(holds(shot, (distance, azimuth, within, noise)))
    assert abs(np.mean(found) - 0.95) < 4.0 * math.sqrt(0.95 * 0.05 / len(found))


def test_a_search_does_not_flatter_what_it_chose():
    """Four standard deviations: shots that chose the best would hold far less often."""
    found = held(range(20))
    assert np.mean(found) > 0.95 - 4.0 * math.sqrt(0.95 * 0.05 / len(found))


@pytest.mark.soak
def test_of_4000_intervals_94_to_96_per_cent_contain_the_truth():
    found = held(range(1000, 4800))[:4000]
    assert len(found) == 4000
    assert 0.94 <= np.mean(found) <= 0.96
