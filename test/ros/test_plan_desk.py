"""Plans are made one after another, each request is answered once, and nothing is made twice."""

import json
import threading

import numpy as np
import pytest
from waiting import PATIENCE, wait_until

from pool_sim_ros.oracle import find_shots
from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import plan_desk
from pool_sim_ros.ros.oracle_error import OracleError
from pool_sim_ros.ros.plan_desk import PlanDesk
from pool_sim_ros.ros.simulator_view import Lying

GOAL = {'ball': '9', 'to': [0.3, 0.2], 'within': 0.3}
SEARCH = {'goal': GOAL, 'noise': {'speed': 0.05, 'azimuth': 0.2}, 'shots': 2000, 'seed': 5}
TABLE = report_table()


class Client:
    """Sends requests to a desk and keeps what it answers."""

    def __init__(self):
        self.answers, self.plans = [], []
        self.lying = Lying(TABLE, np.array(TABLE.positions))
        self.desk = PlanDesk(
            lambda text: self.answers.append(json.loads(text)),
            self.look,
            lambda plan, lying: self.plans.append((plan, lying)),
            threads=1,
        )

    def look(self):
        if isinstance(self.lying, Exception):
            raise self.lying
        return self.lying

    def ask(self, request_id, **changes):
        self.desk.take(json.dumps({'id': request_id, **SEARCH, **changes}))

    def phases(self, request_id):
        return [a['phase'] for a in self.answers if a['id'] == request_id]

    def wait_for(self, request_id, phase):
        wait_until(lambda: phase in self.phases(request_id), f'{phase} of {request_id}')
        return next(a for a in self.answers if (a['id'], a['phase']) == (request_id, phase))


@pytest.fixture
def client():
    client = Client()
    yield client
    assert client.desk.close(PATIENCE)


@pytest.fixture
def held(monkeypatch):
    """A search waits before its first shot until `go` is set; `begun` counts those that began."""

    class Held:
        go, begun = threading.Event(), 0

    real = find_shots

    def search(*args, on_round, **options):
        def wait(played):
            on_round(played)
            if on_round.__name__ != 'stop':
                Held.begun += played == 0
                assert Held.go.wait(PATIENCE)
                on_round(played)

        return real(*args, on_round=wait, **options)

    monkeypatch.setattr(plan_desk, 'find_shots', search)
    yield Held
    Held.go.set()


def test_a_plan_is_that_of_find_shots(client):
    client.ask('a')
    done = client.wait_for('a', 'done')
    plan = find_shots(TABLE, SEARCH['goal'], SEARCH['noise'], shots=2000, seed=5)
    assert [shot['velocity'] for shot in done['shots']] == [s.velocity.tolist() for s in plan]
    assert [shot['chance'] for shot in done['shots']] == [shot.chance for shot in plan]
    assert len(done['shots']) > 0 and done['played'] == plan.played and not done['cut']
    assert done['positions'] == dict(zip(TABLE.labels, TABLE.positions.tolist(), strict=True))
    assert client.phases('a') == ['accepted', 'progress', 'done']
    wait_until(lambda: client.plans, 'the plan for the markers')


def test_it_starts_from_the_layout_at_which_it_was_accepted(client, held):
    client.ask('a')
    moved = np.array(TABLE.positions)
    moved[9] = [1.8, 0.2]
    client.lying = Lying(TABLE, moved)
    client.ask('b')
    held.go.set()
    a, b = client.wait_for('a', 'done'), client.wait_for('b', 'done')
    assert a['positions']['9'] != [1.8, 0.2] and b['positions']['9'] == [1.8, 0.2]
    assert a['shots'] != b['shots']


def test_a_request_that_comes_again_is_answered_again_and_carried_out_once(client, held):
    for _ in range(3):
        client.ask('a')
    held.go.set()
    client.wait_for('a', 'done')
    client.ask('a')
    assert client.phases('a').count('done') == 2 and held.begun == 1
    first, second = (a for a in client.answers if a['phase'] == 'done')
    assert first == second


def test_an_id_that_was_used_for_something_else_is_rejected(client):
    client.ask('a')
    client.ask('a', seed=6)
    client.wait_for('a', 'done')
    (rejected,) = (a for a in client.answers if a['phase'] == 'rejected')
    assert rejected['code'] == 'ID_REUSED' and 'choose a new one' in rejected['reason']


def test_one_in_the_making_and_one_that_waits_are_cancelled(client, held):
    client.ask('a')
    client.ask('b')
    wait_until(lambda: held.begun, 'the search')
    for request_id in 'ba':
        client.desk.take(json.dumps({'id': request_id, 'cancel': True}))
    assert client.phases('b') == ['accepted', 'cancelled'] and 'cancelled' not in client.phases('a')
    held.go.set()
    assert client.wait_for('a', 'cancelled')['code'] == 'CANCELLED'
    assert 'done' not in client.phases('a')
    client.desk.take('{"id": "a", "cancel": true}')
    assert client.phases('a').count('cancelled') == 2
    client.ask('c')
    client.wait_for('c', 'done')


def test_what_is_done_stays_done_when_somebody_cancels_it(client):
    client.ask('a')
    client.wait_for('a', 'done')
    client.desk.take('{"id": "a", "cancel": true}')
    assert client.phases('a').count('done') == 2 and 'cancelled' not in client.phases('a')


@pytest.mark.parametrize(
    ('changes', 'code', 'words'),
    [
        ({'goal': {'ball': '99', 'pocket': 'any'}}, 'BAD_GOAL', "goal: ball: '99' is not on"),
        ({'goal': {'ball': '9'}}, 'BAD_GOAL', 'is no goal'),
        ({'goal': 5}, 'BAD_GOAL', 'must be a Goal or its fields'),
        ({'goal': {'ball': '9', 'pocket': 0}}, 'BAD_GOAL', 'no pockets'),
        ({'goal': {'ball': '9', 'to': [9.0, 9.0], 'within': 0.1}}, 'BAD_GOAL', 'off the cloth'),
        ({'noise': 'mine'}, 'BAD_NOISE', "noise: 'mine' is none"),
        ({'noise': {'speed': -1.0}}, 'BAD_NOISE', 'noise: speed'),
        ({'noise': [1]}, 'BAD_NOISE', 'noise: '),
        ({'shots': 10}, 'BAD_REQUEST', 'shots: 10 must be at least 1000'),
        ({'shots': 'x'}, 'BAD_REQUEST', 'shots: '),
        ({'shots': 5000.5}, 'BAD_REQUEST', 'shots: '),
        ({'seconds': 0.0}, 'BAD_REQUEST', 'seconds: '),
        ({'seed': -1}, 'BAD_REQUEST', 'seed: '),
        ({'count': 0}, 'BAD_REQUEST', 'count: '),
        ({'speeds': [1.0]}, 'BAD_REQUEST', 'speeds: '),
        ({'speeds': 'ab'}, 'BAD_REQUEST', 'speeds: '),
        ({'offset': 0.3}, 'BAD_REQUEST', 'offset: discs do not spin'),
    ],
)
def test_what_cannot_be_sought_is_rejected_at_once(client, changes, code, words):
    client.ask('a', **changes)
    (answer,) = client.answers
    assert (answer['id'], answer['phase'], answer['code']) == ('a', 'rejected', code)
    assert words in answer['reason'] and '\n' not in answer['reason']


def test_whatever_cannot_be_read_is_rejected_once(client):
    client.desk.take('nonsense')
    client.desk.take('{"id": "a", "what": 5}')
    client.desk.refuse('a message of 9 bytes is no std_msgs/msg/String')
    assert [(a['id'], a['phase'], a['code']) for a in client.answers] == [
        (None, 'rejected', 'BAD_REQUEST'), ('a', 'rejected', 'BAD_REQUEST'),
        (None, 'rejected', 'BAD_REQUEST'),
    ]  # fmt: skip


def test_while_the_balls_move_there_is_no_plan(client):
    client.lying = OracleError('MOVING', 'the balls are moving')
    client.ask('a')
    assert [(a['phase'], a['code']) for a in client.answers] == [('rejected', 'MOVING')]


def test_a_plan_that_nobody_knows_cannot_be_cancelled(client):
    client.desk.take('{"id": "a", "cancel": true}')
    assert [(a['phase'], a['code']) for a in client.answers] == [('rejected', 'UNKNOWN_ID')]


def test_only_so_many_wait(client, held, monkeypatch):
    monkeypatch.setattr(plan_desk, 'MOST_WAITING', 2)
    client.ask('first')
    wait_until(lambda: held.begun, 'the search')
    for request_id in 'abc':
        client.ask(request_id)
    assert client.phases('b') == ['accepted'] and client.phases('c') == ['rejected']
    assert client.answers[-1]['code'] == 'BUSY'


def test_requests_that_are_over_are_forgotten_in_time(client, monkeypatch):
    monkeypatch.setattr(plan_desk, 'REMEMBERED', 3)
    for k in range(9):
        client.ask(f'{k}', noise='none')
    assert len(client.desk._jobs) == 3 and '8' in client.desk._jobs


def test_a_search_that_fails_ends_its_plan_and_no_other(client, monkeypatch, capsys):
    real = find_shots

    def search(*args, seed, **options):
        if seed == 7 and options['on_round'].__name__ != 'stop':
            raise RuntimeError('out of\nmemory')
        return real(*args, seed=seed, **options)

    monkeypatch.setattr(plan_desk, 'find_shots', search)
    client.ask('a', seed=7)
    client.ask('b')
    assert client.wait_for('a', 'cancelled')['reason'] == 'the search failed: out of memory'
    assert client.answers[-1]['code'] in ('FAILED', 'OK')
    client.wait_for('b', 'done')
    assert 'RuntimeError' in capsys.readouterr().err


def test_a_plan_that_cannot_be_drawn_is_done_all_the_same(client, capsys):
    client.plans = None  # so that nothing can be added to it
    client.ask('a')
    client.wait_for('a', 'done')
    client.ask('b')
    client.wait_for('b', 'done')
    assert client.phases('a')[-1] == 'done' and 'AttributeError' in capsys.readouterr().err


def test_none_found_is_an_answer(client):
    client.ask('a', goal={'all': [{'first_hit': '1'}, {'first_hit': '2'}]}, shots=1000)
    done = client.wait_for('a', 'done')
    assert done['shots'] == [] and done['played'] >= 1000
