"""From actions to velocities and spins."""

import math

import numpy as np
import pytest

from pool_sim_ros.physics import cue_strike, pool_table, report_table
from pool_sim_ros.study.strikes import Strikes


def test_a_disc_gets_a_part_of_the_speed_along_each_axis():
    velocities, spins = Strikes(report_table(), 4.0).of(np.array([[0.5, -1.0], [3.0, -7.0]]))
    assert velocities.tolist() == [[2.0, -4.0], [4.0, -4.0]] and spins is None


@pytest.mark.parametrize('action', [(0.3, -0.6, 0.5, 0.4), (-1.0, 0.2, -0.9, 0.1), (1, 0, 0, -1)])
def test_a_ball_gets_what_a_level_cue_gives_it(action):
    table = pool_table('7ft')
    (velocity,), (spin,) = Strikes(table, 4.0).of(np.array([action], float))
    assert velocity == pytest.approx(4.0 * np.array(action[:2]))
    azimuth = math.degrees(math.atan2(velocity[1], velocity[0]))
    side, above = 0.5 * action[2], 0.5 * action[3]
    unit, _ = cue_strike(table, 1.0, azimuth, side=side, above=above, end_mass_ratio=None)
    speed = math.hypot(*velocity) / math.hypot(*unit)
    expected = cue_strike(table, speed, azimuth, side=side, above=above, end_mass_ratio=None)
    assert velocity == pytest.approx(expected[0], abs=1e-12)
    assert spin == pytest.approx(expected[1], abs=1e-9)


def test_no_action_is_a_miscue():
    table = pool_table('7ft')
    _, (corner, edge) = Strikes(table, 4.0).of(np.array([[1, 0, 1, 1], [1, 0, 0, 1]], float))
    at_most = 2.5 * 0.5 * 4.0 / table.balls[0].radius
    assert np.hypot(*corner[1:]) == pytest.approx(at_most) == edge[1]


@pytest.mark.parametrize('speed', [0.0, -1.0, math.nan, math.inf])
def test_a_speed_that_is_none_is_refused(speed):
    with pytest.raises(ValueError, match='^speed: .* must be above 0 and at most 1000 m/s$'):
        Strikes(report_table(), speed)
