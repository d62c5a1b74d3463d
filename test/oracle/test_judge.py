"""Goals against outcomes made by hand, and against tables that cannot have them."""

import re

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Goal
from pool_sim_ros.oracle.judge import Judge, touched
from pool_sim_ros.physics import Outcomes, pool_table, simulate_many

PLAIN = table_of([(0.5, 0.5), (1.0, 0.5), (1.5, 0.5)])
POOL = pool_table('7ft')


def outcomes(finals, pocketed=None, first_hit=None, failed=None):
    """Return outcomes of shots with three balls, without events."""
    finals = np.array(finals, dtype=float)
    shots, balls = finals.shape[:2]
    return Outcomes(
        finals,
        np.ones(shots),
        np.ones(shots, int),
        np.full((shots, balls), -1) if pocketed is None else np.array(pocketed),
        np.full(shots, -1) if first_hit is None else np.array(first_hit),
        np.zeros(shots, np.int8) if failed is None else np.array(failed, np.int8),
        None,
        None,
    )


def judge(goal, table=PLAIN):
    return Judge(table, goal, np.array(table.positions))


def ends(*places):
    """Return outcomes of which each moves ball 1 somewhere."""
    return outcomes([[(0.5, 0.5), place, (1.5, 0.5)] for place in places])


def test_a_ball_near_a_point():
    result = ends((0.3, 0.2), (0.3, 0.299), (0.3, 0.3001), (0.229, 0.271), (1.0, 0.5))
    goal = Goal(ball='1', to=(0.3, 0.2), within=0.1)
    # 0.0709^2 + 0.0709^2 = 0.1003^2
    assert judge(goal).met(result).tolist() == [True, True, False, False, False]


def test_a_ball_in_a_rectangle():
    result = ends((0.3, 0.2), (0.1, 0.1), (0.09, 0.2), (0.3, 0.41), (1.0, 0.5))
    goal = Goal(ball='1', rectangle=(0.1, 0.1, 0.5, 0.4))
    assert judge(goal).met(result).tolist() == [True, True, False, False, False]


def test_the_cue_ball_near_a_point():
    result = outcomes([[(0.5, 0.55), (1.0, 0.5), (1.5, 0.5)], [(0.5, 0.7), (1, 0.5), (1.5, 0.5)]])
    assert judge(Goal(cue_to=(0.5, 0.5), within=0.1)).met(result).tolist() == [True, False]


def test_a_caught_ball_is_nowhere_on_the_cloth():
    x, y, _ = POOL.pockets[0]
    finals = np.tile(POOL.positions, (2, 1, 1))
    finals[:, 1] = x, y
    caught = np.full((2, 16), -1)
    caught[0, 1] = 0
    result = outcomes(finals, caught)
    near = Goal(ball='1', to=(x, y), within=0.1)
    area = Goal(ball='1', rectangle=(x - 0.1, y - 0.1, x + 0.1, y + 0.1))
    assert judge(near, POOL).met(result).tolist() == [False, True]
    assert judge(area, POOL).met(result).tolist() == [False, True]


def test_pockets():
    caught = np.full((4, 16), -1)
    caught[:, 1] = 0, 3, -1, 5
    caught[:, 0] = -1, 2, -1, -1
    result = outcomes(np.tile(POOL.positions, (4, 1, 1)), caught)

    def met(goal):
        return judge(goal, POOL).met(result).tolist()

    assert met(Goal(ball='1', pocket='any')) == [True, True, False, True]
    assert met(Goal(ball='1', pocket=3)) == [False, True, False, False]
    assert met(Goal(ball='1', pocket=0)) == [True, False, False, False]
    assert met(Goal(keep='C')) == [True, False, True, True]
    assert met(Goal(ball='1', pocket='any') & Goal(keep='C')) == [True, False, False, True]


def test_first_hit():
    result = outcomes(np.tile(PLAIN.positions, (3, 1, 1)), first_hit=[1, 2, -1])
    assert judge(Goal(first_hit='1')).met(result).tolist() == [True, False, False]
    assert judge(Goal(first_hit='2')).met(result).tolist() == [False, True, False]


def test_touches_and_avoid():
    """The middle ball is hit along the row; it drives the third, which the cue ball follows not."""
    result = simulate_many(PLAIN, [(1.5, 0.0), (0.0, 1.0), (0.2, 0.0)], events=True, threads=1)
    assert touched(result, 1).tolist() == [True, False, False]
    assert touched(result, 2).tolist() == [False, False, False]
    assert result.first_hit.tolist() == [1, -1, -1]
    assert judge(Goal(touches='1')).met(result).tolist() == [True, False, False]
    assert judge(Goal(avoid='1')).met(result).tolist() == [False, True, True]
    assert judge(Goal(touches='1') & Goal(avoid='2')).met(result).tolist() == [True, False, False]
    assert not judge(Goal(touches='1') & Goal(avoid='1')).met(result).any()
    assert judge(Goal(touches='1')).needs_events and not judge(Goal(first_hit='1')).needs_events


def test_a_shot_that_failed_meets_nothing():
    result = outcomes(np.tile(PLAIN.positions, (2, 1, 1)), failed=[0, 2])
    assert judge(Goal(keep='1')).met(result).tolist() == [True, False]


def test_how_far_shots_missed_in_the_size_of_the_goal():
    finals = np.tile(POOL.positions, (5, 1, 1))
    finals[:, 1] = [(0.5, 0.5), (0.5, 0.6), (0.8, 0.5), (0.5, 0.5), (0.5, 0.5)]
    caught = np.full((5, 16), -1)
    caught[3, 1] = 2
    result = outcomes(finals, caught, [1, 1, 1, 1, 2], [0, 0, 0, 0, 0])

    def misses(goal):
        mine = judge(goal, POOL)
        return mine.misses(result, mine.met(result)).tolist()

    near = misses(Goal(ball='1', to=(0.5, 0.5), within=0.05))
    assert near == pytest.approx([1.0, 2.0, 6.0, np.inf, 1.0])
    area = misses(Goal(ball='1', rectangle=(0.4, 0.45, 0.6, 0.55)))
    assert area == pytest.approx([1.0, 2.0, 3.0, np.inf, 1.0])
    both = misses(Goal(ball='1', to=(0.5, 0.5), within=0.05) & Goal(first_hit='1'))
    assert both == pytest.approx([1.0, 2.0, 6.0, np.inf, np.inf])
    failed = result._replace(failed=np.array([0, 0, 0, 0, 2], np.int8))
    mine = judge(Goal(ball='1', to=(0.5, 0.5), within=0.05), POOL)
    assert mine.misses(failed, mine.met(failed))[4] == np.inf


def test_what_came_instead():
    start = np.array(POOL.positions)
    finals = np.tile(start, (6, 1, 1))
    finals[:4, 1] += 0.1
    caught = np.full((6, 16), -1)
    caught[1, 1], caught[2, 0], caught[5, 1] = 2, 4, 0
    result = outcomes(finals, caught, [1, 1, 1, 2, -1, 1], [0, 0, 0, 0, 0, 0])
    goal = Goal(first_hit='1') & Goal(ball='1', pocket=0) & Goal(keep='C')
    words = judge(goal, POOL).instead(result, start).tolist()
    second = POOL.labels[2]
    assert words == [
        'ball 1 stays on the cloth',
        'ball 1 falls into pocket 2',
        'ball 1 stays on the cloth',
        f'the cue ball touches ball {second} first',
        'the cue ball touches nothing',
        '',
    ]
    only = judge(Goal(keep='C'), POOL).instead(result, start).tolist()
    assert only == ['', '', 'the cue ball falls into pocket 4', '', '', '']
    near = judge(Goal(ball='1', to=(0.3, 0.3), within=0.1), POOL).instead(result, start).tolist()
    assert near[0] == 'ball 1 ends elsewhere' and near[4] == 'ball 1 does not move'


@pytest.mark.parametrize(
    ('goal', 'table', 'message'),
    [
        (Goal(keep='99'), PLAIN, "goal: keep: '99' is not on the table; it has 0, 1, 2"),
        (Goal(ball='99', pocket='any'), POOL, "goal: ball: '99' is not on the table"),
        (Goal(first_hit='0'), PLAIN, "goal: first_hit: '0' is the cue ball"),
        (Goal(touches='0'), PLAIN, "goal: touches: '0' is the cue ball"),
        (Goal(avoid='0'), PLAIN, "goal: avoid: '0' is the cue ball"),
        (Goal(ball='1', pocket='any'), PLAIN, 'this table has no pockets'),
        (Goal(ball='1', pocket=0), PLAIN, 'this table has no pockets'),
        (Goal(ball='1', pocket=6), POOL, 'goal: pocket: 6 must be 0 to 5'),
        (Goal(ball='1', to=(30, 20), within=5), PLAIN, 'goal: to: (30.0, 20.0) is off the cloth'),
        (Goal(cue_to=(-1, 0), within=0.5), PLAIN, 'goal: cue_to: (-1.0, 0.0) is off the cloth'),
        (Goal(ball='1', rectangle=(2.1, 0, 3, 1)), PLAIN, 'goal: rectangle: '),
    ],
)
def test_what_a_table_cannot_have(goal, table, message):
    for wanted in (goal, Goal(keep=table.labels[1]) & goal):
        with pytest.raises(ValueError, match=re.escape(message)):
            judge(wanted, table)


def test_balls_that_lie_in_a_pocket():
    places = np.array(POOL.positions)
    places[1] = POOL.pockets[2, :2]
    for goal in (Goal(keep='1'), Goal(ball='1', pocket='any'), Goal(touches='1')):
        with pytest.raises(ValueError, match="'1' lies in pocket 2 already"):
            Judge(POOL, goal, places)
    Judge(POOL, Goal(avoid='1'), places)
    places[0] = POOL.pockets[1, :2]
    with pytest.raises(ValueError, match='^positions: the cue ball lies in pocket 1'):
        Judge(POOL, Goal(keep='2'), places)
