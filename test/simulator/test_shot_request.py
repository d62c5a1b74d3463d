import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pool_sim_ros.simulator.shot_request import (
    MAX_ID_LENGTH,
    MAX_REQUEST_LENGTH,
    Code,
    Phase,
    Response,
    parse_request,
    twist_request,
)


@pytest.mark.parametrize('text', ['3', ' 3\n', '+3', '{"shot": 3}'])
def test_shot_number_is_read(text):
    request = parse_request(text)
    assert (request.code, request.shot, request.velocity, request.id) == (Code.OK, 3, None, None)


def test_json_with_an_id_is_read():
    request = parse_request('{"id": "a-1", "velocity": [-4, 0.5]}')
    assert request.code is Code.OK
    assert (request.id, request.velocity, request.shot) == ('a-1', (-4.0, 0.5), None)


@pytest.mark.parametrize('text', ['0', '5', '-1', '44', '{"shot": 0}', '{"shot": 5}', '9' * 4000])
def test_shot_that_the_report_has_not_is_unknown(text):
    request = parse_request(text)
    assert request.code is Code.UNKNOWN_SHOT
    assert '1 to 4' in request.reason and len(request.reason) < 200


@pytest.mark.parametrize(
    ('text', 'word'),
    [
        ('', 'shot number'),
        ('x', '"x"'),
        ('1.0', '1.0'),
        ('[1]', 'JSON object'),
        ('null', 'JSON object'),
        ('{"shot": 1', 'JSON'),
        ('{"shot": 1, "speed": 2}', '"speed"'),
        ('{"shot": 1, "shot": 2}', 'twice'),
        ('{"shot": 1, "velocity": [1, 0]}', 'either'),
        ('{}', 'either'),
        ('{"shot": true}', 'integer'),
        ('{"shot": "1"}', 'integer'),
        ('{"shot": 1.0}', 'integer'),
        ('{"velocity": 4}', 'two numbers'),
        ('{"velocity": [1]}', 'two numbers'),
        ('{"velocity": [1, 0, 0]}', 'two numbers'),
        ('{"velocity": ["1", 0]}', 'two numbers'),
        ('{"velocity": [true, false]}', 'two numbers'),
        ('{"id": 7, "shot": 1}', 'id'),
        ('{"id": "", "shot": 1}', 'id'),
        ('{"id": null, "shot": 1}', 'id'),
        (json.dumps({'id': 'i' * (MAX_ID_LENGTH + 1), 'shot': 1}), str(MAX_ID_LENGTH)),
        ('x' * 1_000_000, '1000000'),
        (' ' * MAX_REQUEST_LENGTH + '1', str(MAX_REQUEST_LENGTH)),
        ('[' * MAX_REQUEST_LENGTH, 'JSON'),
        ('{"a":' * 800, 'JSON'),
    ],
)
def test_unreadable_request_is_bad_and_the_reason_says_what(text, word):
    request = parse_request(text)
    assert request.code is Code.BAD_REQUEST
    assert request.id is None
    assert word in request.reason
    assert '\n' not in request.reason and len(request.reason) < 200


def test_id_is_kept_where_only_the_rest_is_bad():
    assert parse_request('{"id": "a", "shoot": 1}').id == 'a'
    assert parse_request('{"id": "a", "shot": 9}').id == 'a'
    assert parse_request('{"id": "a", "velocity": [NaN, 0]}').id == 'a'


@pytest.mark.parametrize(
    'velocity',
    [
        '[0, 0]',
        '[0.0, -0.0]',
        '[NaN, 0]',
        '[Infinity, 0]',
        '[0, -Infinity]',
        '[1e999, 1]',
        '[1' + '0' * 400 + ', 0]',
        '[0, -1' + '0' * 400 + ']',
    ],
)
def test_velocity_that_strikes_nothing_is_bad(velocity):
    request = parse_request(f'{{"velocity": {velocity}}}')
    assert request.code is Code.BAD_VELOCITY
    assert 'velocity' in request.reason


@given(st.text())
def test_any_text_is_read_or_refused_with_a_reason(text):
    request = parse_request(text)
    assert (request.code is Code.OK) == (request.reason is None)


def test_twist_is_a_velocity():
    request = twist_request((-4.0, 0.5, 0.0), (0.0, -0.0, 0.0))
    assert (request.code, request.velocity) == (Code.OK, (-4.0, 0.5))


@pytest.mark.parametrize(
    ('linear', 'angular', 'name'),
    [
        ((1.0, 0.0, 1e-300), (0.0, 0.0, 0.0), 'linear.z'),
        ((1.0, 0.0, math.nan), (0.0, 0.0, 0.0), 'linear.z'),
        ((1.0, 0.0, 0.0), (0.1, 0.0, 0.0), 'angular.x'),
        ((1.0, 0.0, 0.0), (0.0, math.inf, 0.0), 'angular.y'),
        ((1.0, 0.0, 0.0), (0.0, 0.0, -2.0), 'angular.z'),
        ((math.nan, 0.0, 0.0), (0.0, 0.0, 0.0), 'finite'),
        ((0.0, -math.inf, 0.0), (0.0, 0.0, 0.0), 'finite'),
        ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 'zero'),
    ],
)
def test_twist_with_anything_else_is_bad(linear, angular, name):
    request = twist_request(linear, angular)
    assert request.code is Code.BAD_VELOCITY
    assert name in request.reason


def test_content_tells_requests_apart_but_not_their_spelling():
    same = parse_request('{"id": "a", "velocity": [1, 0]}')
    spelt = parse_request(' {"velocity":[1.0,0.0],"id":"a"}')
    other = parse_request('{"id": "a", "velocity": [1, 0.1]}')
    nan = parse_request('{"id": "a", "velocity": [NaN, 0]}')
    assert same.content == spelt.content != other.content
    assert nan.content == parse_request('{"id": "a", "velocity": [NaN, 0]}').content
    assert parse_request('{"shot": 1}').content == parse_request('1').content
    assert parse_request('{"id": "a", "x": 1}').content != parse_request('{"id": "a"}').content


def test_response_is_json_with_every_key():
    response = json.loads(Response(id='a', phase=Phase.REJECTED, code=Code.BUSY).to_json())
    assert list(response) == [
        'id',
        'phase',
        'code',
        'reason',
        'shot',
        'velocity',
        'integrator',
        't_start',
        't_end',
        'events',
        'final_positions',
        'final_positions_in',
        'as_printed',
        'spin',
        'cue',
        'place',
        'pocketed',
    ]
    assert (response['phase'], response['code'], response['t_end']) == ('rejected', 'BUSY', None)
