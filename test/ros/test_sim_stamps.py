"""The sim time of recorded messages, from their content and the order in which they were sent."""

import json

import numpy as np
import pytest
from rclpy.serialization import serialize_message

from pool_sim_ros.ros import cdr, interface, messages
from pool_sim_ros.ros.sim_stamps import Heard, in_sim_time

TICK = 16_666_666


def poses(sent, stamp):
    (data,) = cdr.PosesWriter('table', [0.05]).write([stamp], np.zeros((1, 1, 2)))
    return Heard(sent, interface.BALL_POSES, 'poses', data)


def clock(sent, stamp):
    (data,) = cdr.clock_bytes([stamp])
    return Heard(sent, interface.CLOCK, '/clock', data)


def other(sent, topic, **fields):
    data = serialize_message(messages.to_json_string(fields))
    return Heard(sent, topic, topic.name, data)


def collisions(sent):
    return other(sent, interface.COLLISIONS)


def times(heard):
    """Return (name, sim time) of each message, in the order of the result."""
    return [(message.name, message.time) for message in in_sim_time(heard)]


def test_each_tick_keeps_its_stamp_and_what_was_sent_with_it():
    heard = [
        clock(100, TICK),
        collisions(101),
        poses(102, TICK),
        other(103, interface.BALL_VELOCITIES),
        other(104, interface.MARKERS),
        clock(200, 2 * TICK),
        collisions(201),
        poses(202, 2 * TICK),
        other(203, interface.BALL_VELOCITIES),
    ]
    wanted = [
        *[('/clock', TICK), ('collisions', TICK), ('poses', TICK), ('ball_velocities', TICK)],
        ('markers', TICK),
        *[('/clock', 2 * TICK), ('collisions', 2 * TICK), ('poses', 2 * TICK)],
        ('ball_velocities', 2 * TICK),
    ]
    assert times(heard) == wanted
    # As fast as possible, the topics are read in any order.
    assert times(heard[::-1]) == wanted
    assert times(heard[::2] + heard[1::2]) == wanted


def test_what_was_latched_belongs_to_the_first_tick_and_what_comes_last_to_the_last():
    heard = [
        other(1, interface.TABLE),
        poses(100, 5 * TICK),
        poses(101, 6 * TICK),
        other(900, interface.STATE),
        collisions(901),
    ]
    assert times(heard) == [
        *[('table', 5 * TICK), ('poses', 5 * TICK), ('poses', 6 * TICK)],
        *[('state', 6 * TICK), ('collisions', 6 * TICK)],
    ]


@pytest.mark.parametrize('sent', [1, 150, 10_000], ids=['early', 'right', 'late'])
def test_a_request_is_never_later_than_its_answer(sent):
    """Whoever sent it may have a wrong clock."""
    heard = [
        other(sent, interface.SHOT_REQUEST, id='a', shot=1),
        poses(100, TICK),
        other(160, interface.SHOT_RESPONSE, id='a', phase='accepted'),
        poses(200, 2 * TICK),
        poses(300, 3 * TICK),
        other(301, interface.SHOT_RESPONSE, id='a', phase='done'),
    ]
    found = times(heard)
    assert ('shot/request', TICK) in found
    assert [time for name, time in found if name == 'shot/response'] == [TICK, 3 * TICK]


def test_the_clock_of_somebody_else_does_not_stretch_the_file():
    first, last = 60_000_000_000, 60_000_000_000 + TICK
    heard = [poses(1, first), clock(2, 10**15), clock(3, 0), poses(4, last)]
    assert times(heard) == [
        *[('poses', first), ('/clock', first)],
        *[('/clock', last), ('poses', last)],
    ]


def test_bytes_that_are_no_message_are_kept_and_harm_nothing():
    nonsense = [
        Heard(2, interface.BALL_POSES, 'poses', b''),
        Heard(3, interface.CLOCK, '/clock', b'\0\1\0\0\1'),
        Heard(4, interface.SHOT_REQUEST, 'request', b'\0\1\0\0'),
        Heard(5, interface.SHOT_RESPONSE, 'response', b'\xff'),
        Heard(
            6,
            interface.SHOT_REQUEST,
            'request',
            serialize_message(messages.to_string(json.dumps([[{}]]))),
        ),
    ]
    heard = [poses(1, TICK), *nonsense, poses(9, 2 * TICK)]
    found = in_sim_time(heard)
    assert [m.time for m in found] == [TICK] * 6 + [2 * TICK]
    assert [m.data for m in found] == [m.data for m in heard]


def test_without_poses_there_is_no_sim_time():
    assert in_sim_time([]) == []
    assert in_sim_time([clock(1, TICK), other(2, interface.STATE)]) == []


def test_either_byte_order_is_read():
    little = poses(1, TICK).data
    stamp = TICK.to_bytes(4, 'big')
    big = b'\0\0\0\0' + b'\0\0\0\0' + stamp + little[12:]
    assert times([Heard(1, interface.BALL_POSES, 'poses', big)]) == [('poses', TICK)]


def test_a_clock_just_before_the_first_poses_or_after_the_last_keeps_its_stamp():
    heard = [clock(1, TICK), poses(2, 2 * TICK), clock(3, 3 * TICK)]
    assert times(heard) == [('/clock', TICK), ('poses', 2 * TICK), ('/clock', 3 * TICK)]
