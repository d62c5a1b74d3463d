"""Datasets in memory and from disk are one."""

import numpy as np
import pytest
from sweeping import DRAWN, NAMES, TABLE, assert_same_bits

from pool_sim_ros.physics import simulate_many
from pool_sim_ros.study.datasets import dataset_in_memory, open_sweep
from pool_sim_ros.study.inputs import checked_inputs
from pool_sim_ros.study.plan import checked_plan
from pool_sim_ros.study.sweeps import sweep
from pool_sim_ros.study.tally import Tally


def test_in_memory_it_is_what_simulate_many_plays():
    vx, vy = np.linspace(-4, -1, 7), np.linspace(-0.2, 0.2, 5)
    inputs = checked_inputs(TABLE, {'vx': vx, 'vy': vy})
    plan = checked_plan(TABLE, inputs, None, None, 0, None, None, 6)
    with Tally(plan.shots, 0, False) as tally:
        dataset = dataset_in_memory(plan, tally)
    velocities = np.stack(np.meshgrid(vx, vy, indexing='ij'), axis=-1).reshape(-1, 2)
    expected = simulate_many(TABLE, velocities)
    assert dataset.finals.values.tobytes() == expected.finals.tobytes()
    np.testing.assert_array_equal(dataset.first_hit.values.ravel(), expected.first_hit)
    assert dataset.finals.dims == ('vx', 'vy', 'ball', 'axis')
    assert dataset.sel(ball='9', axis='x').finals.shape == (7, 5)


@pytest.mark.parametrize(
    'inputs',
    [
        {**NAMES, 'samples': 3},
        {**DRAWN, 'samples': 40},
        {**DRAWN, 'samples': 8, 'positions': np.stack([TABLE.positions] * 2), 'balls': ['9']},
    ],
)
def test_on_disk_it_is_the_same(tmp_path, inputs):
    inputs = {**inputs, 'seed': 4, 'progress': False}
    sweep(TABLE, out=tmp_path / 'a.zarr', workers=0, chunk=7, **inputs)
    found, expected = open_sweep(tmp_path / 'a.zarr').load(), sweep(TABLE, **inputs)
    assert_same_bits(found, expected)
    for name in expected.variables:
        assert found[name].attrs == expected[name].attrs
    for name in ('table', 'sweep', 'seed', 'engine', 'pool_sim_ros', 'shots'):
        assert found.attrs[name] == expected.attrs[name]


def test_only_a_sweep_is_opened(tmp_path):
    with pytest.raises(FileNotFoundError):
        open_sweep(tmp_path / 'none')
    with pytest.raises(ValueError, match='no sweep'):
        open_sweep(tmp_path)
