"""What users import from the room."""

import subprocess
import sys

import pytest

from pool_sim_ros import ros as room


@pytest.mark.parametrize('name', room.__all__)
def test_every_name_is_there(name):
    assert getattr(room, name) is not None


def test_what_users_need_is_public():
    wanted = {'SimNode', 'ShotClient', 'SimulatorError', 'Recorder', 'interface'}
    wanted |= {'OracleNode', 'WhatIfClient', 'PlanClient', 'OracleError', 'oracle_interface'}
    assert wanted <= set(room.__all__)


def test_a_name_that_is_not_there_is_an_attribute_error():
    with pytest.raises(AttributeError, match='NoSuchNode'):
        room.NoSuchNode  # noqa: B018


def test_a_client_alone_loads_neither_the_physics_nor_what_records():
    code = (
        'import sys\n'
        'from pool_sim_ros.ros import PlanClient, ShotClient, WhatIfClient, interface\n'
        'sys.exit(" ".join({"numba", "rosbags"} & set(sys.modules)) or 0)'
    )
    assert subprocess.run([sys.executable, '-c', code], timeout=60, check=False).returncode == 0
