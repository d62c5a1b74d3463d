"""The command `record_shot`, read back with the file format's own library."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from process_harness import Process, node_process
from rclpy.serialization import deserialize_message

from pool_sim_ros.me212.log import published_final_positions
from pool_sim_ros.me212.shots import cue_velocity
from pool_sim_ros.oracle import read_tracks
from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.recorder import TOPICS

AnyReader = pytest.importorskip('rosbags.highlevel', reason='pip install rosbags').AnyReader
mcap = pytest.importorskip('mcap.reader', reason='pip install mcap')


@pytest.fixture(scope='module')
def simulator(domain):
    with node_process('--ros-args', '-r', '__node:=filmed') as process:
        yield process.wait_for('ready')


@pytest.fixture(scope='module')
def recording(simulator, tmp_path_factory):
    file = tmp_path_factory.mktemp('recording') / 'shot2.mcap'
    file.write_text('to be replaced')
    args = ['2', '--node', 'filmed', '--out', str(file), '--timeout', '60', '--force']
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


def test_the_oracle_reads_its_track(recording):
    (track,) = read_tracks(report_table(), [recording])
    expected = simulate(report_table(), cue_velocity(2, report_table()), integrator='time_slice')
    assert track.times[0] == 0.0 and len(track.times) > 60
    np.testing.assert_allclose(track.positions, expected.positions(track.times), atol=1e-9)


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


@pytest.mark.parametrize('factor', [1.0, 0.0], ids=['real time', 'as fast as possible'])
def test_it_is_stamped_with_sim_time_and_keeps_the_clock(domain, tmp_path, factor):
    file = tmp_path / 'shot.mcap'
    names = ['--ros-args', '-r', '__node:=timed']
    args = ['2', '--node', 'timed', '--out', str(file), '--timeout', '60']
    with node_process(*names, real_time_factor=factor, publish_clock='true'):
        with Process('cli.record_shot', *args) as process:
            assert process.wait() == 0, process.stderr
    types = {topic.of('/timed'): topic.type for topic in (*TOPICS, interface.CLOCK)}
    found = {}
    with AnyReader([file]) as reader:
        for connection, time, data in reader.messages():
            message = deserialize_message(data, types[connection.topic])
            found.setdefault(connection.topic, []).append((time, message))
    poses = found['/timed/ball_poses']
    assert all(time == messages.from_time(message.header.stamp) for time, message in poses)
    assert found['/clock']
    assert all(time == messages.from_time(message.clock) for time, message in found['/clock'])
    answers = [(time, json.loads(m.data)) for time, m in found['/timed/shot/response']]
    (accepted, _), (done, last) = answers
    start, end = (round(last[name] * 1e9) for name in ('t_start', 't_end'))
    every = [time for kept in found.values() for time, _ in kept]
    # A shot of 1.52 s took 0.04 s of wall time.
    assert min(every) <= start and max(every) >= end and end - start > 1_000_000_000
    assert max(every) < end + 60_000_000_000
    (request, _) = found['/timed/shot/request'][0]
    assert request <= accepted <= start and done >= end
    rows = [(time, row) for time, m in found['/timed/collisions'] for row in messages.from_rows(m)]
    assert rows and all(row[1] * 1e9 <= time + 1 for time, row in rows)
    assert all(time - row[1] * 1e9 < 2e9 / 60 for time, row in rows)


def test_a_file_that_is_there_stays_unless_it_may_be_replaced(simulator, tmp_path):
    file = tmp_path / 'shot.mcap'
    file.write_text('precious')
    # Before anything else: there is no such simulator.
    with Process('cli.record_shot', '1', '--node', '/nobody', '--out', str(file)) as process:
        assert process.wait() == 1
        assert process.stderr == (
            f'record_shot: --out: {file} is there already; choose another name, or replace it '
            'with --force\n'
        )
    assert file.read_text() == 'precious'


@pytest.mark.parametrize(
    ('out', 'words'),
    [
        ('', 'argument --out: the name is empty'),
        ('folder.mcap', 'is a folder'),
        ('~/none/shot.mcap', 'there is no folder HOME/none'),
    ],
)
def test_a_name_that_cannot_be_written_is_told_before_the_shot(domain, tmp_path, out, words):
    (tmp_path / 'folder.mcap').mkdir()
    environment = os.environ | {'HOME': str(tmp_path)}
    command = [sys.executable, '-m', 'pool_sim_ros.cli.record_shot', '1', '--node', '/nobody']
    done = subprocess.run(
        [*command, '--out', out],
        capture_output=True,
        text=True,
        timeout=60,
        cwd=tmp_path,
        check=False,
        env=environment | {'PYTHONPATH': os.pathsep.join(filter(None, sys.path))},
    )
    assert done.returncode in (1, 2)
    assert words.replace('HOME', str(tmp_path)) in done.stderr.splitlines()[-1]
