"""What a sweep plays, and in which regions."""

import numpy as np
import pytest

from pool_sim_ros.physics import pool_table, report_table
from pool_sim_ros.study.inputs import checked_inputs
from pool_sim_ros.study.plan import checked_plan
from pool_sim_ros.study.ranges import normal, uniform

TABLE = report_table()


def plan(chunk=None, positions=None, samples=None, seed=0, keep=None, balls=None, **inputs):
    inputs = checked_inputs(TABLE, {'speed': 2.0, 'angle': 0.0, **inputs})
    return checked_plan(TABLE, inputs, positions, samples, seed, keep, balls, chunk)


SHAPES = [
    {'angle': np.arange(7.0), 'speed': np.arange(1.0, 6.0)},
    {'angle': np.arange(100.0)},
    {'angle': np.arange(3.0), 'speed': np.arange(1.0, 5.0), 'samples': 5},
    {'angle': uniform(0, 1), 'samples': 11},
    {'e_ball_ball': [0.5, 0.6], 'angle': np.arange(3.0), 'speed': [1.0, 2.0]},
]


@pytest.mark.parametrize('inputs', SHAPES)
@pytest.mark.parametrize('chunk', [1, 4, 7, 1000])
def test_regions_have_each_shot_once_one_after_another(inputs, chunk):
    made = plan(chunk=chunk, **inputs)
    index = np.arange(made.shots).reshape(made.shape)
    seen = []
    for number in range(made.regions):
        region = made.region(number)
        assert region.count <= chunk and region.number == number
        there = index[region.slices].ravel()
        np.testing.assert_array_equal(there, region.first + np.arange(region.count))
        seen.append(there)
    np.testing.assert_array_equal(np.concatenate(seen), np.arange(made.shots))


@pytest.mark.parametrize('chunk', [1, 5, 1000])
def test_the_values_of_a_shot_do_not_depend_on_its_region(chunk):
    inputs = {'angle': np.arange(6.0), 'speed': normal([1.0, 2.0], 0.1)}
    made, whole = plan(chunk=chunk, samples=4, **inputs), plan(chunk=10_000, samples=4, **inputs)
    for name in ('angle', 'speed'):
        parts = [made.values(name, made.region(k)) for k in range(made.regions)]
        assert np.concatenate(parts).tobytes() == whole.values(name, whole.region(0)).tobytes()
    angle = whole.values('angle', whole.region(0)).reshape(whole.shape)
    np.testing.assert_array_equal(angle[0, :, 0], np.arange(6.0))
    assert (angle == angle[:1, :, :1]).all()


def test_dimensions_are_in_order():
    made = plan(
        positions=np.stack([TABLE.positions] * 3), samples=2, angle=[1, 2], e_ball_ball=[0.5, 1]
    )
    assert list(made.sizes.items()) == [
        ('e_ball_ball', 2),
        ('layout', 3),
        ('angle', 2),
        ('sample', 2),
    ]


def test_a_table_with_many_balls_has_smaller_chunks():
    few = plan(angle=np.arange(1e6), keep=['failed'])
    assert few.chunk == 100_000 and plan(angle=[1, 2], chunk=7).chunk == 7


@pytest.mark.parametrize(
    ('wrong', 'said'),
    [
        ({}, 'nothing varies'),
        ({'angle': uniform(0, 1)}, 'samples: it is missing'),
        ({'samples': 0}, 'samples: 0 must be a whole number'),
        ({'samples': 2.5}, 'samples: 2.5'),
        ({'angle': [1, 2], 'seed': -1}, 'seed: -1'),
        ({'angle': [1, 2], 'chunk': 0}, 'chunk: 0'),
        ({'angle': [1, 2], 'keep': ['final']}, "keep: 'final' is no outcome"),
        ({'angle': [1, 2], 'keep': []}, 'keep: name at least one'),
        ({'angle': [1, 2], 'balls': ['99']}, "label: '99'"),
        ({'angle': [1, 2], 'e_ball_ball': 1.5}, 'e_ball_ball: 1.5 must be at most 1'),
        ({'mu_ball_ball': [-1, 2], 'angle': 1}, 'mu_ball_ball: -1.0 must be at least 0'),
        ({'angle': [1, 2], 'positions': [[1, 2]]}, 'positions: must be layouts'),
        ({'angle': [1, 2], 'positions': TABLE.positions * 0}, r'positions\[0\]'),
    ],
)
def test_what_cannot_be_is_told(wrong, said):
    with pytest.raises(ValueError, match=said):
        plan(**wrong)


def test_pockets_are_kept_where_there_are_any():
    assert 'pocketed' not in plan(angle=[1, 2]).keep
    table = pool_table('7ft')
    inputs = checked_inputs(table, {'angle': [1, 2], 'speed': 1})
    assert 'pocketed' in checked_plan(table, inputs, None, None, 0, None, None, None).keep
