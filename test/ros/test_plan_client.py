"""A client of plans on the caller's own node, beside an oracle that may come, go, and err."""

import json

import pytest
from oracle_harness import spin_until
from ros_harness import spinning
from waiting import wait_until

from pool_sim_ros.oracle import Goal, Noise
from pool_sim_ros.ros import OracleError, PlanClient, messages, oracle_interface
from pool_sim_ros.ros import plan_client as module

GOAL = {'ball': '9', 'to': [0.3, 0.2], 'within': 0.3}


class Stub:
    """An oracle that keeps what it hears and answers what the test wants."""

    def __init__(self, ros):
        self.node, self.heard, self.answers = ros.node('stub'), [], []
        asked, answer = oracle_interface.PLAN_REQUEST, oracle_interface.PLAN_RESPONSE
        self._responses = self.node.create_publisher(answer.type, answer.of('/stub'), answer.qos)
        self.node.create_subscription(asked.type, asked.of('/stub'), self._hear, asked.qos)

    def _hear(self, message):
        request = json.loads(message.data)
        self.heard.append(request)
        for nonsense in ('', '5', '{"phase": "done"}', '{"id": "x", "phase": "done"}'):
            self.tell(nonsense)
        for phase in self.answers:
            response = {'id': request['id'], 'phase': phase, 'code': 'C', 'reason': 'why'}
            self.tell(response | ({'shots': []} if phase == 'done' else {}))

    def tell(self, what):
        text = what if isinstance(what, str) else json.dumps(what)
        self._responses.publish(messages.to_string(text))


@pytest.fixture
def asker(ros, monkeypatch):
    monkeypatch.setattr(module, 'RESEND', 0.1)
    node = ros.node('asker')
    client = PlanClient(node, '/stub')
    with spinning(node):
        yield client


def test_a_request_is_sent_with_one_id_until_it_is_over(ros, asker):
    progress = []
    goal, noise = Goal(ball='9', pocket='any'), Noise(speed=0.1)
    future = asker.plan(goal, noise, shots=5000, seed=3, on_progress=progress.append)
    stub = Stub(ros)
    with spinning(stub.node):
        wait_until(lambda: len(stub.heard) > 2, 'the request again')
        assert not future.done()
        stub.answers = ['accepted', 'progress', 'done']
        assert spin_until(future)['phase'] == 'done'
    (request_id,) = {request.pop('id') for request in stub.heard}
    assert all(request == stub.heard[0] for request in stub.heard)
    assert stub.heard[0] == {
        'goal': {'ball': '9', 'pocket': 'any'}, 'shots': 5000, 'seed': 3,
        'noise': {'speed': 0.1, 'azimuth': 0.0, 'elevation': 0.0, 'side': 0.0, 'above': 0.0,
                  'camera': 0.0},
    }  # fmt: skip
    assert [response['phase'] for response in progress] == ['accepted', 'progress', 'done']
    assert future.result()['id'] == request_id


@pytest.mark.parametrize('phase', ['rejected', 'cancelled'])
def test_what_ends_without_a_plan_is_an_error_of_the_future(ros, asker, phase):
    stub = Stub(ros)
    stub.answers = [phase]
    with spinning(stub.node):
        with pytest.raises(OracleError, match='^C: why$'):
            spin_until(asker.plan(GOAL, 'sjtu'))
        wait_until(lambda: asker._timer.is_canceled(), 'the end of sending')


def test_a_plan_is_cancelled_even_where_the_oracle_has_not_heard_of_it(ros, asker):
    future = asker.plan(GOAL, 'sjtu')
    asker.cancel(future)
    stub = Stub(ros)
    stub.answers = ['rejected']
    with spinning(stub.node), pytest.raises(OracleError):
        spin_until(future)
    assert all(request['cancel'] for request in stub.heard)
    asker.cancel(future)  # which is over: nothing happens


def test_it_is_taken_off_the_node(ros):
    node = ros.node('asker')
    before = len(list(node.subscriptions)), len(list(node.publishers)), len(list(node.timers))
    client = PlanClient(node, '/nobody')
    future = client.plan(GOAL, 'sjtu')
    client.close()
    assert future.cancelled()
    after = len(list(node.subscriptions)), len(list(node.publishers)), len(list(node.timers))
    assert before == after
