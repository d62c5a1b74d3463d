"""What others may use of the room, and what that costs them to load."""

import subprocess
import sys

import pytest

import pool_sim_ros.simulator

LIGHT = [
    'COLLISION_COLUMNS',
    'Diagnosis',
    'Frame',
    'Pacer',
    'Phase',
    'Response',
    'SECOND_NS',
    'VELOCITY_COLUMNS',
    'seconds_to_stamp',
    'stamp_to_seconds',
]


@pytest.mark.parametrize('name', pool_sim_ros.simulator.__all__)
def test_every_name_is_there(name):
    assert getattr(pool_sim_ros.simulator, name) is not None


def test_another_name_is_not():
    with pytest.raises(AttributeError, match='Session'):
        _ = pool_sim_ros.simulator.Session


def test_what_clients_use_loads_without_compiled_physics():
    statement = f'from pool_sim_ros.simulator import {", ".join(LIGHT)}'
    subprocess.run(
        [sys.executable, '-c', f'{statement}; import sys; assert "numba" not in sys.modules'],
        check=True,
        timeout=120,
    )
