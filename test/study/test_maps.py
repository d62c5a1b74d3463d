"""Pictures of sweeps show what is in the dataset."""

import numpy as np
import pytest
from sweeping import TABLE

from pool_sim_ros.physics import pool_table
from pool_sim_ros.study.ranges import uniform
from pool_sim_ros.study.sweeps import sweep

matplotlib = pytest.importorskip('matplotlib')
matplotlib.use('Agg')

from matplotlib import pyplot  # noqa: E402

from pool_sim_ros.study.maps import NOTHING, plot  # noqa: E402

GRID = {'angle': np.linspace(150, 210, 8), 'speed': [0.1, 2.0, 3.0]}


@pytest.fixture(scope='module')
def dataset():
    return sweep(TABLE, progress=False, **GRID)


@pytest.fixture(autouse=True)
def close():
    yield
    pyplot.close('all')


def colours_of(axes):
    """Return the colours that are drawn, (rows, columns, 3 or none)."""
    return axes.collections[0].get_array()


def test_which_ball_is_hit_first(dataset):
    axes = plot(dataset, 'first_hit')
    shown, hit = np.asarray(colours_of(axes)), dataset.first_hit.transpose('speed', 'angle').values
    for number in np.unique(hit):
        wanted = NOTHING if number == -1 else matplotlib.colormaps['tab20'](number % 20)[:3]
        np.testing.assert_allclose(
            shown[hit == number], np.broadcast_to(wanted, (np.sum(hit == number), 3))
        )
    names = {text.get_text() for text in axes.get_legend().get_texts()}
    assert 'none' in names and 'ball 1' in names
    assert axes.get_xlabel() == 'angle, degree' and axes.get_ylabel() == 'speed, m/s'


def test_where_a_ball_ends_has_the_colours_of_the_table_beside_it(dataset):
    axes = plot(dataset, ball='C')
    shown = np.asarray(colours_of(axes))
    ends = dataset.finals.sel(ball='C').transpose('speed', 'angle', 'axis').values
    order = np.argsort(ends[..., 0].ravel())
    assert (np.diff(shown[..., 0].ravel()[order]) >= 0).all()
    (key,) = axes.child_axes
    assert key.images[0].get_extent() == [0, TABLE.length, 0, TABLE.width]
    assert axes.get_title() == 'where ball C ends'


def test_in_which_pocket_a_ball_falls():
    table = pool_table('7ft')
    data = sweep(table, angle=np.linspace(0, 360, 40), speed=[1.0, 5.0], progress=False)
    axes = plot(data, 'pocketed', ball='C')
    names = {text.get_text() for text in axes.get_legend().get_texts()}
    caught = np.unique(data.pocketed.sel(ball='C').values)
    assert names == {'stays' if k < 0 else f'pocket {k}' for k in caught} and len(names) > 1


@pytest.mark.parametrize('what', ['durations', 'event_counts', 'failed'])
def test_the_other_outcomes(dataset, what):
    axes = plot(dataset, what, x='speed', y='angle')
    assert axes.get_xlabel() == 'speed, m/s'
    if what != 'failed':
        np.testing.assert_array_equal(
            colours_of(axes), dataset[what].transpose('angle', 'speed').values
        )
    axes.figure.canvas.draw()


def test_random_shots_are_points():
    data = sweep(TABLE, progress=False, angle=uniform(0, 360), speed=uniform(1, 2), samples=50)
    axes = plot(data, 'first_hit', y='angle')
    np.testing.assert_array_equal(
        axes.collections[0].get_offsets(), np.stack([data.speed, data.angle], axis=1)
    )


def test_a_window_that_somebody_zooms_into_is_swept_anew(dataset):
    axes = plot(dataset, 'first_hit', live=True)
    axes.figure.canvas.draw()
    assert colours_of(axes).shape[:2] == (3, 8)
    axes.set(xlim=(170, 175), ylim=(1.0, 2.0))
    axes.figure.canvas.draw()
    assert colours_of(axes).shape[0] > 100
    assert axes.get_xlim() == (170, 175) and axes.get_ylim() == (1.0, 2.0)


@pytest.mark.parametrize(
    ('given', 'said'),
    [
        ({'what': 'ends'}, "what: 'ends' must be one of"),
        ({'what': 'pocketed'}, "what: 'pocketed' was not kept"),
        ({'ball': '99'}, "ball: '99' was not kept"),
        ({'x': 'side'}, "x, y: 'side' does not vary"),
        ({'x': 'angle', 'y': 'angle'}, 'given for both'),
    ],
)
def test_what_cannot_be_drawn(dataset, given, said):
    with pytest.raises(ValueError, match=said):
        plot(dataset, **given)


def test_a_picture_has_two_inputs(dataset):
    with pytest.raises(ValueError, match='two inputs must vary, but there is angle'):
        plot(dataset.isel(speed=0))
    more = sweep(TABLE, progress=False, e_ball_ball=[0.8, 0.9], **GRID)
    with pytest.raises(ValueError, match=r'speed varies too; choose one value'):
        plot(more)
    assert plot(more.isel(speed=1)).get_ylabel() == 'angle, degree'
