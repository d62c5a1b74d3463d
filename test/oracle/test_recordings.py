"""Tracks of recordings: files as `record_shot` writes them, and files of others."""

import json
import math

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle.recordings import read_recording
from pool_sim_ros.physics import simulate

pytest.importorskip('rosbags')
from rosbags.rosbag2 import StoragePlugin, Writer  # noqa: E402
from rosbags.typesys import Stores, get_typestore  # noqa: E402

TABLE = table_of([(0.5, 0.5), (1.0, 0.5)])
TYPES = get_typestore(Stores.ROS2_JAZZY)
POSES, ANSWERS = '/pool_sim/ball_poses', '/pool_sim/shot/response'
SECOND = 1_000_000_000


def poses(stamp, places):
    """Return a frame at a stamp, ns."""
    types = TYPES.types
    time = types['builtin_interfaces/msg/Time'](stamp // SECOND, stamp % SECOND)
    upright = types['geometry_msgs/msg/Quaternion'](0.0, 0.0, 0.0, 1.0)
    point, pose = types['geometry_msgs/msg/Point'], types['geometry_msgs/msg/Pose']
    return types['geometry_msgs/msg/PoseArray'](
        types['std_msgs/msg/Header'](time, 'table'),
        [pose(point(float(x), float(y), 0.05), upright) for x, y in places],
    )


def answer(**fields):
    """Return a response."""
    return TYPES.types['std_msgs/msg/String'](json.dumps(fields))


def done(start, end, **fields):
    """Return the last response to a shot."""
    return answer(phase='done', velocity=[1.0, 0.0], t_start=start, t_end=end, **fields)


def written(folder, messages):
    """Write (ns, topic, message) to an MCAP file and return it."""
    with Writer(folder / 'bag', version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        topics = {}
        for time, topic, message in messages:
            kind = message.__msgtype__
            if topic not in topics:
                topics[topic] = writer.add_connection(topic, kind, typestore=TYPES)
            writer.write(topics[topic], time, TYPES.serialize_cdr(message, kind))
    (file,) = (folder / 'bag').glob('*.mcap')
    return file


def frames_of(shot, start, count, topic=POSES):
    """Return the frames of a shot that starts at a tick, and of the rest before and after it."""
    stamps = [tick * SECOND // 60 for tick in range(start - 30, start + count)]
    times = np.maximum(np.array(stamps) / SECOND - start / 60, 0.0)
    places = shot.positions(times)
    return [(t, topic, poses(t, p)) for t, p in zip(stamps, places, strict=True)]


def test_each_shot_is_a_track_from_its_strike_on(tmp_path):
    first = simulate(TABLE, (1.0, 0.05))
    second = simulate(TABLE, (0.3, 0.1), positions=first.final_positions)
    one, two = int(60 * first.duration) + 60, int(60 * second.duration) + 60
    ends = 2.0 + first.duration, 2.0 + (one + 60) / 60 + second.duration
    file = written(
        tmp_path,
        [
            (0, ANSWERS, answer(phase='accepted', t_start=2.0)),
            *frames_of(first, 120, one),
            (1, ANSWERS, done(2.0, ends[0])),
            (1, ANSWERS, answer(phase='done', place={'1': [0.5, 0.4]}, velocity=None)),
            (1, ANSWERS, answer(phase='rejected')),
            *frames_of(second, 180 + one, two),
            (2, ANSWERS, done(3.0 + one / 60, ends[1], spin=[1.0, 2.0, 3.0])),
        ],
    )
    tracks = read_recording(TABLE, file)
    assert len(tracks) == 2
    for track, shot in zip(tracks, (first, second), strict=True):
        assert track.times[0] == pytest.approx(0.0, abs=1e-9)
        assert shot.duration < track.times[-1] < shot.duration + 0.25
        expected = shot.positions(np.maximum(track.times, 0.0))
        np.testing.assert_allclose(track.positions, expected, atol=1e-8)
    assert tracks[0].spin is None and tracks[1].spin.tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ('messages', 'words'),
    [
        ([(0, POSES, poses(0, [(0, 0)] * 2))], 'it needs one topic shot/response, not none'),
        ([(0, ANSWERS, done(0.0, 1.0))], 'it needs one topic ball_poses, not none'),
        (
            [(0, f'/{k}/ball_poses', poses(0, [(0, 0)] * 2)) for k in 'ab'],
            'it needs one topic ball_poses, not /a/ball_poses, /b/ball_poses',
        ),
        ([(0, POSES, done(0.0, 1.0))], 'is a std_msgs/msg/String, not a geometry_msgs'),
        (
            [(0, POSES, poses(0, [(0, 0)] * 3)), (0, ANSWERS, done(0.0, 1.0))],
            'a frame has 3 balls; the table has 2',
        ),
        (
            [(0, POSES, poses(0, [(0, 0)] * 2)), (0, ANSWERS, answer(phase='accepted'))],
            'no shot in it was played to its end',
        ),
        *(
            (
                [(0, POSES, poses(0, [(0, 0)] * 2)), (0, ANSWERS, done(start, 1.0))],
                'no shot in it was played to its end',
            )
            for start in ('now', math.nan)
        ),
        (
            [
                (0, POSES, poses(0, [(0, 0)] * 2)),
                (0, ANSWERS, TYPES.types['std_msgs/msg/String']('{"phase')),
            ],
            'it is no recording of shots',
        ),
    ],
)
def test_what_is_no_recording_of_shots(tmp_path, messages, words):
    file = written(tmp_path, messages)
    with pytest.raises(ValueError, match=words) as error:
        read_recording(TABLE, file)
    assert str(error.value).startswith(f'{file}: ')


def test_a_damaged_file_and_one_that_is_not_there(tmp_path):
    file = written(tmp_path, [(0, POSES, poses(0, [(0, 0)] * 2)), (0, ANSWERS, done(0.0, 1.0))])
    file.write_bytes(file.read_bytes()[:-100])
    with pytest.raises(ValueError, match='it is no recording of shots'):
        read_recording(TABLE, file)
    with pytest.raises(FileNotFoundError):
        read_recording(TABLE, tmp_path / 'none.mcap')
