"""What an aim is worth, beside a plain loop of single shots."""

from collections import Counter

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Goal, Noise
from pool_sim_ros.oracle.assess import assess
from pool_sim_ros.oracle.intervals import wilson
from pool_sim_ros.oracle.trials import Trials
from pool_sim_ros.physics import cue_strike, pool_table, simulate

TABLE = table_of([(0.5, 0.5), (1.0, 0.5), (1.5, 0.8)])


def test_each_figure_is_that_of_a_loop_of_single_shots():
    goal = Goal(ball='1', to=(1.5, 0.5), within=0.3) & Goal(avoid='2')
    noise = Noise(speed=0.2, azimuth=3.0, camera=2e-3)
    trials = Trials(TABLE, goal, noise, np.array(TABLE.positions), 1)
    aim, count = np.array([1.8, 2.0, 0.0, 0.0, 0.0]), 150
    shot = assess(trials, aim, count, np.random.default_rng(4))

    rng = np.random.default_rng(4)
    normals = rng.standard_normal((count, 5))
    layouts = trials.layouts.draw(count, rng)
    finals, missed, met = [], Counter(), 0
    for normal, layout in zip(normals, layouts, strict=True):
        speed, angle = 1.8 + 0.2 * normal[0], np.radians(2.0 + 3.0 * normal[1])
        velocity = speed * np.cos(angle), speed * np.sin(angle)
        played = simulate(TABLE, velocity, positions=layout)
        finals.append(played.final_positions)
        touched = any(e['kind'] == 0 and {e['a'], e['b']} == {0, 2} for e in played.events)
        if np.hypot(*(finals[-1][1] - (1.5, 0.5))) > 0.3:
            moved = (finals[-1][1] != layout[1]).any()
            missed['ball 1 ends elsewhere' if moved else 'ball 1 does not move'] += 1
        elif touched:
            missed['the cue ball touches ball 2'] += 1
        else:
            met += 1
    assert 0 < met < count and shot.chance == met / count and shot.shots == count
    assert (shot.low, shot.high) == wilson(met, count)
    assert [(f.outcome, round(f.share * count)) for f in shot.failures] == missed.most_common(3)
    np.testing.assert_allclose(shot.mean, np.mean(finals, axis=0))
    np.testing.assert_allclose(shot.spread, np.std(finals, axis=0))
    assert not shot.caught.any() and shot.spin is None and shot.cue is None
    np.testing.assert_allclose(
        shot.velocity, 1.8 * np.array([np.cos(a := np.radians(2)), np.sin(a)])
    )


def test_caught_balls_are_no_part_of_the_mean():
    table = pool_table('7ft')
    seen = np.array(table.positions)
    seen[1:] = [(0.3 + 0.1 * (k % 8), 0.2 + 0.1 * (k // 8)) for k in range(15)]
    seen[0] = 1.5, 0.85
    x, y, _ = table.pockets[np.argmax(table.pockets[:, :2].sum(axis=1))]
    azimuth = np.degrees(np.arctan2(y - 0.85, x - 1.5))
    trials = Trials(table, Goal(keep='C'), Noise(azimuth=1.5), seen, 1)
    shot = assess(trials, np.array([1.0, azimuth, 0, 0.1, 0.2]), 300, np.random.default_rng(1))
    assert 0.1 < shot.caught[0] < 0.99 and shot.chance == pytest.approx(1.0 - shot.caught[0])
    assert np.hypot(*(shot.mean[0] - (x, y))) > 0.05
    assert [f.outcome[:28] for f in shot.failures][:1] == ['the cue ball falls into pock']
    velocity, spin = cue_strike(table, **shot.cue)
    np.testing.assert_array_equal(shot.velocity, velocity)
    np.testing.assert_array_equal(shot.spin, spin)
    surely = assess(trials, np.array([1.0, azimuth, 0, 0, 0]) * 1.0, 1, np.random.default_rng(1))
    assert surely.caught[0] == 1.0 and np.isnan(surely.mean[0]).all()
