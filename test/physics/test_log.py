"""What the kernels write down, also where there is too little room."""

import numpy as np
import pytest
from numba import njit

from pool_sim_ros.physics.log import (
    BALL_BALL,
    CUSHION,
    EVENT,
    FIRST_HIT,
    N_EVENTS,
    N_SEGMENTS,
    POCKETED,
    ROLL,
    SEGMENT,
    STOP,
    EventKind,
    clear,
    log_event,
    log_hit,
    log_segment,
    new_log,
)


@njit
def write_events(log, count):
    for k in range(count):
        t = 0.5 * k
        log_event(log, t, k % 3, (k, k + 1), (t + 1.0, t + 2.0), (t + 3.0, t + 4.0), t + 5.0)


@njit
def write_segments(log, count):
    for k in range(count):
        t = 0.5 * k
        log_segment(log, k, t, (t + 1.0, t + 2.0), (t + 3.0, t + 4.0), (t + 5.0, t + 6.0))


@njit
def forget(log):
    clear(log)


@njit
def hit(log, a, b, cue_ball):
    log_hit(log, a, b, cue_ball)


def expected_events(count):
    t = 0.5 * np.arange(count)
    k = np.arange(count)
    columns = (t, k % 3, k, k + 1, t + 1, t + 2, t + 3, t + 4, t + 5)
    return list(zip(*(column.tolist() for column in columns), strict=True))


def expected_segments(count):
    t = 0.5 * np.arange(count)
    columns = (np.arange(count), t, t + 1, t + 2, t + 3, t + 4, t + 5, t + 6)
    return list(zip(*(column.tolist() for column in columns), strict=True))


@pytest.mark.parametrize('room', [0, 1, 5, 6, 100])
def test_events_are_counted_and_kept_where_they_find_room(room):
    log = new_log(room, 0)
    write_events(log, 6)
    kept = min(room, 6)
    assert log.counts[N_EVENTS] == 6
    assert log.events[:kept].tolist() == expected_events(kept)


@pytest.mark.parametrize('room', [1, 5, 6, 100])
def test_segments_too(room):
    log = new_log(0, room)
    write_segments(log, 6)
    kept = min(room, 6)
    assert log.counts[N_SEGMENTS] == 6
    assert log.segments[:kept].tolist() == expected_segments(kept)


def test_segments_are_not_counted_where_nobody_wants_them():
    log = new_log(3, 0)
    write_segments(log, 6)
    assert log.counts[N_SEGMENTS] == 0


def test_what_is_forgotten():
    log = new_log(4, 4)
    write_events(log, 3)
    write_segments(log, 2)
    hit(log, 0, 1, 0)
    forget(log)
    assert log.counts.tolist() == [0, 0, -1]


@pytest.mark.parametrize(
    ('contacts', 'cue_ball', 'expected'),
    [
        ([], 0, -1),
        ([(1, 2)], 0, -1),
        ([(1, 2), (0, 3), (0, 1)], 0, 3),
        ([(0, 2), (1, 2)], 2, 0),
        ([(0, 1)], -1, -1),
    ],
)
def test_the_first_ball_that_is_hit(contacts, cue_ball, expected):
    log = new_log(0, 0)
    for a, b in contacts:
        hit(log, a, b, cue_ball)
    assert log.counts[FIRST_HIT] == expected


def test_kinds_and_fields_are_those_that_are_documented():
    assert [(kind.name, kind.value) for kind in EventKind] == [
        ('BALL_BALL', 0),
        ('CUSHION', 1),
        ('STOP', 2),
        ('POCKETED', 3),
        ('ROLL', 4),
    ]
    assert (BALL_BALL, CUSHION, STOP, POCKETED, ROLL) == (0, 1, 2, 3, 4)
    assert EVENT.names == ('t', 'kind', 'a', 'b', 'x', 'y', 'nx', 'ny', 'speed')
    assert SEGMENT.names == ('ball', 't', 'x', 'y', 'vx', 'vy', 'ax', 'ay')
