"""Shots that a client asks for, and what it says when they go wrong."""

import json
import time
from concurrent.futures import ThreadPoolExecutor
from itertools import count, cycle, islice

import numpy as np
import pytest
from ros_harness import Observer, spinning
from waiting import wait_until

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.ros import ShotClient, SimulatorError, interface, messages
from pool_sim_ros.ros.client import IDLE_STATES
from pool_sim_ros.simulator import Phase, Response, read_log, table_from_json

PATIENCE = 60.0
FAST = {'report_integrator': 'event', 'real_time_factor': 4.0}


@pytest.fixture
def make_client(ros):
    """Make clients that are closed in the end."""
    made = []

    def make(*args, **options):
        made.append(ShotClient(ros.context, *args, **options))
        return made[-1]

    yield make
    for client in made:
        client.close()


def test_a_shot_is_played_to_the_end_that_the_physics_gives(ros, make_client):
    with spinning(ros.sim_node(**FAST)):
        client = make_client()
        assert client.simulator == '/pool_sim'
        client.wait_for_simulator(PATIENCE)
        accepted, told = [], []
        done = client.play(
            velocity=(-3.0, 0.4),
            timeout=PATIENCE,
            on_accepted=accepted.append,
            on_progress=told.append,
        )
        shot = simulate(report_table(), (-3.0, 0.4))
        assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)
        assert [response['phase'] for response in accepted] == ['accepted']
        assert accepted[0]['id'] == done['id']
        assert any(words.endswith(('1 ball moves', 'balls move')) for words in told)
        again = client.play(3, timeout=PATIENCE)
        assert again['shot'] == 3 and again['id'] != done['id']


def test_it_knows_the_table(ros, make_client):
    with spinning(ros.sim_node('small', table_length=1.9)):
        client = make_client('small')
        assert table_from_json(client.table_json(PATIENCE)).length == 1.9


def test_a_shot_that_is_rejected(ros, make_client):
    with spinning(ros.sim_node(**FAST)):
        client = make_client()
        client.wait_for_simulator(PATIENCE)
        accepted = []
        with pytest.raises(SimulatorError, match=r'^rejected \(UNKNOWN_SHOT\): .*7'):
            client.play(7, timeout=PATIENCE, on_accepted=accepted.append)
        assert accepted == []


def test_a_shot_that_is_preempted(ros, make_client):
    with spinning(ros.sim_node(real_time_factor=0.1)) as node:
        client = make_client()
        client.wait_for_simulator(PATIENCE)
        with pytest.raises(SimulatorError, match=r'^preempted \(RESET\): '):
            client.play(1, timeout=PATIENCE, on_accepted=lambda _: node.runner.reset())


def test_nobody_is_there(make_client):
    client = make_client('hall/left')
    with pytest.raises(SimulatorError, match=r'no simulator answers as /hall/left .*0\.05 s'):
        client.wait_for_simulator(0.05)
    with pytest.raises(SimulatorError, match='announced no table within 0.05 s'):
        client.table_json(0.05)
    with pytest.raises(SimulatorError, match='did not answer the request within 0.05 s'):
        client.play(1, timeout=0.05)


def test_a_simulator_that_is_known_to_be_gone_is_not_waited_for(make_client):
    client = make_client(has_ended=lambda: True)
    start = time.monotonic()
    with pytest.raises(SimulatorError, match='has ended'):
        client.wait_for_simulator(PATIENCE)
    assert time.monotonic() - start < PATIENCE / 2


class Stub:
    """Accepts a request, and then only sends states in which nothing goes on, of these ticks."""

    def __init__(self, ros, ticks=()):
        self.node = ros.node('stub')
        self._ticks = iter(ticks)
        self._responses = self._publisher(interface.SHOT_RESPONSE)
        self._states = self._publisher(interface.STATE)
        topic = interface.SHOT_REQUEST
        self.node.create_subscription(topic.type, topic.of('stub'), self._accept, topic.qos)

    def _publisher(self, topic):
        return self.node.create_publisher(topic.type, topic.of('stub'), topic.qos)

    def _accept(self, request):
        asked = json.loads(request.data)['id']
        response = Response(asked, Phase.ACCEPTED, velocity=(-4.0, 0.0), integrator='event')
        self._responses.publish(messages.to_string(response.to_json()))
        self._timer = self.node.create_timer(0.02, self._send_state)

    def _send_state(self):
        for tick in islice(self._ticks, 1):
            state = {'paused': False, 'moving': False, 'computing': False, 'tick': tick}
            self._states.publish(messages.to_json_string(state))


def play_on_stub(client):
    client.wait_for_simulator(PATIENCE)
    client.play(1, timeout=1.0)


def test_a_simulator_that_falls_silent(ros, make_client):
    with spinning(Stub(ros).node):
        with pytest.raises(SimulatorError, match=r'^/stub fell silent 1 s ago'):
            play_on_stub(make_client('stub'))


def test_a_simulator_that_has_forgotten_the_shot(ros, make_client):
    with spinning(Stub(ros, count()).node):
        with pytest.raises(SimulatorError, match=r'^/stub knows nothing of this shot any more'):
            play_on_stub(make_client('stub'))


def test_states_of_the_same_tick_do_not_make_a_shot_forgotten(ros, make_client):
    with spinning(Stub(ros, [5] * (2 * IDLE_STATES)).node):
        with pytest.raises(SimulatorError, match=r'^/stub fell silent'):
            play_on_stub(make_client('stub'))


class Bystander:
    """Somebody else who subscribes to the requests of a simulator, as a recorder does."""

    def __init__(self, ros, simulator=interface.NODE_NAME):
        self.node = ros.node('bystander')
        self.heard = []
        topic = interface.SHOT_REQUEST
        self.node.create_subscription(
            topic.type, topic.of(simulator), lambda request: self.heard.append(request.data), 1000
        )


def test_a_request_that_only_a_bystander_heard_is_sent_again_and_played_once(
    ros, make_client, tmp_path
):
    log = tmp_path / 'session.log'
    bystander = Bystander(ros)
    client = make_client()
    with spinning(bystander.node), ThreadPoolExecutor() as pool:
        playing = pool.submit(client.play, velocity=(-3.0, 0.4), timeout=PATIENCE)
        wait_until(lambda: bystander.heard, 'the request that is lost')
        node = ros.sim_node(**FAST, record=str(log))
        with spinning(node):
            done = playing.result(PATIENCE)
        node.runner.stop(PATIENCE)
    assert np.array_equal(
        list(done['final_positions'].values()),
        simulate(report_table(), (-3.0, 0.4)).final_positions,
    )
    assert len(bystander.heard) > 1 and len(set(bystander.heard)) == 1
    assert [command['command'] for command in read_log(log)[1]] == ['strike', 'end']


def test_a_request_that_comes_many_times_is_played_once(ros, tmp_path):
    log = tmp_path / 'session.log'
    node = ros.sim_node(**FAST, record=str(log))
    observer = Observer(ros).wait_for_match()
    request = '{"id": "again", "velocity": [-3.0, 0.4]}'
    for _ in range(5):
        observer.request(request)
    observer.wait_for_phase('again', 'done')
    for _ in range(5):
        observer.request(request)
    ros.spin_until(lambda: observer.phases('again').count('done') == 6, 'the same answers')
    assert set(observer.phases('again')) == {'accepted', 'done'}
    node.runner.stop(PATIENCE)
    assert [command['command'] for command in read_log(log)[1]] == ['strike', 'end']


def test_bystanders_alone_are_no_simulator(ros, make_client):
    bystander = Bystander(ros)
    client = make_client()
    with spinning(bystander.node):
        wait_until(client._requests.get_subscription_count, 'the bystander')
        with pytest.raises(SimulatorError, match='no simulator answers'):
            client.wait_for_simulator(0.5)
        with pytest.raises(SimulatorError, match=r'did not answer the request within 2\.5 s'):
            client.play(1, timeout=2.5)
    assert len(bystander.heard) >= 2


class Fool:
    """Sends foreign texts on the topics that a client reads, again and again."""

    TEXTS = (
        '', '5', 'null', '[]', '{}', '[' * 100_000, '{"id": NaN}', '9' * 5000, '"x"',
        'x' * 2_000_000,
        '{"phase": "done"}', '{"phase": "accepted", "id": 5, "code": "OK"}',
        '{"paused": 1, "moving": 2}', '{"tick": 1e999, "paused": false}',
    )  # fmt: skip

    def __init__(self, ros, simulator=interface.NODE_NAME):
        self.node = ros.node('fool')
        topics = (interface.STATE, interface.SHOT_RESPONSE, interface.TABLE)
        self._publishers = [
            self.node.create_publisher(topic.type, topic.of(simulator), topic.qos)
            for topic in topics
        ]
        rows = interface.BALL_VELOCITIES
        self._rows = self.node.create_publisher(rows.type, rows.of(simulator), rows.qos)
        self._texts = cycle(self.TEXTS)
        self.node.create_timer(0.02, self.send)

    def send(self):
        text = next(self._texts)
        for publisher in self._publishers:
            publisher.publish(messages.to_string(text))
        self._rows.publish(interface.BALL_VELOCITIES.type(data=[1.0]))


def test_foreign_messages_are_left_out_with_a_line_now_and_then(ros, make_client, capfd):
    fool = Fool(ros)
    with spinning(ros.sim_node(report_integrator='event', real_time_factor=1.0)):
        client = make_client()
        client.wait_for_simulator(PATIENCE)
        wait_until(lambda: all(p.get_subscription_count() for p in fool._publishers[:2]), 'a match')
        start = time.monotonic()
        with spinning(fool.node):
            done = client.play(1, timeout=PATIENCE, on_progress=lambda words: None)
            assert table_from_json(client.table_json(PATIENCE)) == report_table()
        took = time.monotonic() - start
    assert done['shot'] == 1
    lines = [line for line in capfd.readouterr().err.splitlines() if 'left out' in line]
    assert 1 <= len(lines) <= took + 2
    assert all(len(line) < 500 for line in lines)
