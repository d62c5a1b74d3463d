"""What a recorder keeps, and how long it waits for it."""

import json

import pytest
from rclpy.serialization import deserialize_message
from ros_harness import spinning

from pool_sim_ros.ros import Recorder, ShotClient, SimulatorError, interface, messages
from pool_sim_ros.ros.recorder import TOPICS

PATIENCE = 60.0


@pytest.fixture
def played(ros):
    """A recorder that listened to shot 3, the second shot played, and the last response."""
    with spinning(ros.sim_node('filmed', report_integrator='event', real_time_factor=10.0)):
        client = ShotClient(ros.context, 'filmed')
        client.wait_for_simulator(PATIENCE)
        client.play(2, timeout=PATIENCE)
        recorder = Recorder(ros.context, 'filmed')
        try:
            recorder.wait_for_topics(PATIENCE)
            response = client.play(3, timeout=PATIENCE)
            recorder.wait_for_end(response, PATIENCE)
        finally:
            recorder.close()
            client.close()
    return recorder, response


def read(recorder, topic):
    kept = [message for message in recorder.messages if message.topic is topic]
    return [deserialize_message(message.data, topic.type) for message in kept]


def test_every_topic_is_kept_as_bytes_under_its_full_name_in_order(played):
    recorder, _ = played
    assert {message.topic.name for message in recorder.messages} == {t.name for t in TOPICS}
    assert all(m.name == f'/filmed/{m.topic.name}' for m in recorder.messages)
    times = [message.time for message in recorder.messages]
    assert times == sorted(times) and all(type(m.data) is bytes for m in recorder.messages)


def test_the_shot_is_whole_and_those_before_it_are_not_there(played):
    recorder, response = played
    answers = [json.loads(answer.data) for answer in read(recorder, interface.SHOT_RESPONSE)]
    assert [answer['phase'] for answer in answers] == ['accepted', 'done']
    assert answers[-1] == response
    stamps = [
        messages.from_time(poses.header.stamp) for poses in read(recorder, interface.BALL_POSES)
    ]
    assert stamps[0] <= response['t_start'] * 1e9 and stamps[-1] >= response['t_end'] * 1e9 - 1
    end = messages.from_poses(read(recorder, interface.BALL_POSES)[-1])
    assert end.tolist() == list(response['final_positions'].values())


def test_a_simulator_that_is_not_there(ros):
    recorder = Recorder(ros.context, '/nobody')
    try:
        with pytest.raises(SimulatorError, match='^/nobody did not publish all its topics within'):
            recorder.wait_for_topics(0.05)
        response = {'id': 'x', 'phase': 'done', 't_end': 1.0}
        with pytest.raises(SimulatorError, match='^/nobody did not send the end of the shot'):
            recorder.wait_for_end(response, 0.05)
    finally:
        recorder.close()
    assert recorder.messages == []


def test_every_topic_that_shows_a_shot_is_recorded():
    assert {topic.name for topic in TOPICS} >= {
        topic.name
        for topic in vars(interface).values()
        if isinstance(topic, interface.Topic) and topic.name.startswith(('ball', 'shot', 'coll'))
    }


def test_foreign_messages_are_recorded_and_do_no_harm(ros, capfd):
    """Texts that are no responses, and bytes that are no messages."""
    node = ros.node('fool')
    topics = (interface.SHOT_RESPONSE, interface.STATE, interface.BALL_POSES)
    responses, states, poses = (
        node.create_publisher(topic.type, topic.of('filmed'), topic.qos) for topic in topics
    )

    def send():
        for text in ('5', '', '[' * 100_000, '{"id": NaN}', '{"phase": "done"}', '9' * 5000):
            responses.publish(messages.to_string(text))
            states.publish(messages.to_string(text))
        for data in (b'\0\1\0\0', b'\0\1\0\0' + b'\xff' * 40):
            responses.publish(data)
            poses.publish(data)

    with spinning(ros.sim_node('filmed', report_integrator='event', real_time_factor=5.0)):
        client = ShotClient(ros.context, 'filmed')
        client.wait_for_simulator(PATIENCE)
        recorder = Recorder(ros.context, 'filmed')
        try:
            recorder.wait_for_topics(PATIENCE)
            node.create_timer(0.05, send)
            with spinning(node):
                response = client.play(3, timeout=PATIENCE)
                recorder.wait_for_end(response, PATIENCE)
        finally:
            recorder.close()
            client.close()
    texts = [m.data for m in recorder.messages if m.topic is interface.SHOT_RESPONSE]
    assert sum(b'"phase": "done", "code": "OK"' in text for text in texts) == 1
    assert b'[[[[' in b''.join(texts)
    assert 'left out' in capfd.readouterr().err
