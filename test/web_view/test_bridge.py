"""The page's server as a client of a simulator."""

import asyncio
import json

import pytest
from ros_harness import spinning
from waiting import PATIENCE

from pool_sim_ros.ros import interface, messages
from pool_sim_ros.web_view import bridge as module
from pool_sim_ros.web_view.bridge import Bridge, NoAnswerError


class Listener:
    """Keeps what it is told; a text that is no JSON makes no sense to it."""

    def __init__(self):
        self.told = []
        self.loops = set()

    def _keep(self, kind, content):
        self.loops.add(asyncio.get_running_loop())
        self.told.append((kind, content))

    def on_collisions(self, message):
        self._keep('collisions', messages.from_rows(message))

    def on_response(self, message):
        self._keep('response', json.loads(message.data))

    def on_state(self, message):
        self._keep('state', json.loads(message.data))

    def on_table(self, message):
        self._keep('table', json.loads(message.data))

    def all(self, kind):
        return [content for told, content in self.told if told == kind]


async def until(condition, what):
    async def poll():
        while not condition():
            await asyncio.sleep(0.01)

    try:
        await asyncio.wait_for(poll(), PATIENCE)
    except asyncio.TimeoutError:
        raise AssertionError(f'waited {PATIENCE:g} s for {what}') from None


def run(ros, use, simulator='pool_sim'):
    """Run `use` in a loop with a bridge and a listener."""

    async def within():
        listener = Listener()
        bridge = Bridge(ros.context, simulator, listener)
        try:
            return await use(bridge, listener)
        finally:
            bridge.close()

    return asyncio.run(within())


@pytest.fixture
def node(ros):
    with spinning(ros.sim_node(report_integrator='event', real_time_factor=10.0)) as node:
        yield node


def test_a_request_is_answered_and_everything_is_told_within_the_loop(ros, node):
    async def use(bridge, listener):
        assert bridge.simulator == '/pool_sim'
        await until(bridge.is_matched, 'the simulator')
        await bridge.request(shot=3)
        await until(lambda: len(listener.all('response')) == 2, 'the end')
        await until(lambda: bridge.latest_poses() is not None, 'the poses')
        assert listener.loops == {asyncio.get_running_loop()}
        return listener

    listener = run(ros, use)
    accepted, done = listener.all('response')
    assert (accepted['phase'], done['phase'], done['shot']) == ('accepted', 'done', 3)
    assert accepted['id'] == done['id']
    assert listener.all('table') and listener.all('state') and listener.all('collisions')


def test_responses_of_the_past_are_not_told(ros, node):
    node.runner.request('{"id": "past", "shot": 9}')

    async def use(bridge, listener):
        await until(bridge.is_matched, 'the simulator')
        await until(lambda: listener.all('table'), 'what is latched')
        await bridge.request(shot=9)
        await until(lambda: listener.all('response'), 'the answer')
        return [response['id'] for response in listener.all('response')]

    [answered] = run(ros, use)
    assert answered != 'past'


def test_services_and_parameters_say_whether_it_was_done(ros, node):
    async def use(bridge, listener):
        await until(bridge.is_matched, 'the simulator')
        return [
            await bridge.call(interface.SET_PAUSED, data=True),
            await bridge.call(interface.SET_PAUSED, data=False),
            await bridge.call(interface.STEP),
            await bridge.set_parameter('real_time_factor', 2.0),
            await bridge.set_parameter('real_time_factor', -1.0),
        ]

    paused, resumed, stepped, changed, refused = run(ros, use)
    assert paused == (True, 'paused') and resumed == (True, 'playing')
    assert not stepped[0] and 'paused' in stepped[1]
    assert changed == (True, '')
    assert not refused[0] and 'real_time_factor' in refused[1]
    assert node.get_parameter('real_time_factor').value == 2.0


def test_nobody_answers(ros):
    async def use(bridge, listener):
        assert not bridge.is_matched() and bridge.latest_poses() is None
        with pytest.raises(NoAnswerError, match='^/hall/nobody does not answer'):
            await bridge.call(interface.RESET)
        with pytest.raises(NoAnswerError):
            await bridge.set_parameter('real_time_factor', 1.0)

    run(ros, use, '/hall/nobody')


def test_a_simulator_that_hears_and_does_not_answer_is_given_up(ros, monkeypatch):
    monkeypatch.setattr(module, 'PATIENCE', 0.05)
    mute = ros.node('mute')  # nobody spins it
    service = interface.RESET
    mute.create_service(service.type, service.of('mute'), lambda _, response: response)

    async def use(bridge, listener):
        client = bridge._clients[service]
        await until(client.service_is_ready, 'the service')
        with pytest.raises(NoAnswerError, match='^/mute does not answer'):
            await bridge.call(service)
        assert not client._pending_requests

    run(ros, use, 'mute')


def test_what_makes_no_sense_is_left_out_and_the_rest_goes_on(ros):
    topic = interface.STATE
    publisher = ros.node('mad').create_publisher(topic.type, topic.of('mad'), topic.qos)

    async def use(bridge, listener):
        await until(publisher.get_subscription_count, 'the bridge')
        left_out = []
        bridge.left_out = left_out.append
        publisher.publish(messages.to_string('{'))
        await until(lambda: left_out, 'the complaint')
        publisher.publish(messages.to_string('{"tick": 1}'))
        await until(lambda: listener.all('state'), 'the state')
        assert isinstance(left_out[0], ValueError)
        return listener.all('state')

    assert run(ros, use, 'mad') == [{'tick': 1}]


def test_a_request_is_sent_again_until_it_is_answered(ros, monkeypatch):
    """A recorder hears the first one; the simulator only starts then."""
    monkeypatch.setattr(module, 'RESEND', 0.1)
    monkeypatch.setattr(module, 'PATIENCE', PATIENCE)
    topic, heard = interface.SHOT_REQUEST, []
    recorder = ros.node('recorder')
    recorder.create_subscription(
        topic.type, topic.of('pool_sim'), lambda request: heard.append(request.data), topic.qos
    )

    async def use(bridge, listener):
        asking = asyncio.create_task(bridge.request(shot=3))
        await until(lambda: len(heard) >= 2, 'the request that is lost')
        assert not asking.done()
        with spinning(ros.sim_node(report_integrator='event', real_time_factor=10.0)):
            await asking
            await until(
                lambda: 'done' in [response['phase'] for response in listener.all('response')],
                'the end',
            )
        return listener.all('response')

    with spinning(recorder):
        responses = run(ros, use)
    assert len(set(heard)) == 1 and len({response['id'] for response in responses}) == 1


def test_a_request_that_nobody_answers_is_given_up(ros, monkeypatch):
    monkeypatch.setattr(module, 'RESEND', 0.05)
    monkeypatch.setattr(module, 'PATIENCE', 0.2)

    async def use(bridge, listener):
        with pytest.raises(NoAnswerError, match='^/hall/nobody does not answer'):
            await bridge.request(shot=3)
        assert bridge._asked == {}

    run(ros, use, '/hall/nobody')


@pytest.mark.parametrize(
    'text', ['', '5', '[]', '[' * 100_000, '{"id": {}}', 'NaN', '9' * 5000], ids=range(7)
)
def test_a_foreign_response_is_left_out_and_the_rest_goes_on(ros, node, text):
    topic = interface.SHOT_RESPONSE
    publisher = ros.node('fool').create_publisher(topic.type, topic.of('pool_sim'), topic.qos)

    async def use(bridge, listener):
        await until(bridge.is_matched, 'the simulator')
        await until(publisher.get_subscription_count, 'the bridge')
        left_out = []
        bridge.left_out = left_out.append
        publisher.publish(messages.to_string(text))
        await until(lambda: left_out, 'the complaint')
        await bridge.request(shot=9)
        return left_out, listener.all('response')

    left_out, responses = run(ros, use)
    assert len(left_out) == 1 and len(str(left_out[0])) < 300
    assert [response['code'] for response in responses] == ['UNKNOWN_SHOT']
