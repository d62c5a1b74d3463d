"""Pictures and films of a shot."""

import builtins

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import pytest  # noqa: E402
from matplotlib.patches import Circle  # noqa: E402

from pool_sim_ros.physics import pool_table, report_table, simulate  # noqa: E402

# A film of which only some frames are drawn.
pytestmark = pytest.mark.filterwarnings('ignore:Animation was deleted')


@pytest.fixture(scope='module')
def shot():
    return simulate(report_table(), (-4.0, 0.0))


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close('all')


def bodies(axes):
    """Return the filled circles of the balls."""
    circles = [patch for patch in axes.patches if isinstance(patch, Circle)]
    return [circle for circle in circles if circle.get_fill() and circle.get_zorder() == 4]


def test_a_plot_shows_paths_ends_and_labels(shot):
    axes = shot.plot()
    assert [body.center for body in bodies(axes)] == [tuple(p) for p in shot.final_positions]
    assert [text.get_text() for text in axes.texts] == list(shot.table.labels)
    moved = [k for k in range(11) if len(shot.path(k)) > 1]
    drawn = {line.get_xydata().tobytes() for line in axes.lines}
    assert drawn == {shot.path(k).tobytes() for k in moved} and len(moved) > 3
    axes.figure.canvas.draw()


def test_a_plot_goes_into_the_axes_that_are_given(shot):
    _, (left, right) = plt.subplots(1, 2)
    assert shot.plot(right) is right and shot.plot(axes=left) is left
    assert len(plt.get_fignums()) == 1


def test_a_table_with_pockets_shows_them_and_its_cushions():
    table = pool_table('7ft')
    axes = simulate(table, (0.1, 0.0)).plot()
    holes = {c.center for c in axes.patches if isinstance(c, Circle) and c.get_zorder() == 1}
    assert holes >= {(x, y) for x, y, _ in table.pockets}
    assert len(axes.collections[0].get_segments()) == len(table.cushions.segments)
    for x, y, radius in table.pockets:
        assert axes.get_xlim()[0] < x - radius and x + radius < axes.get_xlim()[1]
        assert axes.get_ylim()[0] < y - radius and y + radius < axes.get_ylim()[1]


def test_a_film_shows_the_balls_where_they_are(shot):
    film = shot.animate(speed=2.0, fps=10.0)
    film._draw_was_started = True
    frames = list(film.new_frame_seq())
    assert len(frames) == int(np.ceil(shot.duration / 2.0 * 10.0)) + 1
    for frame in (0, 3, frames[-1]):
        film._draw_frame(frame)
        places = shot.positions(min(0.2 * frame, shot.duration))
        centres = [body.center for body in bodies(film._whole.axes[0])]
        assert np.array(centres) == pytest.approx(places)


def test_a_film_may_be_a_part_of_a_figure(shot):
    parts = plt.figure().subfigures(1, 2)
    film = shot.animate(fps=1.0, axes=parts[1].subplots())
    assert film._whole is parts[0].figure
    film._draw_was_started = True  # else matplotlib warns, once nobody filters it any more


def test_a_notebook_shows_a_film_once():
    shot = simulate(report_table(), (-0.3, 0.0))
    html = shot.animate(fps=4.0)._repr_html_()
    assert '<img' in html and 'data:image/png;base64' in html
    assert not plt.get_fignums()


@pytest.mark.parametrize(
    ('given', 'message'),
    [
        (dict(speed=0.0), '^speed: 0.0 must be above 0$'),
        (dict(fps=-3), '^fps: -3.0 must be above 0$'),
        (dict(fps='fast'), "^fps: 'fast' is not a number$"),
        (dict(speed=1e-4), '^fps: .* frames are more than 2000; lower fps, or raise speed$'),
    ],
)
def test_a_film_that_cannot_be_is_refused(shot, given, message):
    with pytest.raises(ValueError, match=message):
        shot.animate(**given)
    assert not plt.get_fignums()


@pytest.mark.parametrize('name', ['plot', 'animate'])
def test_without_matplotlib_one_line_names_the_extra(shot, name, monkeypatch):
    monkeypatch.delitem(__import__('sys').modules, 'pool_sim_ros.physics.pictures', raising=False)
    found = builtins.__import__

    def without(module, *args, **kwargs):
        if module.partition('.')[0] == 'matplotlib':
            raise ModuleNotFoundError("No module named 'matplotlib'", name='matplotlib')
        return found(module, *args, **kwargs)

    monkeypatch.setattr(builtins, '__import__', without)
    with pytest.raises(ModuleNotFoundError) as caught:
        getattr(shot, name)()
    assert str(caught.value) == (
        f'{name}() needs matplotlib, not installed here: pip install matplotlib '
        '(the extra plot has all that it needs)'
    )
