"""A client of what-ifs on the caller's own node, beside an oracle that may come, go, and err."""

import json

import numpy as np
import pytest
from oracle_harness import spin_until
from ros_harness import spinning
from waiting import wait_until

from pool_sim_ros.oracle import what_if
from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import OracleError, WhatIfClient, messages, oracle_interface
from pool_sim_ros.ros import what_if_client as module
from pool_sim_ros.ros.point_cloud import cloud_bytes, read_stamp
from pool_sim_ros.ros.what_if_rows import answer_bytes, candidates_from, no_answer_bytes

TABLE = report_table()


class Stub:
    """An oracle that answers what the test wants."""

    def __init__(self, ros, deaf=False):
        self.node, self.deaf, self.asked = ros.node('stub'), deaf, []
        self.wrong = None
        asked, answer, rejected = (
            oracle_interface.WHAT_IF_REQUEST,
            oracle_interface.WHAT_IF_RESPONSE,
            oracle_interface.WHAT_IF_REJECTED,
        )
        self._answers, self._rejections = (
            self.node.create_publisher(topic.type, topic.of('/stub'), topic.publisher_qos)
            for topic in (answer, rejected)
        )
        self.node.create_subscription(
            asked.type, asked.of('/stub'), self._answer, asked.qos, raw=True
        )

    def _answer(self, message):
        self.asked.append(message)
        if self.deaf:
            return
        stamp, candidates = read_stamp(message), candidates_from(message, 'table')
        if self.wrong and len(candidates) > 1:
            for nonsense in ('', '5', '{"stamp": 5}', '{"stamp": [1]}', json.dumps(self.wrong)):
                self._rejections.publish(messages.to_string(nonsense))
            self._answers.publish(cloud_bytes(stamp, '', np.zeros(2, [('x', '<f4')])))
            rejected = {'stamp': list(stamp), 'code': 'MOVING', 'reason': 'they move'}
            self._answers.publish(no_answer_bytes(stamp, 'table'))
            self._rejections.publish(messages.to_json_string(rejected))
            return
        for _ in range(2):  # a question that was sent twice is answered twice
            outcomes = what_if(TABLE, candidates, threads=1)
            self._answers.publish(answer_bytes(stamp, 'table', TABLE, outcomes))


@pytest.fixture
def asker(ros):
    node = ros.node('asker')
    client = WhatIfClient(node, '/stub')
    with spinning(node):
        yield client


def test_what_is_asked_before_the_oracle_is_there_waits_for_it(ros, asker):
    candidates = [[(-1.0, 0.1 * k)] * (k + 2) for k in range(3)]
    futures = [asker.ask(rows) for rows in candidates]
    with spinning(Stub(ros).node):
        for rows, future in zip(candidates, futures, strict=True):
            assert np.array_equal(spin_until(future).finals, what_if(TABLE, rows).finals)
        wait_until(lambda: asker._timer.is_canceled(), 'the end of looking')


def test_a_rejection_is_an_error_of_the_future(ros, asker, capfd):
    stub = Stub(ros)
    stub.wrong = {'stamp': [1, 2], 'code': 'MOVING', 'reason': 'somebody else was rejected'}
    with spinning(stub.node):
        with pytest.raises(OracleError, match='^MOVING: they move$') as error:
            spin_until(asker.ask([(1.0, 0.0)] * 2))
        assert error.value.code == 'MOVING'
        assert len(spin_until(asker.ask([(1.0, 0.0)])).finals) == 1
    assert 'not understood, and left out' in capfd.readouterr().err


def test_what_nobody_answers_is_asked_again(ros, asker, monkeypatch):
    monkeypatch.setattr(module, 'RESEND', 0.1)
    stub = Stub(ros)
    with spinning(stub.node):
        spin_until(asker.ask([(1.0, 0.0)]))
        stub.deaf = True
        future = asker.ask([(2.0, 0.0)] * 50)
        wait_until(lambda: sum(len(m) > 800 for m in stub.asked) > 2, 'the question again')
        stub.deaf = False
        assert len(spin_until(future).finals) == 50


def test_it_is_taken_off_the_node(ros):
    node = ros.node('asker')
    before = len(list(node.subscriptions)), len(list(node.publishers)), len(list(node.timers))
    client = WhatIfClient(node, '/nobody')
    future = client.ask([(1.0, 0.0)])
    client.close()
    assert future.cancelled()
    after = len(list(node.subscriptions)), len(list(node.publishers)), len(list(node.timers))
    assert before == after


def test_what_is_no_question_is_an_error_at_once(ros):
    client = WhatIfClient(ros.node('asker'), '/nobody')
    with pytest.raises(ValueError, match='^candidates: shape'):
        client.ask([1.0, 2.0])
    assert client._asked == {}
