"""The search: its answer beside brute force, its determinism, its budget, and bad input."""

import dataclasses
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from benchmark.search_problems import problems, true_chance
from tables import table_of

from pool_sim_ros.oracle import Goal, Noise, find_shots
from pool_sim_ros.oracle.goal import goal_of
from pool_sim_ros.oracle.trials import Trials
from pool_sim_ros.physics import Ball, pool_table

REFERENCE = Path(__file__).parents[1] / 'benchmark' / 'search_reference.json'
TABLE = table_of([(0.5, 0.5), (1.0, 0.4), (1.5, 0.6)])
GOAL = Goal(ball='1', to=(1.6, 0.3), within=0.1)
NOISE = Noise(speed=0.05, azimuth=0.5)


def same(one, other):
    """Return whether two plans are equal bit for bit."""
    if len(one) != len(other) or one.played != other.played:
        return False
    return all(
        np.array_equal(a, b, equal_nan=True) if isinstance(a, np.ndarray) else a == b
        for mine, theirs in zip(one, other, strict=True)
        for a, b in zip(mine, theirs, strict=True)
    )


def chance(table, goal, noise, shot, count=40_000, seed=77):
    """Return the chance of a reported shot from samples that nobody has seen."""
    trials = Trials(table, goal_of(goal), noise, np.array(table.positions), None)
    rng = np.random.default_rng(seed)
    aim = np.array([shot.speed, shot.azimuth, 0.0, 0.0, 0.0])
    if shot.cue:
        aim[3:] = shot.cue['side'], shot.cue['above']
    strokes = trials.executed(aim, rng.standard_normal((count, 5)))
    return trials.play(strokes, trials.layouts.draw(count, rng)).met.mean()


@pytest.fixture(scope='module')
def plan():
    return find_shots(TABLE, GOAL, NOISE, 100_000, threads=1)


def test_reported_chances_are_those_of_fresh_samples(plan):
    assert 1 <= len(plan) <= 5
    for shot in plan:
        truth = chance(TABLE, GOAL, NOISE, shot)
        deviation = math.sqrt(truth * (1 - truth) * (1 / shot.shots + 1 / 40_000))
        assert abs(shot.chance - truth) < 4.0 * deviation
        assert shot.low <= shot.chance <= shot.high


def test_nothing_that_brute_force_finds_is_better(plan):
    """A grid in steps of a deviation, 100 shots each; its best once more with 20,000."""
    trials = Trials(TABLE, GOAL, NOISE, np.array(TABLE.positions), None)
    speeds, azimuths = np.arange(0.3, 5.0, 0.1), np.arange(-60.0, 60.0, 0.5)
    aims = np.zeros((len(speeds) * len(azimuths), 5))
    aims[:, 0], aims[:, 1] = np.repeat(speeds, len(azimuths)), np.tile(azimuths, len(speeds))
    rng = np.random.default_rng(5)
    strokes = trials.executed(np.repeat(aims, 10, axis=0), rng.standard_normal((10 * len(aims), 5)))
    counted = trials.play(strokes).met.reshape(-1, 10).mean(axis=1)
    best = aims[np.argsort(-counted)[:30]]
    grid = []
    for aim in best:
        strokes = trials.executed(aim, rng.standard_normal((5000, 5)))
        grid.append(trials.play(strokes).met.mean())
    assert chance(TABLE, GOAL, NOISE, plan[0]) > 0.98 * max(grid)


def test_the_same_seed_gives_the_same_bits_whatever_the_threads(plan):
    assert same(plan, find_shots(TABLE, GOAL, NOISE, 100_000, threads=2))
    assert not same(plan, find_shots(TABLE, GOAL, NOISE, 100_000, seed=1, threads=1))


def test_it_plays_about_as_many_shots_as_it_may(plan):
    assert 0.9 * 100_000 < plan.played < 1.1 * 100_000 and not plan.cut
    few = find_shots(TABLE, GOAL, NOISE, 1000)
    assert few.played < 20_000


def test_shots_of_an_answer_differ(plan):
    for k, shot in enumerate(plan):
        for other in plan[:k]:
            turn = (shot.azimuth - other.azimuth + 180.0) % 360.0 - 180.0
            assert math.hypot((shot.speed - other.speed) / 0.05, turn / 0.5) >= 2.0


def test_none_found_says_how_much_was_searched():
    plan = find_shots(TABLE, Goal(touches='1') & Goal(avoid='1'), NOISE, 50_000)
    assert not plan and not plan.cut and plan.played == 50_000
    assert str(plan).startswith('None found: ')


def test_seconds_cut_the_search_and_the_answer_says_so():
    plan = find_shots(TABLE, GOAL, NOISE, 10_000_000, seconds=1e-3)
    assert plan.cut and plan.played < 200_000
    assert plan and all(0.0 <= shot.low <= shot.chance for shot in plan)


def test_a_caller_hears_how_many_shots_are_played_and_may_end_the_search():
    heard = []
    again = find_shots(TABLE, GOAL, NOISE, 3000, on_round=heard.append)
    assert heard[0] == 0 and heard == sorted(heard) and 0 < heard[-1] <= again.played
    assert same(again, find_shots(TABLE, GOAL, NOISE, 3000))

    def stop(played):
        raise KeyError(played)

    with pytest.raises(KeyError, match='0'):
        find_shots(TABLE, GOAL, NOISE, on_round=stop)
    with pytest.raises(ValueError, match='shots'):  # all is checked before anybody is called
        find_shots(TABLE, GOAL, NOISE, 5, on_round=stop)


def test_a_camera_lowers_the_chance_and_the_report_knows(plan):
    noise = Noise(speed=0.05, azimuth=0.5, camera=3e-3)
    seen = find_shots(TABLE, GOAL, noise, 60_000)
    assert seen[0].chance < plan[0].chance
    truth = chance(TABLE, GOAL, noise, seen[0])
    assert abs(seen[0].chance - truth) < 4.0 * math.sqrt(truth * (1 - truth) / seen[0].shots) + 0.01


def test_somebody_without_noise_never_misses():
    plan = find_shots(TABLE, Goal(ball='1', to=(1.6, 0.3), within=0.05), Noise(), 30_000)
    assert plan[0].chance == 1.0 and not plan[0].failures


@pytest.fixture(scope='module')
def pool():
    table = pool_table('7ft')
    ball = table.balls[0]
    places = {'C': (1.4, 0.5), '9': (0.5, 0.3), '8': (0.9, 0.7)}
    balls = [Ball(k, ball.mass, ball.radius, p, is_cue=k == 'C') for k, p in places.items()]
    return dataclasses.replace(table, balls=tuple(balls))


def test_a_ball_is_potted_on_a_pool_table(pool):
    goal = Goal(ball='9', pocket='any') & Goal(keep='C')
    plan = find_shots(pool, goal, 'fastfiz', 60_000)
    truth = chance(pool, goal, Noise.preset('fastfiz'), plan[0], 10_000)
    assert plan[0].chance > 0.5 and abs(plan[0].chance - truth) < 0.05
    assert plan[0].caught[1] >= plan[0].chance
    assert plan[0].cue['side'] == plan[0].cue['above'] == 0.0 and plan[0].spin.shape == (3,)


def test_the_tip_is_sought_too_where_it_may_move(pool):
    """A pot after which the cue ball comes back: hardly anybody does that without spin."""
    goal = Goal(ball='9', pocket='any') & Goal(cue_to=(1.4, 0.5), within=0.15)
    middle = find_shots(pool, goal, 'fastfiz', 60_000)
    tip = find_shots(pool, goal, 'fastfiz', 60_000, offset=0.4)
    assert tip[0].chance > 2.0 * max(shot.chance for shot in middle)
    assert 0.02 < math.hypot(tip[0].cue['side'], tip[0].cue['above']) <= 0.4 + 1e-12
    truth = chance(pool, goal, Noise.preset('fastfiz'), tip[0], 10_000)
    assert abs(tip[0].chance - truth) < 4.0 * math.sqrt(truth * (1 - truth) / tip[0].shots)


def scattered(count, seed):
    """Return the seven-foot table with its first balls anywhere, at least 1 cm apart."""
    table, rng = pool_table('7ft'), np.random.default_rng(seed)
    places = np.empty((0, 2))
    while len(places) < count:
        place = rng.uniform((0.08, 0.08), (table.length - 0.08, table.width - 0.08))
        if (np.hypot(*(places - place).T) > 0.07).all():
            places = np.vstack([places, place])
    balls = [
        dataclasses.replace(ball, position=tuple(place.tolist()))
        for ball, place in zip(table.balls, places, strict=False)
    ]
    return dataclasses.replace(table, balls=tuple(balls))


@pytest.mark.soak
@pytest.mark.parametrize(('count', 'least'), [(3, 0.99), (7, 0.76), (10, 0.84), (16, 0.99)])
def test_balls_are_potted_and_their_chances_are_within_2_per_cent(count, least):
    """Aim and speed alone, and with the tip anywhere: what is reported beside fresh shots."""
    table = scattered(count, {3: 1, 7: 2, 10: 3, 16: 4}[count])
    goal = Goal(ball=table.labels[1], pocket='any') & Goal(keep='C')
    for shots, offset in ((150_000, 0.0), (300_000, 0.3)):
        plan = find_shots(table, goal, 'fastfiz', shots, offset=offset)
        truth = chance(table, goal, Noise.preset('fastfiz'), plan[0], 100_000)
        assert truth > least and abs(plan[0].chance / truth - 1.0) < 0.02


def ratio(problem, shots, seed):
    """Return the true chance of the best shot over that of the reference."""
    plan = find_shots(problem.table, problem.goal, problem.noise, shots, seed)
    aim = np.array([plan[0].speed, plan[0].azimuth, 0.0, 0.0, 0.0])
    best = json.loads(REFERENCE.read_text())[problem.name]['chance']
    return true_chance(problem.trials(), aim, 100_000, [9, seed]) / best


def test_the_best_of_an_exhaustive_sweep_is_found():
    (problem,) = [p for p in problems() if p.name == 'place 2 of four']
    assert ratio(problem, 330_000, 0) > 0.98


@pytest.mark.soak
def test_46_of_48_searches_find_the_best_of_an_exhaustive_sweep():
    found = [ratio(problem, 330_000, seed) for problem in problems() for seed in range(4)]
    assert (np.array(found) >= 0.98).mean() >= 0.95
    soon = [ratio(problem, 130_000, seed) for problem in problems() for seed in range(4)]
    assert (np.array(soon) >= 0.9).mean() >= 0.95


def test_positions_take_the_place_of_the_table_s(plan):
    table = table_of([(0.5, 0.5), (1.5, 0.8), (0.2, 0.2)])
    moved = find_shots(table, GOAL, NOISE, 100_000, positions=TABLE.positions, threads=1)
    assert same(plan, moved)


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        ({'goal': Goal(keep='99')}, "goal: keep: '99' is not on the table"),
        ({'goal': Goal(ball='1', pocket='any')}, 'this table has no pockets'),
        ({'goal': {'keep': 'x', 'nan': 1}}, "goal: 'nan' is none of"),
        ({'goal': None}, 'goal: None must be a Goal'),
        ({'noise': 'pro'}, "noise: 'pro' is none"),
        ({'noise': 0.1}, 'noise: 0.1 must be a Noise'),
        ({'shots': 999}, 'shots: 999 must be at least 1000'),
        ({'shots': 1e6}, 'shots: 1000000.0 is not a whole number'),
        ({'shots': True}, 'shots: True is not a whole number'),
        ({'seed': -1}, 'seed: -1 must be at least 0'),
        ({'count': 0}, 'count: 0 must be at least 1'),
        ({'seconds': 0.0}, 'seconds: 0.0 must be above 0'),
        ({'seconds': math.nan}, 'seconds: nan must be above 0'),
        ({'seconds': 'soon'}, "seconds: 'soon' is not a number"),
        ({'threads': 0}, 'threads: 0 must be at least 1'),
        ({'speeds': (3, 2)}, 'speeds: (3, 2) must rise'),
        ({'offset': 0.1}, 'offset: discs do not spin'),
        ({'positions': np.zeros((2, 2))}, 'positions: shape (2, 2) must be (3, 2)'),
        ({'positions': np.zeros((3, 2))}, 'outside the table'),
    ],
)
def test_bad_input(arguments, message):
    given = {'goal': GOAL, 'noise': NOISE} | arguments
    with pytest.raises(ValueError, match=re.escape(message)):
        find_shots(TABLE, given.pop('goal'), given.pop('noise'), **given)
