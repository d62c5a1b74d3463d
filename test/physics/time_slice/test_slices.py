"""What is written down of the motions between the slices."""

import math

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.physics.log import N_SEGMENTS, new_log
from pool_sim_ros.physics.time_slice.play import new_state
from pool_sim_ros.physics.time_slice.slices import log_motion


def begun(velocities, friction=0.1):
    table = table_of([(0.5, 0.5), (1.0, 0.5)], mu_ball_surface=friction)
    state = new_state(table, table.positions, np.array(velocities), 1e-3, new_log(9, 9))
    return table, state


def segments_of(state):
    return state.log.segments[: state.log.counts[N_SEGMENTS]]


def test_the_first_motion_of_every_ball():
    table, state = begun([(3.0, 4.0), (0.0, 0.0)])
    moving, resting = segments_of(state)
    a = table.deceleration
    assert moving.tolist() == pytest.approx((0, 0.0, 0.5, 0.5, 3.0, 4.0, -0.6 * a, -0.8 * a))
    assert resting.tolist() == (1, 0.0, 1.0, 0.5, 0.0, 0.0, 0.0, 0.0)
    assert state.rest[0] == pytest.approx((5.0 / a, 0.5 + 3.0 * 2.5 / a, 0.5 + 4.0 * 2.5 / a))


def test_a_ball_that_stops_within_a_slice_rests_from_then_on():
    """The parabola's end first, then the place that the slices give."""
    table, state = begun([(0.01, 0.0), (0.0, 0.0)])
    stops = 0.01 / table.deceleration
    state.v[0], state.x[0] = 0.0, (0.51, 0.5)
    log_motion(state, 0, stops + 3e-4)
    end, after = segments_of(state)[2:]
    assert end['t'] == pytest.approx(stops) and after['t'] == stops + 3e-4
    assert end['x'] == pytest.approx(0.5 + 0.5 * 0.01 * stops)
    assert after['x'] == 0.51
    for segment in (end, after):
        assert segment[['vx', 'vy', 'ax', 'ay']].tolist() == (0.0, 0.0, 0.0, 0.0)
    assert state.rest[0, 0] == math.inf


def test_a_ball_that_is_stopped_before_is_written_once():
    _, state = begun([(1.0, 0.0), (0.0, 0.0)])
    state.v[0] = 0.0
    log_motion(state, 0, 0.1)
    assert len(segments_of(state)) == 3


def test_without_friction_there_is_no_end():
    _, state = begun([(1.0, 0.0), (0.0, 0.0)], friction=0.0)
    assert state.rest[0, 0] == math.inf
    assert segments_of(state)[0][['ax', 'ay']].tolist() == (0.0, 0.0)
