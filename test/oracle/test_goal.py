"""Goals: the keywords that go together, joining, JSON, and what is none."""

import json
import math
import re

import pytest

from pool_sim_ros.oracle import Goal
from pool_sim_ros.oracle.goal import MOST_PARTS, goal_of

FORMS = [
    {'ball': '9', 'to': [0.3, 0.2], 'within': 0.05},
    {'ball': '9', 'rectangle': [0.1, 0.1, 0.5, 0.4]},
    {'ball': '9', 'pocket': 3},
    {'ball': 'C', 'pocket': 'any'},
    {'cue_to': [0.3, 0.2], 'within': 0.1},
    {'first_hit': '9'},
    {'touches': '9'},
    {'avoid': '8'},
    {'keep': 'C'},
    {'all': [{'keep': 'C'}, {'ball': '9', 'pocket': 0}]},
]


@pytest.mark.parametrize('form', FORMS, ids=lambda form: '-'.join(form))
def test_every_form_from_json_and_back(form):
    goal = goal_of(json.loads(json.dumps(form)))
    assert goal == Goal(**form)
    assert json.loads(json.dumps(goal.fields())) == form


def test_joined_goals_are_one_flat_list():
    a, b, c = (Goal(keep=label) for label in 'abc')
    assert (a & b & c).parts == (a & (b & c)).parts == Goal(all=[a, Goal(all=[b, c])]).parts
    assert (a & b & c).parts == (a, b, c)
    assert a.parts == (a,)
    with pytest.raises(TypeError):
        a & 'b'


@pytest.mark.parametrize(
    ('form', 'message'),
    [
        ({}, 'goal: nothing is no goal'),
        ({'ball': '9'}, 'goal: ball is no goal'),
        ({'ball': '9', 'to': (0.1, 0.1)}, 'goal: ball, to is no goal'),
        ({'ball': '9', 'to': (0, 0), 'within': 0.1, 'pocket': 1}, 'is no goal'),
        ({'keep': 'C', 'avoid': '8'}, 'goal: avoid, keep is no goal'),
        ({'ball': 9, 'pocket': 1}, 'goal: ball: 9 must be the label'),
        ({'keep': ''}, "goal: keep: '' must be the label"),
        ({'cue_to': (0.1, math.nan), 'within': 0.1}, 'goal: cue_to: nan is not finite'),
        ({'cue_to': (0.1,), 'within': 0.1}, 'must be 2 numbers'),
        ({'cue_to': '12', 'within': 0.1}, "goal: cue_to: '12' must be 2 numbers"),
        ({'cue_to': (0.1, 0.1), 'within': 0.0}, 'goal: within: 0 must be above 0'),
        ({'cue_to': (0.1, 0.1), 'within': -0.1}, 'goal: within: -0.1 must be above 0'),
        ({'cue_to': (0.1, 0.1), 'within': math.nan}, 'goal: within: nan is not finite'),
        ({'cue_to': (0.1, 0.1), 'within': 'near'}, "goal: within: 'near' is not a number"),
        ({'ball': '9', 'rectangle': (0.5, 0.1, 0.5, 0.4)}, 'is empty'),
        ({'ball': '9', 'rectangle': (0.5, 0.4, 0.1, 0.1)}, 'is empty'),
        ({'ball': '9', 'rectangle': (0.1, 0.1, 0.2)}, 'must be 4 numbers'),
        ({'ball': '9', 'rectangle': (0.1, 0.1, math.inf, 0.2)}, 'inf is not finite'),
        ({'ball': '9', 'pocket': -1}, "goal: pocket: -1 must be the number of a pocket, or 'any'"),
        ({'ball': '9', 'pocket': 1.0}, 'goal: pocket: 1.0 must be'),
        ({'ball': '9', 'pocket': True}, 'goal: pocket: True must be'),
        ({'ball': '9', 'pocket': 'left'}, "goal: pocket: 'left' must be"),
        ({'all': []}, 'goal: all: 0 goals'),
        ({'all': 'keep'}, "goal: all: 'keep' must be a list of goals"),
        ({'all': {'keep': 'C'}}, 'must be a list of goals'),
        ({'all': [5]}, 'goal: 5 must be a Goal or its fields'),
        ({'all': [{'keep': 'C'}] * (MOST_PARTS + 1)}, f'{MOST_PARTS + 1} goals must be'),
    ],
)
def test_what_is_no_goal(form, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        Goal(**form)
    with pytest.raises(ValueError, match=re.escape(message)):
        goal_of(form)


@pytest.mark.parametrize('given', [None, 5, 'keep', ['keep'], {'kep': 'C'}, {3: 'C'}])
def test_what_are_no_fields(given):
    with pytest.raises(ValueError, match='^goal: '):
        goal_of(given)


def test_goals_within_goals_end_somewhere():
    nested = {'keep': 'C'}
    for _ in range(5000):
        nested = {'all': [nested]}
    with pytest.raises(ValueError, match='within one another'):
        goal_of(nested)
    with pytest.raises(ValueError, match='within one another'):
        Goal(**nested)


def test_a_long_value_is_told_in_one_short_line():
    with pytest.raises(ValueError) as caught:
        Goal(keep=['line\n'] * 1000)
    assert len(str(caught.value)) < 200 and '\n' not in str(caught.value)
