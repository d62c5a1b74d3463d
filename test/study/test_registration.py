"""The names that gymnasium knows."""

import subprocess
import sys

import gymnasium
import pytest

from pool_sim_ros.study import register_environments
from pool_sim_ros.study.registration import PLACE, POT, SHOTS


@pytest.mark.parametrize('name', [PLACE, POT])
def test_importing_the_room_registers_both_and_once_more_changes_nothing(name):
    spec = gymnasium.spec(name)
    register_environments()
    assert gymnasium.spec(name) is spec and spec.max_episode_steps == SHOTS[name]
    assert spec.entry_point.endswith('Env') and spec.vector_entry_point.endswith('VectorEnv')


def test_without_gymnasium_the_room_can_still_be_imported():
    code = (
        'import sys; sys.modules["gymnasium"] = None\n'
        'import importlib.util as u; found = u.find_spec\n'
        'u.find_spec = lambda name, *a: None if name == "gymnasium" else found(name, *a)\n'
        'import pool_sim_ros.study\n'
        'try: pool_sim_ros.study.PlaceEnv\n'
        'except ImportError as error: print(error)'
    )
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, timeout=60)
    assert 'pip install gymnasium' in done.stdout and done.stdout.count('\n') == 1, done.stderr
