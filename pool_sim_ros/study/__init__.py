"""Environments to learn in, over the engine: Gymnasium's interface, one step a shot.

    import gymnasium
    import pool_sim_ros.study

    env = gymnasium.make('PoolSim/Place-v0')
    envs = gymnasium.make_vec('PoolSim/Pot-v0', num_envs=64)

Importing this room registers both where gymnasium is installed (extra `gym`). `tasks` says what is
to be done and what it earns, `starts` where the balls lie, `environments` makes Gymnasium's
classes of it.
"""

from typing import TYPE_CHECKING

from pool_sim_ros.lazy import lazy_exports
from pool_sim_ros.study.registration import register_environments

if TYPE_CHECKING:
    from pool_sim_ros.study.environments import (
        PlaceEnv,
        PlaceVectorEnv,
        PotEnv,
        PotVectorEnv,
    )
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'PlaceEnv': 'environments',
            'PlaceVectorEnv': 'environments',
            'PotEnv': 'environments',
            'PotVectorEnv': 'environments',
        },
    )

__all__ = ['PlaceEnv', 'PlaceVectorEnv', 'PotEnv', 'PotVectorEnv', 'register_environments']

register_environments()
