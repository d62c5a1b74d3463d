"""What others may use of the room, and what that costs them to load."""

import subprocess
import sys

import pytest

import pool_sim_ros.me212


@pytest.mark.parametrize('name', pool_sim_ros.me212.__all__)
def test_every_name_is_there(name):
    assert getattr(pool_sim_ros.me212, name) is not None


def test_shots_and_log_load_without_compiled_physics():
    statement = 'from pool_sim_ros.me212 import SHOT_NUMBERS, cue_velocity, format_log, inches'
    subprocess.run(
        [sys.executable, '-c', f'{statement}; import sys; assert "numba" not in sys.modules'],
        check=True,
        timeout=120,
    )
