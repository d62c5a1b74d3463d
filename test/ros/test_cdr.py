import numpy as np
import plain_messages
import pytest
from hypothesis import given
from hypothesis import strategies as st
from rclpy.serialization import deserialize_message, serialize_message

from pool_sim_ros.ros import cdr
from pool_sim_ros.simulator import COLLISION_COLUMNS, VELOCITY_COLUMNS

NUMBERS = st.floats(width=64)
STAMPS = st.integers(0, (2**31 - 1) * 10**9 + 999_999_999)
COLUMNS = len(COLLISION_COLUMNS)


def assert_same_bytes(written, message):
    """Check byte by byte, except for the gaps before aligned fields, where ROS leaves anything.

    A byte lies in a gap if the message means the same whatever it is.
    """
    expected = serialize_message(message)
    assert len(written) == len(expected)
    for index in np.flatnonzero(np.frombuffer(written, 'u1') != np.frombuffer(expected, 'u1')):
        either = [expected[:index] + bytes([byte]) + expected[index + 1 :] for byte in (0, 165)]
        meanings = {repr(deserialize_message(data, type(message))) for data in either}
        assert len(meanings) == 1, f'byte {index} differs'
        assert written[index] == 0


def collisions_writer():
    return cdr.RowsWriter('collision', COLLISION_COLUMNS)


def random_rows(seed, count, columns):
    """Rows of any bit patterns: zeros of both signs, infinities and NaNs included."""
    bits = np.random.default_rng(seed).integers(0, 2**64, (count, columns), dtype=np.uint64)
    rows = bits.view(np.float64)
    rows[0, 0] = (0.0, -0.0, np.inf, np.nan)[seed % 4]
    return rows


@given(
    st.text(st.characters(codec='utf-8', exclude_characters='\0'), max_size=40),
    st.lists(NUMBERS, min_size=1, max_size=40),
    st.lists(st.tuples(STAMPS, st.integers(0, 2**32)), min_size=1, max_size=4),
)
def test_poses_are_the_bytes_that_ros_makes(frame_id, radii, frames):
    writer = cdr.PosesWriter(frame_id, radii)
    stamps = [stamp for stamp, _ in frames]
    positions = np.array([random_rows(seed, len(radii), 2) for _, seed in frames])
    written = writer.write(stamps, positions)
    for data, stamp, places in zip(written, stamps, positions, strict=True):
        assert_same_bytes(data, plain_messages.to_poses(frame_id, stamp, places, radii))


@given(st.integers(1, 50), st.lists(st.integers(0, 2**32), min_size=1, max_size=4))
def test_velocities_are_the_bytes_that_ros_makes(balls, seeds):
    writer = cdr.RowsWriter('ball', VELOCITY_COLUMNS)
    frames = np.array([random_rows(seed, balls, 2) for seed in seeds])
    for data, rows in zip(writer.write(frames), frames, strict=True):
        assert_same_bytes(data, plain_messages.to_velocities(rows))


def assert_written(writer, rows):
    [data] = writer.write(rows[np.newaxis])
    assert_same_bytes(data, plain_messages.to_collisions(rows))


@given(st.lists(st.tuples(st.integers(1, 30), st.integers(0, 2**32)), min_size=1, max_size=8))
def test_collisions_are_the_bytes_that_ros_makes_however_many_come(frames):
    writer = collisions_writer()
    for count, seed in frames:
        assert_written(writer, random_rows(seed, count, COLUMNS))


def test_more_shapes_than_are_kept():
    writer = collisions_writer()
    for count in [*range(1, cdr.SHAPES_KEPT + 3), 1, 2, cdr.SHAPES_KEPT]:
        assert_written(writer, random_rows(count, count, COLUMNS))


@given(st.lists(STAMPS, min_size=1))
def test_the_clock_is_the_bytes_that_ros_makes(stamps):
    assert cdr.clock_bytes(stamps) == [
        serialize_message(plain_messages.to_clock(stamp)) for stamp in stamps
    ]


@pytest.mark.parametrize('order', ['C', 'F'])
def test_rows_in_any_memory_order(order):
    rows = np.array(random_rows(5, 3, COLUMNS), order=order)
    assert_written(collisions_writer(), rows)


def test_what_was_written_does_not_change_afterwards():
    writer = cdr.PosesWriter('table', [0.1])
    [first] = writer.write([1], np.array([[[1.0, 2.0]]]))
    copy = bytes(bytearray(first))
    writer.write([2], np.array([[[3.0, 4.0]]]))
    assert first == copy
