"""What a shot is given, made ready for the kernels. `test_bad_input` has the messages."""

import math

import numpy as np
import pytest
from tables import table_of, under

from pool_sim_ros.physics import ShotTooLong, report_table
from pool_sim_ros.physics.outcomes import BAD_LAYOUT, BAD_VELOCITY, RUNS_AWAY, TOO_MANY_EVENTS
from pool_sim_ros.physics.shot_inputs import (
    check_end,
    for_kernels,
    layouts_for,
    limits_of,
    raise_failed,
    velocities_for,
)
from pool_sim_ros.physics.tolerances import MAX_SPEED, MOST_EVENTS, MOST_EVENTS_A_BALL

TWO = table_of([(0.5, 0.5), (1.0, 0.5)])


def test_limits():
    until, most = limits_of(TWO, 'event', 1e-6, None, None)
    assert (until, most) == (math.inf, MOST_EVENTS)
    until, most = limits_of(TWO, 'event', 1e-6, 2, 7)
    assert (until, most) == (2.0, 7) and (type(until), type(most)) == (float, int)


def test_a_large_table_has_a_higher_limit():
    spots = [(0.01 + 0.02 * (k % 20), 0.01 + 0.02 * (k // 20)) for k in range(200)]
    table = table_of(spots, radius=0.01)
    assert limits_of(table, 'event', 1e-6, None, None)[1] == MOST_EVENTS_A_BALL * 200


@pytest.mark.parametrize(
    ('velocities', 'alone', 'shape'),
    [
        ((1.0, 2.0), 1, (1, 2)),
        ([(1.0, 2.0), (3.0, 4.0)], 1, (2, 2)),
        ([(1.0, 2.0)], 2, (1, 1, 2)),
        ([(1.0, 2.0), (3.0, 4.0), (5.0, 6.0)], 2, (3, 1, 2)),
        ([[(1.0, 2.0), (3.0, 4.0)]], 2, (1, 2, 2)),
    ],
)
def test_velocities(velocities, alone, shape):
    found = velocities_for(TWO, velocities, alone)
    assert found.shape == shape
    np.testing.assert_array_equal(found.ravel(), np.ravel(velocities))


def test_the_cue_ball_must_be_the_first_to_be_struck_alone():
    table = under(TWO, balls=TWO.balls[::-1])
    with pytest.raises(ValueError, match=r'cue ball is ball 1; give \(2, 2\)'):
        velocities_for(table, (1.0, 0.0), 1)
    assert velocities_for(table, [(0.0, 0.0), (1.0, 0.0)], 1).shape == (2, 2)


def test_layouts():
    one = [(0.3, 0.3), (0.6, 0.6)]
    assert layouts_for(TWO, one).shape == layouts_for(TWO, one, 5).shape == (2, 2)
    assert layouts_for(TWO, [one] * 5, 5).shape == (5, 2, 2)
    for wrong, shots in (([one] * 5, None), ([one] * 4, 5), (one[:1], 5)):
        with pytest.raises(ValueError, match='positions: shape'):
            layouts_for(TWO, wrong, shots)


def test_the_kernels_get_one_memory_layout():
    plain = np.arange(12.0).reshape(3, 2, 2)
    read_only = plain.copy()
    read_only.flags.writeable = False
    assert for_kernels(plain) is plain
    for values in (read_only, plain.transpose(2, 1, 0), plain[:, ::-1]):
        found = for_kernels(values)
        assert found.flags.c_contiguous and found.flags.writeable
        np.testing.assert_array_equal(found, values)


@pytest.mark.parametrize('speed', [math.nan, math.inf, 1.1 * MAX_SPEED])
def test_speeds_are_looked_at_wherever_the_kernel_does_not(speed):
    velocities = np.array([(0.0, speed)])
    for until in (None, 1.0):
        with pytest.raises(ValueError, match='velocities: '):
            check_end(TWO, velocities, until, 'time_slice', 1e-3)
    with pytest.raises(ValueError, match='velocities: '):
        check_end(under(TWO, mu_ball_surface=0.0), velocities, None, 'event', 1e-3)


def test_what_would_never_end():
    table = under(TWO, mu_ball_surface=0.0)
    for integrator in ('event', 'time_slice'):
        with pytest.raises(ValueError, match='until: '):
            check_end(table, np.array([(1.0, 0.0)]), None, integrator, 1e-3)
        check_end(table, np.zeros((1, 2)), None, integrator, 1e-3)
        check_end(table, np.array([(1.0, 0.0)]), 1.0, integrator, 1e-3)
    with pytest.raises(ValueError, match='time_slice: 1e-17 is too short'):
        check_end(TWO, np.array([(1.0, 0.0)]), None, 'time_slice', 1e-17)
    check_end(TWO, np.array([(1.0, 0.0)]), None, 'event', 1e-17)


@pytest.mark.parametrize(
    ('failed', 'error', 'words'),
    [
        (BAD_VELOCITY, ValueError, 'velocities: nan is not finite'),
        (BAD_LAYOUT, ValueError, 'positions of shot 3: ball .* overlap'),
        (TOO_MANY_EVENTS, ShotTooLong, 'max_events: shot 3 has more than 9'),
        (RUNS_AWAY, ValueError, 'mu_ball_ball: .*shot 3 energy without end'),
        (99, RuntimeError, 'shot 3 failed with 99'),
    ],
)
def test_why_a_shot_failed_in_words(failed, error, words):
    velocities = np.array([(math.nan, 0.0)])
    with pytest.raises(error, match=words) as caught:
        raise_failed(report_table(), failed, 'shot 3', velocities, np.zeros((11, 2)) + 1.0, 9)
    assert '\n' not in str(caught.value)
