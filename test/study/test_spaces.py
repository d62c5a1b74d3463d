"""The spaces that gymnasium is told of."""

import numpy as np

from pool_sim_ros.physics import pool_table, report_table
from pool_sim_ros.study.spaces import action_space, observation_space
from pool_sim_ros.study.tasks import Place, Pot

PLACE = Place(report_table(), 4.0, 10, 1, '9', None, 0.1)
POT = Pot(pool_table('7ft'), 4.0, 10, 1)


def test_on_the_reports_table_a_ball_is_within_the_cushions():
    space = observation_space(PLACE)
    table = PLACE.table
    assert space.shape == (24,) and space.dtype == np.float64
    assert space.low[:22].tolist() == [0.0] * 22
    assert space.high[:4].tolist() == [table.length, table.width] * 2
    assert action_space(PLACE).shape == (2,)


def test_a_caught_ball_is_within_the_space_too():
    space = observation_space(POT)
    for x, y, _ in POT.table.pockets:
        assert np.tile([x, y], 16) in space
    assert action_space(POT).shape == (4,)
