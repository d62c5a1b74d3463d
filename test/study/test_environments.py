"""The environments by name."""

import dataclasses

import gymnasium
import pytest

from pool_sim_ros.physics import pool_table
from pool_sim_ros.study import PlaceEnv, PotEnv, PotVectorEnv


@pytest.mark.parametrize(('table', 'ball'), [('report', '9'), ('7ft', '9'), ('snooker', 'black')])
def test_a_table_may_be_a_name(table, ball):
    env = gymnasium.make('PoolSim/Place-v0', table=table, ball=ball, starts=8)
    assert env.reset(seed=0)[0] in env.observation_space


def test_a_table_may_be_ones_own():
    own = pool_table('9ft')
    own = dataclasses.replace(own, balls=own.balls[:4])
    for env in (PotEnv(own, starts=8), PotVectorEnv(3, table=own, starts=8)):
        seen, _ = env.reset(seed=0)
        assert seen.shape[-1] == 8 and seen in env.observation_space
    env = gymnasium.make_vec('PoolSim/Pot-v0', 2, table=own, starts=8)
    assert env.reset(seed=0)[0].shape == (2, 8)


@pytest.mark.parametrize('table', ['10ft', 7, None])
def test_a_table_that_is_none_is_refused(table):
    with pytest.raises(ValueError, match="^table: .* must be a Table or one of 'report', '7ft'"):
        PlaceEnv(table)


def test_a_misspelt_option_is_an_error():
    with pytest.raises(TypeError, match='plce'):
        PlaceEnv(plce=(1.0, 0.5))
