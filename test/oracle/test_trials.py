"""Trials: what is executed, what it does to the ball, and how it is judged."""

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Goal, Noise
from pool_sim_ros.oracle.trials import MISCUE, Trials
from pool_sim_ros.physics import cue_strike, pool_table, simulate

DISCS = table_of([(0.5, 0.5), (1.0, 0.5)])
POOL = pool_table('7ft')
NOISE = Noise(0.1, 0.5, 0.2, 0.02, 0.03, 1e-3)


def trials(table, goal, noise=NOISE):
    return Trials(table, goal, noise, np.array(table.positions), 1)


def test_noise_is_added_and_a_cue_neither_goes_back_nor_points_up():
    trial = trials(POOL, Goal(keep='C'))
    aims = np.array([[1.0, 10.0, 0.0, 0.1, -0.1], [0.05, 359.0, 0.0, 0.0, 0.0]])
    normals = np.array([[1.0, -2.0, 1.0, 1.0, 1.0], [-1.0, 4.0, -1.0, 0.0, 0.0]])
    expected = [[1.1, 9.0, 0.2, 0.12, -0.07], [0.0, 361.0, 0.0, 0.0, 0.0]]
    np.testing.assert_allclose(trial.executed(aims, normals), expected, atol=1e-15)
    wide = trial.executed(aims, normals, 2.0 * trial.spread)
    np.testing.assert_allclose(wide[0], [1.2, 8.0, 0.4, 0.14, -0.04])


def test_a_disc_gets_speed_and_azimuth():
    trial = trials(DISCS, Goal(first_hit='1'))
    velocities, spins, held = trial.struck(np.array([[2.0, 30.0, 5.0, 0.9, 0.0]]))
    np.testing.assert_allclose(velocities, [[np.sqrt(3.0), 1.0]])
    assert spins is None and held.all()


def test_a_ball_gets_what_the_cue_gives():
    stroke = np.array([[2.0, 30.0, 5.0, 0.1, -0.2]])
    velocities, spins, held = trials(POOL, Goal(keep='C')).struck(stroke)
    velocity, spin = cue_strike(POOL, *stroke[0])
    np.testing.assert_allclose(velocities[0], velocity, rtol=1e-13)
    np.testing.assert_allclose(spins[0], spin, rtol=1e-12)
    assert held.all()


def test_shots_are_judged_one_by_one_each_on_its_layout():
    trial = trials(DISCS, Goal(ball='1', rectangle=(1.2, 0.0, 2.0, 1.0)))
    rng = np.random.default_rng(3)
    strokes = np.zeros((60, 5))
    strokes[:, 0], strokes[:, 1] = rng.uniform(0.5, 3.0, 60), rng.uniform(-8.0, 8.0, 60)
    layouts = trial.layouts.draw(60, rng)
    met = trial.play(strokes, layouts).met
    for stroke, layout, got in zip(strokes, layouts, met, strict=True):
        angle = np.radians(stroke[1])
        velocity = stroke[0] * np.array([np.cos(angle), np.sin(angle)])
        x, _ = simulate(DISCS, velocity, positions=layout).final_positions[1]
        assert got == (1.2 <= x <= 2.0)
    assert 5 < met.sum() < 55 and trial.played == 60


def test_a_miscue_meets_no_goal_and_is_told():
    trial = trials(POOL, Goal(keep='C'))
    played = trial.play(np.array([[2.0, 30.0, 0.0, 0.4, 0.4], [0.0, 0.0, 0.0, 0.0, 0.0]]))
    assert played.met.tolist() == [False, True]
    assert trial.instead(played, None).tolist() == [MISCUE, '']


@pytest.mark.parametrize('goal', [Goal(touches='1'), Goal(first_hit='1')])
def test_events_are_kept_where_the_goal_needs_them(goal):
    played = trials(DISCS, goal).play(np.array([[2.0, 0.0, 0, 0, 0], [2.0, 180.0, 0, 0, 0]]))
    assert played.met.tolist() == [True, False] or goal.touches
    assert (played.outcomes.events is not None) == (goal.touches is not None)
