"""A window of a sweep, swept anew."""

import numpy as np
import pytest
from sweeping import NAMES, TABLE, assert_same_bits

from pool_sim_ros.study.ranges import uniform
from pool_sim_ros.study.sweeps import sweep
from pool_sim_ros.study.zooms import zoom

GRID = {'angle': np.linspace(150, 210, 7), 'speed': [1.0, 2.0, 3.0], 'e_ball_ball': [0.8, 0.9]}


@pytest.fixture(scope='module')
def dataset():
    return sweep(TABLE, progress=False, balls=['9', 'C'], **GRID)


def test_it_is_the_sweep_of_that_window(dataset):
    found = zoom(dataset.isel(e_ball_ball=1), angle=(170, 180), speed=(1.5, 2.0), points=5)
    given = {'angle': np.linspace(170, 180, 5), 'speed': np.linspace(1.5, 2.0, 5)}
    expected = sweep(TABLE, progress=False, balls=['9', 'C'], e_ball_ball=0.9, **given)
    assert_same_bits(found, expected)


def test_what_is_not_in_the_window_stays(dataset):
    found = zoom(dataset.isel(speed=slice(1)), angle=(170, 180), points=4)
    assert found.sizes == {'e_ball_ball': 2, 'angle': 4, 'speed': 1, 'ball': 2, 'axis': 2}
    assert found.speed.values.tolist() == [1.0]


def test_also_from_disk_and_again(tmp_path, dataset):
    opened = sweep(TABLE, progress=False, balls=['9', 'C'], out=tmp_path / 'a', workers=0, **GRID)
    once = zoom(opened, angle=(170, 180), points=4)
    assert_same_bits(once, zoom(dataset, angle=(170, 180), points=4))
    assert zoom(once, angle=(174, 175), points=3).sizes['angle'] == 3


def test_what_is_drawn_is_drawn_from_the_window():
    drawn = sweep(TABLE, progress=False, angle=uniform(0, 360), speed=2.0, samples=20)
    angle = zoom(drawn, angle=(10, 11)).angle.values
    assert len(angle) == 20 and (angle >= 10).all() and (angle < 11).all()


def test_one_sample_of_a_row_with_layouts():
    layouts = np.stack([TABLE.positions] * 2)
    made = sweep(TABLE, progress=False, samples=3, positions=layouts, **NAMES)
    found = zoom(made.isel(layout=0, sample=0), angle=(170, 180), points=2)
    assert 'layout' not in found.finals.dims and 'sample' not in found.finals.dims


@pytest.mark.parametrize(
    ('window', 'said'),
    [
        ({'anglr': (1, 2)}, 'anglr: it does not vary'),
        ({'angle': (2, 1)}, 'angle: .* must be'),
        ({'angle': 3}, 'angle: 3 must be'),
        ({'angle': (1, np.inf)}, 'angle: '),
        ({'points': 0}, 'points: 0'),
    ],
)
def test_a_window_that_cannot_be(dataset, window, said):
    with pytest.raises(ValueError, match=said):
        zoom(dataset, **window)


def test_only_a_sweep_has_windows(dataset):
    for other in (dataset.finals, dataset.drop_attrs(), 3):
        with pytest.raises(ValueError, match='^dataset: '):
            zoom(other, angle=(1, 2))
