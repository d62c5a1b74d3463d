"""Point clouds as bytes are those of ROS, both ways, whatever their fields; foreign ones are
refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from point_clouds import message_of
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import PointCloud2, PointField

from pool_sim_ros.ros.point_cloud import DATATYPES, cloud_bytes, read_cloud, read_stamp, rows_of

NUMBERS = sorted(DATATYPES.values())


@st.composite
def tables(draw):
    """Rows of any fields, packed or aligned."""
    names = draw(st.lists(st.text(min_size=1, max_size=9), min_size=1, max_size=6, unique=True))
    names = [name for name in names if '\0' not in name and name.isprintable()] or ['x']
    kinds = draw(st.lists(st.sampled_from(NUMBERS), min_size=len(names), max_size=len(names)))
    layout = np.dtype(list(zip(names, kinds, strict=True)), align=draw(st.booleans()))
    count = draw(st.integers(0, 5))
    return np.frombuffer(
        draw(st.binary(min_size=(size := layout.itemsize * count), max_size=size)), layout, count
    )


@given(tables(), st.integers(-(2**31), 2**31 - 1), st.integers(0, 2**32 - 1), st.text(max_size=9))
def test_what_is_written_is_what_ros_reads_and_the_other_way_round(rows, sec, nanosec, frame_id):
    frame_id = ''.join(c for c in frame_id if c.isprintable())
    data = cloud_bytes((sec, nanosec), frame_id, rows)
    expected = message_of(rows, (sec, nanosec), frame_id)
    assert deserialize_message(data, PointCloud2) == expected
    for sent in (data, serialize_message(expected)):
        cloud = read_cloud(sent)
        assert cloud[:4] == ((sec, nanosec), frame_id, 1, len(rows)) and not cloud.is_bigendian
        assert read_stamp(sent) == (sec, nanosec)
        assert rows_of(cloud).tobytes() == rows.tobytes()
        assert rows_of(cloud).dtype.fields == rows.dtype.fields


def test_numbers_may_be_big_endian_and_several_of_a_name():
    layout = np.dtype([('a', '>f8'), ('b', '>i4', (2,))])
    rows = np.array([(1.5, (2, 3)), (4.5, (5, 6))], layout)
    fields = [
        PointField(name='a', offset=0, datatype=PointField.FLOAT64, count=1),
        PointField(name='b', offset=8, datatype=PointField.INT32, count=2),
    ]
    plain = np.zeros(2, [('a', '<f8'), ('b', '<f8')])
    message = message_of(plain, fields=fields, is_bigendian=True)
    message.data = rows.tobytes()
    read = rows_of(read_cloud(serialize_message(message)))
    assert read['a'].tolist() == [1.5, 4.5] and read['b'].tolist() == [[2, 3], [5, 6]]


def test_a_missing_number_is_told():
    rows = np.zeros(1, [('x', '<f4')])
    assert not deserialize_message(cloud_bytes((0, 0), '', rows, dense=False), PointCloud2).is_dense


ROWS = np.zeros(3, [('x', '<f8'), ('y', '<f8')])


@pytest.mark.parametrize(
    ('changes', 'words'),
    [
        ({'row_step': 47}, 'row_step: 47 must be width'),
        ({'data': bytes(47)}, 'data: 47 bytes'),
        ({'width': 4}, 'row_step: 48 must be'),
        ({'height': 2}, 'data: 48 bytes must be height'),
        ({'fields': []}, 'fields: there are none'),
        ({'point_step': 0, 'row_step': 0, 'data': b''}, "'x' ends at byte 8"),
        ({'fields': [PointField(name='x', offset=12, datatype=8, count=1)]}, 'ends at byte 20'),
        ({'fields': [PointField(name='x', offset=2**32 - 1, datatype=8, count=1)]}, 'ends at byte'),
        ({'fields': [PointField(name='x', datatype=8, count=2**32 - 1)]}, 'ends at byte'),
        ({'fields': [PointField(name='x', datatype=9, count=1)]}, 'no datatype 9'),
        ({'fields': [PointField(name='x', datatype=8, count=1)] * 2}, 'twice'),
    ],
)
def test_sizes_that_contradict_each_other_are_named(changes, words):
    cloud = read_cloud(serialize_message(message_of(ROWS, **changes)))
    with pytest.raises(ValueError, match=words):
        rows_of(cloud)


def test_each_message_has_its_own_fields():
    """Those of the latest message are kept: the next one may have others, or be cut off."""
    one, other = (np.zeros(2, [(name, kind)]) for name, kind in (('vx', '<f8'), ('vy', '<f4')))
    both = np.zeros(2, [('vx', '<f8'), ('vy', '<f4')])
    for rows in (one, other, one, both, one, both):
        for frame_id in ('', 'table', 'tables'):
            data = cloud_bytes((1, 2), frame_id, rows)
            assert [field.name for field in read_cloud(data).fields] == list(rows.dtype.names)
            with pytest.raises(ValueError, match='no sensor_msgs'):
                read_cloud(data[:40])


def test_foreign_bytes_are_refused():
    whole = cloud_bytes((1, 2), 'table', ROWS)
    cut = [whole[:end] for end in range(len(whole))]
    for data in [*cut, whole + bytes(9), b'\0\1\0\0' + b'\xff' * 200]:
        with pytest.raises(ValueError, match=f'{len(data)} bytes is no sensor_msgs'):
            read_cloud(data)
    assert read_stamp(b'') == (0, 0)
