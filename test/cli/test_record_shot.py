"""The command `record_shot`, read back with the file format's own library."""

import json

import pytest
from process_harness import Process, node_process
from rclpy.serialization import deserialize_message

from pool_sim_ros.me212.log import published_final_positions
from pool_sim_ros.ros import messages
from pool_sim_ros.ros.recorder import TOPICS

pytest.importorskip('rosbags', reason="rosbags is missing: pip install 'pool_sim_ros[record]'")
mcap = pytest.importorskip('mcap.reader', reason='pip install mcap')


@pytest.fixture(scope='module')
def simulator(domain):
    with node_process('--ros-args', '-r', '__node:=filmed') as process:
        yield process.wait_for('ready')


@pytest.fixture(scope='module')
def recording(simulator, tmp_path_factory):
    file = tmp_path_factory.mktemp('recording') / 'shot2.mcap'
    file.write_text('to be replaced')
    args = ['2', '--node', 'filmed', '--out', str(file), '--timeout', '60']
    with Process('cli.record_shot', *args) as process:
        assert process.wait() == 0, process.stderr
        assert str(file) in process.stdout
    assert list(file.parent.iterdir()) == [file]
    return file


def read(file):
    """Return (summary, header, {topic: [message, ...]})."""
    types = {topic.of('/filmed'): topic.type for topic in TOPICS}
    found = {}
    with file.open('rb') as stream:
        reader = mcap.make_reader(stream, validate_crcs=True)
        header, summary = reader.get_header(), reader.get_summary()
        for _, channel, message in reader.iter_messages(log_time_order=True):
            found.setdefault(channel.topic, []).append(
                deserialize_message(message.data, types[channel.topic])
            )
    return summary, header, found


def test_it_is_a_ros_2_recording_with_its_own_definitions(recording):
    summary, header, _ = read(recording)
    assert header.profile == 'ros2'
    channels = {channel.topic: channel for channel in summary.channels.values()}
    assert set(channels) == {topic.of('/filmed') for topic in TOPICS}
    for topic in TOPICS:
        channel = channels[topic.of('/filmed')]
        schema = summary.schemas[channel.schema_id]
        package, _, _ = topic.type.__module__.split('.')
        assert channel.message_encoding == 'cdr' and schema.encoding == 'ros2msg'
        assert schema.name == f'{package}/msg/{topic.type.__name__}'
        definition = schema.data.decode()
        assert all(field in definition for field in topic.type.get_fields_and_field_types())
        assert 'durability' in channel.metadata['offered_qos_profiles']


def test_it_holds_the_whole_shot(recording):
    _, _, found = read(recording)
    kept = {topic.name: found[topic.of('/filmed')] for topic in TOPICS}
    accepted, done = (json.loads(message.data) for message in kept['shot/response'])
    assert (accepted['phase'], done['phase'], done['shot']) == ('accepted', 'done', 2)
    printed = published_final_positions()[2]
    assert {label: tuple(place) for label, place in done['final_positions_in'].items()} == printed
    assert json.loads(kept['shot/request'][0].data)['shot'] == 2
    assert json.loads(kept['table'][0].data)['length'] == 2.2352
    stamps = [messages.from_time(message.header.stamp) for message in kept['ball_poses']]
    first = round(stamps[0] * 60 / 1e9)
    ticks = range(first, first + len(stamps))
    assert stamps == [tick * 1_000_000_000 // 60 for tick in ticks]
    assert stamps[0] <= done['t_start'] * 1e9 and stamps[-1] >= done['t_end'] * 1e9 - 1
    end = messages.from_poses(kept['ball_poses'][-1])
    assert end.tolist() == list(done['final_positions'].values())
    contacts = sum(len(messages.from_rows(message)) for message in kept['collisions'])
    assert 0 < contacts < done['events']
    shown = {marker.ns for array in kept['markers'] for marker in array.markers}
    assert {'table', 'balls', 'labels', 'trails', 'flashes'} <= shown


@pytest.mark.parametrize(
    ('args', 'words'),
    [
        (['5', '--timeout', '60'], 'UNKNOWN_SHOT'),
        (['1', '--out', 'shot.bag'], '.mcap'),
        (['1', '--out', '/no/such/folder/shot.mcap'], '/no/such/folder'),
        (['1', '--node', '/nobody', '--timeout', '0.2'], '/nobody'),
    ],
)
def test_what_goes_wrong_is_one_clear_line_and_status_1(simulator, tmp_path, args, words):
    out = [] if '--out' in args else ['--out', str(tmp_path / 'shot.mcap')]
    with Process('cli.record_shot', '--node', 'filmed', *args, *out) as process:
        assert process.wait() == 1
        assert words in process.stderr and process.stderr.count('\n') == 1
    assert list(tmp_path.iterdir()) == []


def test_interrupted_it_leaves_nothing_behind(ros, tmp_path):
    watcher = ros.node()
    named = ['--ros-args', '-r', '__node:=slow']
    with node_process(*named, real_time_factor=0.01) as node:
        node.wait_for('ready')
        out = str(tmp_path / 'shot.mcap')
        with Process('cli.record_shot', '1', '--node', 'slow', '--out', out) as process:
            ros.spin_until(lambda: watcher.count_subscribers('/slow/collisions'), 'the recorder')
            process.interrupt()
            assert process.wait() == 130
            assert process.stderr.count('\n') == 1
    assert list(tmp_path.iterdir()) == []
