"""Requests for plans and their responses as JSON; whatever somebody writes gets one clear line."""

import json

import numpy as np
import pytest

from pool_sim_ros.oracle import Failure, Plan, RankedShot
from pool_sim_ros.ros.oracle_error import OracleCode
from pool_sim_ros.ros.plan_json import (
    LONGEST_REQUEST,
    BadPlanError,
    PlanPhase,
    plan_fields,
    plan_response,
    read_plan_request,
    read_plan_response,
)

GOAL = {'ball': '9', 'to': [0.3, 0.2], 'within': 0.1}
WHOLE = {
    'id': 'a', 'goal': GOAL, 'noise': 'sjtu', 'shots': 1000, 'seconds': 1.5, 'seed': 3,
    'count': 2, 'speeds': [0.5, 4.0], 'offset': 0.3,
}  # fmt: skip


def test_a_request_says_what_find_shots_takes():
    request = read_plan_request(json.dumps(WHOLE))
    assert request.id == 'a' and not request.cancel
    assert request.search == {name: value for name, value in WHOLE.items() if name != 'id'}


def test_a_request_without_an_id_gets_a_new_one():
    text = json.dumps({'goal': GOAL, 'noise': 'sjtu', 'seconds': None})
    one, two = read_plan_request(text), read_plan_request(text)
    assert one.id != two.id and len(one.id) == 32 and 'seconds' not in one.search


def test_equal_requests_have_equal_content_whatever_the_order_of_their_keys():
    turned = dict(reversed(WHOLE.items()))
    assert read_plan_request(json.dumps(WHOLE)).content == (
        read_plan_request(json.dumps(turned, indent=2)).content
    )
    assert read_plan_request(json.dumps(WHOLE | {'seed': 4})).content != (
        read_plan_request(json.dumps(WHOLE)).content
    )


def test_a_request_that_cancels():
    request = read_plan_request('{"cancel": true, "id": "a"}')
    assert request.id == 'a' and request.cancel and request.search == {}


@pytest.mark.parametrize(
    ('text', 'request_id', 'words'),
    [
        ('', None, 'it is not JSON'),
        ('5', None, 'not a JSON object'),
        ('[' * 100_000, None, 'at most 16384 are read'),
        ('[' * 10_000, None, 'nested too deeply|not JSON'),
        ('{"id": "a", "id": "b"}', None, 'given twice'),
        ('{"id": 5}', None, 'id: must be a string'),
        ('{"id": ""}', None, 'id: must be a string of 1 to 128'),
        (json.dumps({'id': 'x' * 129}), None, 'id: must be'),
        ('{"id": "a"}', 'a', 'there is no goal; a plan needs goal and noise'),
        ('{"id": "a", "goal": {}}', 'a', 'there is no noise'),
        ('{"id": "a", "goal": {}, "noise": null}', 'a', 'there is no noise'),
        ('{"id": "a", "goals": {}}', 'a', "unknown key 'goals'; the keys are id, cancel, goal"),
        (json.dumps(WHOLE | {'shots': 10**9}), 'a', r'shots: 1e\+09 must be at most 100000000'),
        (json.dumps(WHOLE | {'count': 101}), 'a', 'count: 101 must be at most 100'),
        ('{"cancel": true}', None, 'cancel: a request that cancels is'),
        ('{"id": "a", "cancel": false}', 'a', 'cancel: a request that cancels is'),
        ('{"id": "a", "cancel": true, "goal": {}}', 'a', 'cancel: a request that cancels is'),
        ('{"id": "\\ud800", "cancel": true}', None, 'half a character'),
    ],
)
def test_what_is_no_request_is_told_why(text, request_id, words):
    with pytest.raises(BadPlanError, match=words) as error:
        read_plan_request(text)
    assert error.value.id == request_id and error.value.code == 'BAD_REQUEST'
    assert '\n' not in str(error.value) and len(str(error.value)) < 400


def test_a_request_may_be_as_long_as_it_is_said():
    text = json.dumps(WHOLE)
    assert read_plan_request(text + ' ' * (LONGEST_REQUEST - len(text))).id == 'a'


def test_a_plan_is_told_with_the_labels_of_the_balls():
    shot = RankedShot(
        velocity=np.array([-1.0, 2.0]),
        spin=None,
        cue=None,
        speed=2.2,
        azimuth=116.0,
        chance=0.5,
        low=0.4,
        high=0.6,
        mean=np.array([[0.1, 0.2], [np.nan, np.nan]]),
        spread=np.array([[0.01, 0.02], [np.nan, np.nan]]),
        caught=np.array([0.0, 1.0]),
        failures=(Failure('ball 9 does not move', 0.5),),
        shots=100,
    )
    fields = plan_fields(Plan([shot], 5000, True), ('C', '9'), np.array([[1.0, 2.0], [3.0, 4.0]]))
    text = plan_response('a', PlanPhase.DONE, **fields)
    response = read_plan_response(text)
    assert (response['id'], response['phase'], response['code']) == ('a', 'done', 'OK')
    assert (response['played'], response['cut']) == (5000, True)
    assert response['positions'] == {'C': [1.0, 2.0], '9': [3.0, 4.0]}
    (told,) = response['shots']
    assert told == {
        'velocity': [-1.0, 2.0], 'spin': None, 'cue': None, 'speed': 2.2, 'azimuth': 116.0,
        'chance': 0.5, 'low': 0.4, 'high': 0.6, 'shots': 100,
        'final_positions': {'C': [0.1, 0.2], '9': None},
        'spread': {'C': [0.01, 0.02], '9': None}, 'caught': {'C': 0.0, '9': 1.0},
        'failures': [{'outcome': 'ball 9 does not move', 'share': 0.5}],
    }  # fmt: skip


@pytest.mark.parametrize(
    'text',
    [
        '', '5', '{}', '{"id": 5, "phase": "progress"}', '{"id": "a", "phase": "x"}',
        '{"phase": "progress"}', '{"id": "a", "phase": []}', '{"id": "a", "phase": "done"}',
        '{"id": "a", "phase": "done", "shots": {}}',
    ],
)  # fmt: skip
def test_foreign_texts_are_no_responses(text):
    with pytest.raises(ValueError):
        read_plan_response(text)


def test_a_response_to_what_could_not_be_read_has_no_id():
    text = plan_response(None, PlanPhase.REJECTED, OracleCode.BAD_REQUEST, reason='why')
    assert read_plan_response(text) == {
        'id': None, 'phase': 'rejected', 'code': 'BAD_REQUEST', 'reason': 'why',
    }  # fmt: skip
