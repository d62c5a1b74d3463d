"""Studies: sweeps over ranges of inputs, and environments to learn in.

    from pool_sim_ros.study import polar, sweep

    sweep(table, velocity=polar(angle=np.linspace(0, 360, 721), speed=2.0), out='map.zarr')

`sweeps` plays and keeps a shot for each combination of the inputs (extra `study`), `maps` draws
what came of it. The environments have Gymnasium's interface, one step a shot:

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
    from pool_sim_ros.study.datasets import (
        open_sweep,
    )
    from pool_sim_ros.study.environments import (
        PlaceEnv,
        PlaceVectorEnv,
        PotEnv,
        PotVectorEnv,
    )
    from pool_sim_ros.study.errors import (
        SweepError,
    )
    from pool_sim_ros.study.inputs import (
        cue,
        polar,
        xy,
        xyz,
    )
    from pool_sim_ros.study.maps import (
        plot,
    )
    from pool_sim_ros.study.ranges import (
        normal,
        uniform,
    )
    from pool_sim_ros.study.sweeps import (
        sweep,
    )
    from pool_sim_ros.study.zooms import (
        zoom,
    )
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'PlaceEnv': 'environments',
            'PlaceVectorEnv': 'environments',
            'PotEnv': 'environments',
            'PotVectorEnv': 'environments',
            'SweepError': 'errors',
            'cue': 'inputs',
            'normal': 'ranges',
            'open_sweep': 'datasets',
            'plot': 'maps',
            'polar': 'inputs',
            'sweep': 'sweeps',
            'uniform': 'ranges',
            'xy': 'inputs',
            'xyz': 'inputs',
            'zoom': 'zooms',
        },
    )

__all__ = [
    'PlaceEnv',
    'PlaceVectorEnv',
    'PotEnv',
    'PotVectorEnv',
    'SweepError',
    'cue',
    'normal',
    'open_sweep',
    'plot',
    'polar',
    'sweep',
    'uniform',
    'xy',
    'xyz',
    'zoom',
    'register_environments',
]

register_environments()
