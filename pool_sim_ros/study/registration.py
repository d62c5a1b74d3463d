"""Tells gymnasium of the environments, where it is installed."""

from __future__ import annotations

from importlib.util import find_spec

PLACE, POT = 'PoolSim/Place-v0', 'PoolSim/Pot-v0'

SHOTS = {PLACE: 10, POT: 30}
"""Shots after which an episode is cut: some more than a good player needs."""

CLASSES = {PLACE: 'Place', POT: 'Pot'}


def register_environments() -> None:
    """Register the environments by their names; does nothing where gymnasium is not installed."""
    if find_spec('gymnasium') is None:
        return
    from gymnasium.envs.registration import register, registry

    for name, kind in CLASSES.items():
        if name not in registry:
            register(
                name,
                entry_point=f'pool_sim_ros.study.environments:{kind}Env',
                vector_entry_point=f'pool_sim_ros.study.environments:{kind}VectorEnv',
                max_episode_steps=SHOTS[name],
            )
