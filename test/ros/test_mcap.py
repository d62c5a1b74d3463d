"""A file of recorded messages, read back with the file format's own library."""

import pytest
from rclpy.serialization import deserialize_message, serialize_message

from pool_sim_ros.ros import interface, messages, write_bag
from pool_sim_ros.ros.recorder import Recorded

pytest.importorskip('rosbags', reason='pip install rosbags')
mcap = pytest.importorskip('mcap.reader', reason='pip install mcap')


def recorded(time, topic, text):
    data = serialize_message(messages.to_string(text))
    return Recorded(time, topic, topic.of('/left'), data)


MESSAGES = [
    recorded(1_000, interface.TABLE, '{}'),
    recorded(2_000, interface.SHOT_REQUEST, '1'),
    recorded(3_000, interface.SHOT_RESPONSE, 'accepted'),
    recorded(4_000, interface.SHOT_RESPONSE, 'done'),
]


def test_messages_come_back_with_their_times_topics_and_bytes(tmp_path):
    file = tmp_path / 'shot.mcap'
    write_bag(file, iter(MESSAGES))
    with file.open('rb') as stream:
        reader = mcap.make_reader(stream, validate_crcs=True)
        found = [
            (message.log_time, channel.topic, message.data)
            for _, channel, message in reader.iter_messages(log_time_order=True)
        ]
    assert found == [(m.time, m.name, m.data) for m in MESSAGES]
    assert deserialize_message(found[-1][2], interface.SHOT_RESPONSE.type).data == 'done'
    assert list(tmp_path.iterdir()) == [file]


def test_what_was_latched_is_marked_so(tmp_path):
    file = tmp_path / 'shot.mcap'
    write_bag(file, MESSAGES)
    with file.open('rb') as stream:
        channels = mcap.make_reader(stream).get_summary().channels.values()
    qos = {c.topic: c.metadata['offered_qos_profiles'] for c in channels}
    assert 'transient_local' in qos['/left/table'] and 'volatile' in qos['/left/shot/request']
    assert 'depth: 1000' in qos['/left/shot/response']


def test_a_failure_leaves_the_file_that_was_there(tmp_path):
    file = tmp_path / 'shot.mcap'
    file.write_text('precious')

    def broken():
        yield MESSAGES[0]
        raise RuntimeError('the disk is full')

    with pytest.raises(RuntimeError):
        write_bag(file, broken())
    assert file.read_text() == 'precious' and list(tmp_path.iterdir()) == [file]


def test_a_folder_that_is_not_there_is_an_os_error(tmp_path):
    with pytest.raises(OSError):
        write_bag(tmp_path / 'none' / 'shot.mcap', MESSAGES)
