"""A sweep on disk: whole or not there, and never mixed with another."""

import json
import shutil

import numpy as np
import pytest
import xarray
from sweeping import DRAWN, NAMES, TABLE, assert_same_bits

from pool_sim_ros.study.inputs import checked_inputs
from pool_sim_ros.study.plan import checked_plan
from pool_sim_ros.study.playing import Player
from pool_sim_ros.study.store import created, opened
from pool_sim_ros.study.sweeps import sweep


def plan_of(chunk=20, seed=0, samples=2, inputs=NAMES):
    return checked_plan(
        TABLE, checked_inputs(TABLE, inputs), None, samples, seed, None, None, chunk
    )


def test_regions_that_are_written_are_finished_and_others_are_not(tmp_path):
    store = created(tmp_path / 'a.zarr', plan_of())
    player = Player(store.plan, 1)
    assert store.plan.regions == 3 and not store.finished().any()
    region = store.plan.region(1)
    store.write(region, player.play(region))
    assert opened(store.path).finished().tolist() == [False, True, False]
    dataset = xarray.open_zarr(store.path)
    assert (dataset.failed[region.slices] == 0).all() and (dataset.failed[0] == -1).all()
    assert np.isnan(dataset.finals[0]).all() and (dataset.first_hit[0] == -1).all()


def test_xarray_opens_it_without_a_warning(tmp_path, recwarn):
    created(tmp_path / 'a.zarr', plan_of())
    dataset = xarray.open_zarr(tmp_path / 'a.zarr')
    assert not recwarn.list
    assert dataset.angle.attrs['units'] == 'degree' and dataset.finals.attrs['units'] == 'm'
    assert dataset.finals.dims == ('angle', 'sample', 'ball', 'axis')
    assert dataset.ball.values.tolist() == list(TABLE.labels)
    assert json.loads(dataset.attrs['table'])['length'] == TABLE.length
    assert {'pool_sim_ros', 'numpy', 'numba', 'engine', 'seed'} <= set(dataset.attrs)


def test_what_a_kill_leaves_changes_nothing(tmp_path):
    """A chunk that is cut short, one that is written but not recorded, and leftovers of zarr."""
    path = tmp_path / 'a.zarr'
    given = {'samples': 2, 'seed': 3, 'progress': False, **NAMES}
    store = created(path, plan_of(seed=3))
    player = Player(store.plan, 1)
    for number in (0, 2):
        store.write(store.plan.region(number), player.play(store.plan.region(number)))
    (path / 'record' / 'finished' / 'c' / '2').unlink()
    cut = path / 'durations' / 'c' / '2' / '0'
    cut.write_bytes(cut.read_bytes()[:10])
    (path / 'finals' / 'c' / '2' / '0' / '0' / '0').unlink()
    (path / 'finals' / 'c' / '1.abc.partial').write_bytes(b'half')
    assert store.finished().tolist() == [True, False, False]
    again = sweep(TABLE, out=path, workers=0, **given)
    assert_same_bits(again.load(), sweep(TABLE, **given))


def test_a_folder_is_there_whole_or_not_at_all(tmp_path, monkeypatch):
    import zarr

    def killed(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(zarr, 'consolidate_metadata', killed)
    with pytest.raises(KeyboardInterrupt):
        created(tmp_path / 'a.zarr', plan_of())
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ('other', 'said'),
    [
        ({'seed': 1}, 'its seed is another'),
        ({'samples': 5}, 'its samples are another'),
        ({'inputs': DRAWN}, 'angle is 30 values from 150 to 210 there and uniform'),
    ],
)
def test_another_sweep_is_left_alone(tmp_path, other, said):
    created(tmp_path / 'a.zarr', plan_of())
    with pytest.raises(FileExistsError, match=said):
        created(tmp_path / 'a.zarr', plan_of(**other))
    assert opened(tmp_path / 'a.zarr').plan.seed == 0


def test_another_engine_does_not_go_on(tmp_path, monkeypatch):
    created(tmp_path / 'a.zarr', plan_of())
    monkeypatch.setattr('pool_sim_ros.study.store.engine', lambda: 'another')
    with pytest.raises(FileExistsError, match='engine'):
        created(tmp_path / 'a.zarr', plan_of())


def test_what_is_no_sweep_is_left_alone(tmp_path):
    file, folder, empty = tmp_path / 'file', tmp_path / 'folder', tmp_path / 'empty'
    file.write_text('mine')
    folder.mkdir(), empty.mkdir()
    (folder / 'mine').write_text('mine')
    for path in (file, folder):
        with pytest.raises(FileExistsError, match='no sweep of this package'):
            created(path, plan_of())
    assert file.read_text() == (folder / 'mine').read_text() == 'mine'
    created(empty, plan_of())


def test_one_opens_only_what_is_there(tmp_path):
    with pytest.raises(FileNotFoundError):
        opened(tmp_path / 'nothing')
    store = created(tmp_path / 'a.zarr', plan_of())
    shutil.rmtree(store.path / 'finals')
    with pytest.raises(ValueError, match='no sweep of this package'):
        opened(store.path)


def test_each_folder_has_an_identity_of_its_own(tmp_path):
    made = [created(tmp_path / name, plan_of()) for name in ('a', 'b')]
    assert made[0].identity != made[1].identity
    assert created(tmp_path / 'a', plan_of()).identity == made[0].identity
