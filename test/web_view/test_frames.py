"""Poses from the wire to the page, against the message type's own serialisation."""

import numpy as np
import pytest
from plain_messages import to_poses
from rclpy.serialization import serialize_message

from pool_sim_ros.web_view.frames import (
    are_collisions,
    check_count,
    frame_positions,
    page_frame,
)


@pytest.mark.parametrize('frame_id', ['', 't', 'table', 'a/frame/of/its/own', 'é'])
@pytest.mark.parametrize('count', [0, 1, 2, 11])
def test_a_frame_has_the_stamp_and_the_places(frame_id, count):
    positions = np.random.default_rng(count).uniform(-1, 3, (count, 2))
    message = to_poses(frame_id, 7_016_666_666, positions, [0.05] * count)
    frame = page_frame(serialize_message(message))
    assert np.frombuffer(frame, '<f8')[0] == pytest.approx(7.016666666, abs=1e-12)
    assert np.array_equal(frame_positions(frame), positions)


@pytest.mark.parametrize('cut', [0, 1, 3, 10, 30, 200])
def test_bytes_that_are_no_poses_are_refused(cut):
    message = to_poses('table', 1, np.ones((11, 2)), [0.05] * 11)
    with pytest.raises(ValueError, match='PoseArray'):
        page_frame(serialize_message(message)[:cut])


def test_a_count_that_the_bytes_do_not_hold_is_refused():
    message = bytearray(serialize_message(to_poses('table', 1, np.ones((1, 2)), [0.05])))
    count = 4 + 12 + 8  # head; stamp and length; "table", its end and the padding
    assert message[count] == 1
    message[count + 3] = 0xFF
    with pytest.raises(ValueError, match='PoseArray'):
        page_frame(bytes(message))


@pytest.mark.parametrize('number', [np.nan, np.inf, -np.inf])
def test_a_ball_that_is_nowhere_is_refused(number):
    positions = np.ones((3, 2))
    positions[1, 1] = number
    message = serialize_message(to_poses('table', 1, positions, [0.05] * 3))
    with pytest.raises(ValueError, match='ball_poses: a position is not finite'):
        page_frame(message)


def test_a_frame_of_other_balls_is_refused():
    frame = page_frame(serialize_message(to_poses('table', 1, np.ones((3, 2)), [0.05] * 3)))
    check_count(frame, 3)
    for balls in (2, 4):
        with pytest.raises(ValueError, match=f'3 balls, where the table has {balls}'):
            check_count(frame, balls)


@pytest.mark.parametrize(
    ('kind', 'a', 'b', 'good'),
    [
        (0, 0, 2, True),
        (0, 2, 3, False),
        (1, 2, 3, True),
        (1, 3, 0, False),
        (0, -1, 2, False),
        (1, 0, -1, False),
        (0, 0.5, 1, False),
        (1, np.nan, 0, False),
    ],
)
def test_collisions_name_balls_of_the_table(kind, a, b, good):
    row = [0, 0.5, kind, a, b, 1.0, 0.5, 1.0, 0.0, 2.5]
    assert are_collisions(np.array([row]), 3) == good
    assert not are_collisions(np.array([row[:9]]), 3)
