"""What a worker does, without one."""

import pytest
from sweeping import NAMES, TABLE

from pool_sim_ros.study import region_task
from pool_sim_ros.study.description import engine
from pool_sim_ros.study.errors import SweepError
from pool_sim_ros.study.inputs import checked_inputs
from pool_sim_ros.study.plan import checked_plan
from pool_sim_ros.study.region_task import play_regions
from pool_sim_ros.study.store import created


@pytest.fixture
def store(tmp_path):
    region_task._open.cache_clear()
    inputs = checked_inputs(TABLE, NAMES)
    return created(tmp_path / 'a.zarr', checked_plan(TABLE, inputs, None, 2, 0, None, None, 20))


def test_it_plays_and_writes_these_regions(store):
    assert play_regions(str(store.path), store.identity, engine(), [2, 0]) == 40
    assert store.finished().tolist() == [True, False, True]


def test_another_engine_plays_nothing(store):
    with pytest.raises(SweepError, match='another version of the engine'):
        play_regions(str(store.path), store.identity, 'other', [2])
    assert not store.finished().any()


def test_another_folder_gets_nothing(store):
    with pytest.raises(SweepError, match='another folder'):
        play_regions(str(store.path), 'someone else', engine(), [2])
    with pytest.raises(SweepError, match='not there for a worker'):
        play_regions(str(store.path) + 'x', store.identity, engine(), [2])
    assert not store.finished().any()
