"""What is to be done, and what a shot earns."""

import dataclasses
import re

import numpy as np
import pytest

from pool_sim_ros.physics import pool_table, report_table, simulate
from pool_sim_ros.study.tasks import Place, Pot

REPORT, SEVEN = report_table(), pool_table('7ft')
FEW = dataclasses.replace(SEVEN, balls=SEVEN.balls[:3])


def state_of(task, rows):
    return type(task.starts)(*(part[rows].copy() for part in task.starts))


def place(table=REPORT, speed=4.0, starts=40, ball='9', where=None, within=0.1):
    return Place(table, speed, starts, 1, ball, where, within)


def test_a_shot_earns_by_how_much_the_ball_came_nearer():
    task = place()
    state = state_of(task, slice(None))
    actions = np.random.default_rng(1).uniform(-1.0, 1.0, (40, 2))
    turn = task.play(state, actions)
    ball = REPORT.index('9')
    arrived = 0
    for k in range(40):
        shot = simulate(REPORT, 4.0 * actions[k], positions=state.positions[k])
        assert (turn.state.positions[k] == shot.final_positions).all()
        before, after = (
            np.hypot(*(places[ball] - state.goals[k]))
            for places in (state.positions[k], shot.final_positions)
        )
        there = after <= 0.1
        arrived += there
        assert turn.rewards[k] == pytest.approx(before - after + there, abs=1e-12)
        assert turn.ended[k] == there
    assert not turn.failed.any() and (state.goals == turn.state.goals).all()


def test_a_ball_that_rests_at_its_place_ends_it_and_earns_one():
    end = simulate(REPORT, (-4.0, 0.0)).final_positions[REPORT.index('9')]
    task = place(starts=REPORT.positions, where=end)
    turn = task.play(task.starts, np.array([[-1.0, 0.0]]))
    assert turn.ended.all()
    assert turn.rewards[0] == pytest.approx(1.0 - task.starts.scores[0], abs=1e-12)


def test_no_start_has_the_ball_at_its_place():
    assert (place(starts=5000, within=0.3).starts.scores < -0.3).all()


@pytest.fixture(scope='module')
def straight():
    """A cue ball and a ball in line with the corner pocket, near it; and one far from all."""
    corner = SEVEN.pockets[np.hypot(*SEVEN.pockets[:, :2].T).argmin(), :2]
    way = np.array([SEVEN.length, SEVEN.width]) / 2.0 - corner
    way /= np.hypot(*way)
    layout = np.array([corner + 0.6 * way, corner + 0.3 * way, [1.7, 0.8]])
    return Pot(FEW, 4.0, layout, 1), -way


def test_a_potted_ball_earns_one(straight):
    task, towards = straight
    turn = task.play(task.starts, np.array([[*0.4 * towards, 0.0, -0.3]]))
    assert turn.outcomes.pocketed[0, 1] >= 0 > turn.outcomes.pocketed[0, 0]
    assert turn.rewards[0] == 1.0 and not turn.ended[0]
    again = task.play(turn.state, np.array([[0.0, 0.0, 0.0, 0.0]]))
    assert again.rewards[0] == 0.0, 'a ball that lies in a pocket is not potted once more'


def test_a_caught_cue_ball_ends_it_and_costs_one(straight):
    task, towards = straight
    aside = task.starts.positions.copy()
    aside[0, 1] = 1.5, 0.8
    turn = task.play(task.starts._replace(positions=aside), np.array([[*towards, 0.0, 0.0]]))
    assert turn.outcomes.pocketed[0, 0] >= 0 and turn.ended[0] and turn.rewards[0] == -1.0


def test_the_last_ball_ends_it(straight):
    alone = dataclasses.replace(FEW, balls=FEW.balls[:2])
    task, towards = straight
    task = Pot(alone, 4.0, task.starts.positions[:, :2], 1)
    turn = task.play(task.starts, np.array([[*0.4 * towards, 0.0, -0.3]]))
    assert turn.ended[0] and turn.rewards[0] == 1.0


def test_on_a_table_with_pockets_a_caught_ball_cannot_be_placed(straight):
    task, towards = straight
    task = place(FEW, starts=task.starts.positions, ball='1', where=(1.0, 0.5))
    turn = task.play(task.starts, np.array([[*0.4 * towards, 0.0, -0.3]]))
    assert turn.ended[0] and turn.rewards[0] < -1.0


def test_a_shot_that_fails_moves_nothing_and_earns_nothing():
    task = place(starts=3)
    state = state_of(task, slice(None))
    state.positions[1, 1] = state.positions[1, 2]
    turn = task.play(state, np.full((3, 2), 0.5))
    assert turn.failed.tolist() == [False, True, False]
    assert (turn.state.positions[1] == state.positions[1]).all()
    assert turn.rewards[1] == 0.0 and not turn.ended[1]
    assert turn.state.scores[1] == state.scores[1]


def test_a_table_that_is_asleep_does_not_move():
    task = place(starts=2)
    turn = task.play(task.starts, np.full((2, 2), 0.5), np.array([True, False]))
    moved = (turn.state.positions != task.starts.positions).any(axis=(1, 2))
    assert moved.tolist() == [False, True]


@pytest.mark.parametrize(
    ('make', 'message'),
    [
        (lambda: place(ball='x'), "label: 'x' is not on the table"),
        (lambda: place(ball='C'), "ball: 'C' is the cue ball; name another one"),
        (lambda: place(within=0.0), 'within: 0.0 must be above 0 m'),
        (lambda: place(within=float('nan')), 'within: nan must be above 0 m'),
        (lambda: place(where=(9.0, 0.5)), 'place: (9.0, 0.5) must be x and y on the cloth'),
        (lambda: place(where=(0.5,)), 'place: (0.5,) must be x and y'),
        (lambda: place(where='there'), "place: 'there' must be x and y"),
        (lambda: place(table='report'), "table: 'report' must be a Table"),
        (
            lambda: place(dataclasses.replace(REPORT, mu_ball_surface=0.0)),
            'table: nothing stops the balls',
        ),
        (lambda: Pot(REPORT, 4.0, 3, 1), 'table: it has no pockets'),
        (
            lambda: Pot(dataclasses.replace(SEVEN, balls=SEVEN.balls[:1]), 4.0, 3, 1),
            'table: it has the cue ball alone',
        ),
    ],
)
def test_a_task_that_cannot_be_is_refused(make, message):
    with pytest.raises(ValueError, match='^' + re.escape(message)):
        make()
