"""What a client takes for a response or a state, and what it does not."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pool_sim_ros.me212 import format_shot
from pool_sim_ros.simulator.heard import LONGEST, response_from_json, state_from_json
from pool_sim_ros.simulator.shot_request import Code, Phase, Response
from pool_sim_ros.simulator.sim_time import seconds_to_stamp

PLACES = {'C': [0.5, 0.25], '1': [1.0, 0.75]}
ACCEPTED = Response('x', Phase.ACCEPTED, velocity=(-4.0, 0.0), integrator='event')
REJECTED = Response(None, Phase.REJECTED, Code.BAD_REQUEST, 'neither a shot number nor JSON')
PREEMPTED = Response('x', Phase.PREEMPTED, Code.RESET, 'the table was reset', 2, (1.0, 0.0))
DONE = Response(
    'x',
    Phase.DONE,
    shot=2,
    velocity=(1.0, 0.0),
    integrator='time_slice',
    t_start=0.5,
    t_end=2.5,
    events=7,
    final_positions=PLACES,
    final_positions_in={label: [x / 0.0254, y / 0.0254] for label, (x, y) in PLACES.items()},
    as_printed=True,
)
STATE = {
    'paused': False,
    'moving': True,
    'computing': False,
    'tick': 3,
    'sim_time': 0.05,
    'real_time_factor': 1.0,
}


@pytest.mark.parametrize('response', [ACCEPTED, REJECTED, PREEMPTED, DONE])
def test_what_the_node_sends_is_taken_as_it_is(response):
    assert response_from_json(response.to_json()) == json.loads(response.to_json())


def test_keys_of_later_versions_are_kept_and_what_need_not_be_there_may_be_missing():
    fields = response_from_json('{"phase": "rejected", "code": "NEW", "reason": "", "wind": [1]}')
    assert fields['wind'] == [1] and fields['id'] is fields['shot'] is fields['t_end'] is None
    state = state_from_json('{"paused": true, "moving": false, "computing": false, "tick": 0}')
    assert state['paused'] is True and 'sim_time' not in state
    assert state_from_json(json.dumps(STATE)) == STATE


FOREIGN = [
    '',
    '5',
    'null',
    '[]',
    '{}',
    'NaN',
    '"done"',
    '{"phase": 1}',
    '[' * 200_000,
    '{"id":' * 200_000,
    '{"tick": NaN}',
    '9' * 5_000,
    '{"id": 5, "id": 6}',
    'x' * (LONGEST + 1),
    '{"paused": "' + 'x' * 5_000_000 + '"}',
]


@pytest.mark.parametrize('read', [response_from_json, state_from_json])
@pytest.mark.parametrize('text', FOREIGN, ids=range(len(FOREIGN)))
def test_foreign_json_is_refused_in_one_short_line(read, text):
    with pytest.raises(ValueError, match='a (response|state)|no (response|state)') as error:
        read(text)
    assert '\n' not in str(error.value) and len(str(error.value)) < 300


def without(name):
    fields = json.loads(DONE.to_json())
    del fields[name]
    return fields


BAD_VALUES = [5, -1.5, 'x', True, [], {}, [[1]], {'C': [1]}, {'C': 'ab'}, [1, True], 1e999]
KINDS = {
    'phase': (),
    'code': ('x',),
    'reason': ('x',),
    'shot': (5,),
    'velocity': (),
    'integrator': ('x',),
    't_start': (5,),
    't_end': (5,),
    'events': (5,),
    'final_positions': ({},),
    'final_positions_in': ({},),
    'as_printed': (True,),
}


@pytest.mark.parametrize('name', KINDS)
def test_a_value_of_another_type_is_refused_by_name(name):
    refused = 0
    for value in BAD_VALUES:
        if any(
            value is good or (value == good and type(value) is type(good)) for good in KINDS[name]
        ):
            continue
        with pytest.raises(ValueError, match=name):
            response_from_json(json.dumps(json.loads(DONE.to_json()) | {name: value}))
        refused += 1
    assert refused >= len(BAD_VALUES) - 1


@pytest.mark.parametrize('name', ['phase', 'code', 'velocity', 't_end', 'final_positions'])
def test_what_a_client_relies_on_must_be_there(name):
    with pytest.raises(ValueError, match=name):
        response_from_json(json.dumps(without(name)))


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('paused', 1),
        ('moving', 'yes'),
        ('computing', None),
        ('tick', 1.5),
        ('tick', True),
        ('sim_time', '1'),
        ('sim_time', float('nan')),
        ('real_time_factor', float('inf')),
        ('real_time_factor', [1.0]),
    ],
)
def test_a_state_of_other_types_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=name):
        state_from_json(json.dumps(STATE | {name: value}))


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=8,
)
GOOD = [json.loads(response.to_json()) for response in (ACCEPTED, REJECTED, PREEMPTED, DONE)]


@given(st.sampled_from([*GOOD, STATE]), st.dictionaries(st.sampled_from([*KINDS, *STATE]), JSON))
def test_whatever_is_taken_is_what_the_clients_use(fields, changes):
    text = json.dumps(fields | changes)
    for read, ours in ((response_from_json, KINDS), (state_from_json, STATE)):
        try:
            taken = read(text)
        except ValueError as error:
            assert '\n' not in str(error) and len(str(error)) < 300
            continue
        json.dumps({name: taken[name] for name in ours if name in taken}, allow_nan=False)
        if ours is KINDS and taken['phase'] == 'done':
            assert seconds_to_stamp(taken['t_end']) >= 0
            x, y = taken['velocity']
            format_shot(taken['shot'], (x, y), taken['final_positions'].items())


@given(st.text(max_size=200))
def test_any_text_is_taken_or_refused(text):
    for read in (response_from_json, state_from_json):
        with pytest.raises(ValueError):
            read(text)
