"""Candidates and answers as point clouds: bit for bit, and each wrong request is told what is
wrong."""

import numpy as np
import pytest
from point_clouds import message_of
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import PointCloud2, PointField

from pool_sim_ros.oracle import what_if
from pool_sim_ros.physics import Outcomes, pool_table, report_table
from pool_sim_ros.ros.oracle_error import OracleError
from pool_sim_ros.ros.point_cloud import cloud_bytes
from pool_sim_ros.ros.what_if_rows import (
    BLOCK,
    MOST_CANDIDATES,
    REQUEST_BYTES,
    answer_bytes,
    answer_from,
    candidates_from,
    no_answer_bytes,
    request_bytes,
)

STAMP = (7, 8)


def rows_of(names, count=2, kind='<f8', **layout):
    rows = np.zeros(count, np.dtype([(name, kind) for name in names.split()], **layout))
    for k, name in enumerate(names.split()):
        rows[name] = np.arange(count) + 10 * k
    return rows


@pytest.mark.parametrize('columns', [2, 5])
def test_candidates_arrive_as_they_are(columns):
    given = np.random.default_rng(1).normal(size=(100, columns))
    assert np.array_equal(candidates_from(request_bytes(STAMP, 'table', given), 'table'), given)


def test_fields_may_come_in_any_order_and_with_room_between_them():
    layout = np.dtype(
        {'names': ['vy', 'vx'], 'formats': ['<f8', '<f8'], 'offsets': [3, 20], 'itemsize': 40}
    )
    rows = np.zeros(2, layout)
    rows['vx'], rows['vy'] = [1.0, 2.0], [3.0, 4.0]
    data = serialize_message(message_of(rows))
    assert candidates_from(data, 'table').tolist() == [[1.0, 3.0], [2.0, 4.0]]
    spins = message_of(rows_of('wz wy wx vy vx'))
    assert candidates_from(serialize_message(spins), 'table')[0].tolist() == [40, 30, 20, 10, 0]


GOOD = rows_of('vx vy')
MIXED = np.zeros(1, [('vx', '<f8'), ('vy', '<f4')])


@pytest.mark.parametrize(
    ('message', 'code', 'words'),
    [
        (message_of(GOOD, frame_id='map'), 'BAD_FRAME', "frame_id: 'map' must be 'table'"),
        (message_of(GOOD, frame_id=''), 'BAD_FRAME', "frame_id: '' must be 'table'"),
        (message_of(GOOD[:0]), 'BAD_REQUEST', 'there are no candidates'),
        (message_of(GOOD, height=2, width=1), 'BAD_FIELDS', 'height: 2 must be 1'),
        (message_of(GOOD, height=0), 'BAD_FIELDS', 'height: 0 must be 1'),
        (message_of(GOOD, is_bigendian=True), 'BAD_FIELDS', 'is_bigendian: must be false'),
        (message_of(GOOD, row_step=33), 'BAD_FIELDS', 'row_step: 33'),
        (message_of(GOOD, point_step=15), 'BAD_FIELDS', 'row_step: 32 must be'),
        (message_of(GOOD, data=bytes(31)), 'BAD_FIELDS', 'data: 31 bytes'),
        (message_of(rows_of('vx')), 'BAD_FIELDS', 'fields: vx must be vx, vy'),
        (message_of(rows_of('x y z')), 'BAD_FIELDS', 'fields: x, y, z must be vx, vy'),
        (message_of(rows_of('vx vy wx')), 'BAD_FIELDS', 'fields: vx, vy, wx must be'),
        (message_of(rows_of('vx vy speed')), 'BAD_FIELDS', 'fields: vx, vy, speed must be'),
        (message_of(rows_of('vx vy', kind='<f4')), 'BAD_FIELDS', 'vx is FLOAT32 and must be'),
        (message_of(MIXED), 'BAD_FIELDS', 'vy is FLOAT32 and must be FLOAT64'),
        (message_of(rows_of('vx vy', kind='<i4')), 'BAD_FIELDS', 'vx is INT32'),
        (message_of(GOOD, fields=[]), 'BAD_FIELDS', 'there are none'),
        (
            message_of(rows_of('vx vy vz'), fields=[
                PointField(name='vx', offset=0, datatype=8, count=2),
                PointField(name='vy', offset=16, datatype=8, count=1)]),
            'BAD_FIELDS', 'vx has count 2',
        ),
        (message_of(rows_of('vx vy', MOST_CANDIDATES + 1)), 'TOO_MANY', 'at most 50000 are taken'),
        (message_of(GOOD, width=2**32 - 1), 'TOO_MANY', '4294967295 candidates'),
    ],
)  # fmt: skip
def test_a_wrong_request_is_told_what_is_wrong(message, code, words):
    with pytest.raises(OracleError, match=words) as error:
        candidates_from(serialize_message(message), 'table')
    assert error.value.code == code and '\n' not in str(error.value)


def test_a_message_that_is_too_long_is_not_even_read():
    with pytest.raises(OracleError, match=f'at most {REQUEST_BYTES} are read, 50000 candidates'):
        candidates_from(bytes(REQUEST_BYTES + 1), 'table')
    with pytest.raises(OracleError, match='is no sensor_msgs') as error:
        candidates_from(b'\0\1\0\0abc', 'table')
    assert error.value.code == 'BAD_REQUEST'


@pytest.mark.parametrize(
    ('candidates', 'words'),
    [
        ([], 'shape'),
        ([[1.0, 2.0, 3.0]], r'\(1, 3\) must be'),
        ('x', 'not an array'),
        (np.zeros((0, 2)), '0 must be 1 to 50000'),
        (np.zeros((50_001, 2)), '50001 must be 1 to 50000'),
    ],
)
def test_what_is_no_question_cannot_be_asked(candidates, words):
    with pytest.raises(ValueError, match=f'^candidates: .*{words}'):
        request_bytes(STAMP, 'table', candidates)


def answered(table, candidates):
    outcomes = what_if(table, candidates)
    return outcomes, answer_bytes(STAMP, 'table', table, outcomes)


@pytest.mark.parametrize('count', [1, 200, 2 * BLOCK, 2 * BLOCK + 1])
def test_an_answer_has_the_bits_of_the_engine(count):
    table = report_table()
    candidates = np.random.default_rng(2).uniform(-4.0, 4.0, (count, 2))
    outcomes, data = answered(table, candidates)
    stamp, found = answer_from(data)
    assert stamp == STAMP and found.labels == table.labels
    for name in ('finals', 'durations', 'event_counts', 'first_hit', 'pocketed'):
        assert np.array_equal(getattr(found, name), getattr(outcomes, name)), name


def test_viewers_see_where_the_cue_ball_ends():
    """As the fields of a message that ROS read: x, y, z first, then the balls by their labels."""
    table = report_table()
    outcomes, data = answered(table, [(-4.0, 0.0), (-3.0, 0.5)])
    message = deserialize_message(data, PointCloud2)
    names = [field.name for field in message.fields]
    balls = [f'{axis}_{label}' for label in table.labels for axis in 'xy']
    pocketed = [f'pocketed_{label}' for label in table.labels]
    assert names == ['x', 'y', 'z', 'duration', *balls, 'events', 'first_hit', *pocketed]
    kinds = {PointField.FLOAT32: 'f4', PointField.FLOAT64: 'f8', PointField.INT32: 'i4'}
    layout = np.dtype({
        'names': names,
        'formats': [kinds[field.datatype] for field in message.fields],
        'offsets': [field.offset for field in message.fields],
        'itemsize': message.point_step,
    })  # fmt: skip
    rows = np.frombuffer(bytes(message.data), layout)
    assert [kinds[field.datatype] for field in message.fields[:5]] == ['f4'] * 3 + ['f8'] * 2
    assert np.array_equal(rows['x'], outcomes.finals[:, 0, 0].astype('f4'))
    assert np.array_equal(rows['z'], np.full(2, table.balls[0].radius, 'f4'))
    assert np.array_equal(rows['y_10'], outcomes.finals[:, 10, 1])
    assert np.array_equal(rows['duration'], outcomes.durations)
    assert message.is_dense and (message.height, message.width) == (1, 2)
    assert message.header.frame_id == 'table'


def test_a_cue_ball_in_a_pocket_is_below_the_cloth_and_a_failed_shot_is_nowhere():
    table = pool_table('7ft')
    count = len(table.balls)
    outcomes = Outcomes(
        finals=np.array([np.zeros((count, 2)), np.full((count, 2), np.nan)]),
        durations=np.array([1.0, np.nan]),
        event_counts=np.array([5, -1]),
        pocketed=np.array([[2] + [-1] * (count - 1), [-1] * count]),
        first_hit=np.array([-1, -1]),
        failed=np.array([0, 2], np.int8),
        events=None,
        offsets=None,
    )
    message = deserialize_message(answer_bytes(STAMP, 'table', table, outcomes), PointCloud2)
    points = np.ndarray((2, 3), '<f4', bytes(message.data), strides=(message.point_step, 4))
    assert points[0].tolist() == [0.0, 0.0, np.float32(-table.balls[0].radius)]
    assert np.isnan(points[1]).all() and not message.is_dense


def test_no_answer_has_no_points_and_foreign_clouds_are_none():
    assert answer_from(no_answer_bytes(STAMP, 'table')) == (STAMP, None)
    for rows in (GOOD, rows_of('x y z'), rows_of('x_C y_C')):
        with pytest.raises(ValueError, match='no answer of an oracle'):
            answer_from(cloud_bytes(STAMP, 'table', rows))
    with pytest.raises(ValueError, match='no sensor_msgs'):
        answer_from(b'')
