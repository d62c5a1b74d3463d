"""Pictures of a sweep, by matplotlib: what comes of a shot over two of its inputs."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.extras import needs
from pool_sim_ros.physics import Table, table_from_fields
from pool_sim_ros.study.outcome_arrays import STORED
from pool_sim_ros.study.zooms import zoom

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

WHATS = ('finals', 'first_hit', 'pocketed', 'durations', 'event_counts', 'failed')

MOST_POINTS = 100_000
"""Points of a picture of random shots: more would only cover one another."""

MOST_PIXELS = 600
"""Along each side of a window that is swept anew while somebody zooms."""

NOTHING = (0.88, 0.88, 0.88)
"""Colour of no ball, no pocket, and of shots that failed."""


def plot(
    dataset: xarray.Dataset,
    what: str = 'finals',
    *,
    ball: str | None = None,
    x: str | None = None,
    y: str | None = None,
    axes: Axes | None = None,
    live: bool = False,
) -> Axes:
    """Draw what comes of a shot over two inputs of a sweep (extra `plot`).

    Parameters
    ----------
    dataset : xarray.Dataset
        Of `sweep`, `open_sweep` or `zoom`.
    what : {'finals', 'first_hit', 'pocketed', 'durations', 'event_counts', 'failed'}, optional
        Where a ball ends, coloured as the table in the corner is; which ball the cue ball hits
        first; in which pocket a ball falls; or a number.
    ball : str, optional
        The label of the ball, for `finals` and `pocketed`; by default the last.
    x, y : str, optional
        The inputs along the axes; by default the first two that vary.
    axes : matplotlib.axes.Axes, optional
        Where to draw; by default on a new figure.
    live : bool, optional
        Whether a window that somebody zooms into is swept anew, as finely as the screen shows.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        For what the dataset has not, and where more than two of its inputs vary.
    ModuleNotFoundError
        Where matplotlib is not installed.
    """
    if what not in WHATS:
        raise ValueError(f'what: {what!r} must be one of {", ".join(map(repr, WHATS))}')
    if what not in dataset:
        kept = ', '.join(name for name in WHATS if name in dataset)
        raise ValueError(f'what: {what!r} was not kept in this dataset; it has {kept}')
    names = _axes_of(dataset, x, y)
    ball = _ball_of(dataset, what, ball)
    with needs('plot()', 'plot'):
        from matplotlib import pyplot
    if axes is None:
        axes = pyplot.subplots(layout='constrained')[1]
    _draw(axes, dataset, what, ball, names)
    if live:
        _follow(axes, dataset, what, ball, names)
    return axes


def _axes_of(dataset: xarray.Dataset, x: str | None, y: str | None) -> tuple[str, str]:
    """Return the names of the inputs along x and y."""
    shots = [str(d) for d in dataset['failed' if 'failed' in dataset else _first(dataset)].dims]
    rows = [d for d in shots if d not in ('ball', 'axis')]
    drawn = [
        str(n) for n in dataset.data_vars if n not in STORED and dataset[n].dims == tuple(rows)
    ]
    known = drawn if rows == ['sample'] else rows
    chosen = [name for name in (x, y) if name is not None]
    for name in chosen:
        if name not in known:
            raise ValueError(f'x, y: {name!r} does not vary here; there are {", ".join(known)}')
    chosen += [name for name in known if name not in chosen]
    if len(chosen) < 2:
        raise ValueError(
            f'dataset: two inputs must vary, but there is {", ".join(known) or "none"}'
        )
    pair = (x or chosen[1 if y == chosen[0] else 0], y or chosen[1 if x != chosen[1] else 0])
    if len(set(pair)) < 2:
        raise ValueError(f'x, y: {pair[0]!r} is given for both')
    left = [name for name in rows if name not in pair]
    if known is rows and left:
        raise ValueError(
            f'dataset: {", ".join(left)} varies too; choose one value, as in '
            f'dataset.isel({left[0]}=0)'
        )
    return pair


def _first(dataset: xarray.Dataset) -> str:
    return next(str(name) for name in WHATS if name in dataset)


def _ball_of(dataset: xarray.Dataset, what: str, ball: str | None) -> str | None:
    if what not in ('finals', 'pocketed'):
        return None
    labels = [str(label) for label in np.atleast_1d(dataset['ball'].values)]
    if ball is not None and ball not in labels:
        raise ValueError(f'ball: {ball!r} was not kept in this dataset; it has {", ".join(labels)}')
    return ball or labels[-1]


def _draw(axes: Axes, dataset: Any, what: str, ball: str | None, names: tuple[str, str]) -> None:
    from matplotlib import colormaps

    axes.clear()
    for child in list(axes.child_axes):
        child.remove()
    table: Table = table_from_fields(json.loads(dataset.attrs['table']))
    array = (
        dataset[what]
        if ball is None or 'ball' not in dataset[what].dims
        else dataset[what].sel(ball=ball)
    )
    if names[0] in dataset[what].dims:
        array = array.transpose(names[1], names[0], ...)
    values = array.values
    title, key = _title(what, ball), None
    if what == 'finals':
        colours = _colours_of_places(values, table)
    elif what in ('first_hit', 'pocketed', 'failed'):
        there = np.unique(values)
        many = colormaps['tab20']
        palette = {int(k): NOTHING if k == -1 else many(int(k) % 20)[:3] for k in there}
        colours = np.array([palette[int(k)] for k in there])[np.searchsorted(there, values)]
        key = {_name(what, int(k), table): palette[int(k)] for k in there}
    else:
        colours = values.astype(float)
    shades = _paint(axes, dataset, names, colours)
    if what == 'finals':
        _add_table(axes, table)
    elif key is not None:
        _add_key(axes, key)
    elif shades is not None:
        _add_bar(axes, shades, f'{title}, {dataset[what].attrs["units"]}')
    axes.set(title=title, xlabel=_label(dataset, names[0]), ylabel=_label(dataset, names[1]))


def _paint(axes: Axes, dataset: Any, names: tuple[str, str], colours: NDArray[Any]) -> Any:
    x, y = (dataset[name].values for name in names)
    if names[0] not in dataset.sizes:
        step = max(len(x) // MOST_POINTS, 1)
        return axes.scatter(x[::step], y[::step], c=colours[::step], s=2, rasterized=True)
    return axes.pcolormesh(x, y, colours, shading='nearest', rasterized=True)


def _colours_of_places(places: NDArray[Any], table: Table) -> NDArray[np.float64]:
    """Return a colour for each place, (..., 2) in m: red grows along x, green along y."""
    u, v = (np.clip(places[..., k] / (table.length, table.width)[k], 0.0, 1.0) for k in (0, 1))
    colours = np.stack([0.1 + 0.85 * u, 0.1 + 0.85 * v, 0.9 - 0.6 * u - 0.2 * v], axis=-1)
    colours[~np.isfinite(u)] = NOTHING
    return colours


def _add_table(axes: Axes, table: Table) -> None:
    """Draw the table with its colours above the picture, as the key to it."""
    key = axes.inset_axes((0.8, 1.02, 0.2, 0.12))
    grid = np.stack(
        np.meshgrid(np.linspace(0, table.length, 60), np.linspace(0, table.width, 30)), -1
    )
    key.imshow(
        _colours_of_places(grid, table), origin='lower', extent=(0, table.length, 0, table.width)
    )
    key.set(xticks=[], yticks=[])


def _add_key(axes: Axes, key: dict[str, Any]) -> None:
    from matplotlib.patches import Patch

    patches = [Patch(color=colour, label=name) for name, colour in key.items()]
    axes.legend(handles=patches, loc='upper left', bbox_to_anchor=(1.01, 1.0), frameon=False)


def _add_bar(axes: Axes, shades: Any, label: str) -> None:
    bar = axes.inset_axes((1.02, 0.0, 0.03, 1.0))
    figure = axes.get_figure()
    assert figure is not None
    figure.colorbar(shades, cax=bar, label=label)


def _name(what: str, number: int, table: Table) -> str:
    if what == 'first_hit':
        return 'none' if number < 0 else f'ball {table.labels[number]}'
    if what == 'pocketed':
        return 'stays' if number < 0 else f'pocket {number}'
    words = {0: 'played', 1: 'bad layout', 2: 'too many events', 3: 'runs away', 4: 'cannot be'}
    return words.get(number, 'not played yet')


def _title(what: str, ball: str | None) -> str:
    return {
        'finals': f'where ball {ball} ends',
        'pocketed': f'the pocket in which ball {ball} falls',
        'first_hit': 'the ball that is hit first',
        'durations': 'time until all rest',
        'event_counts': 'number of events',
        'failed': 'shots that failed',
    }[what]


def _label(dataset: Any, name: str) -> str:
    units = dataset[name].attrs.get('units', '1')
    return name if units == '1' else f'{name}, {units}'


def _follow(
    axes: Axes, dataset: xarray.Dataset, what: str, ball: str | None, names: tuple[str, str]
) -> None:
    """Sweep anew whenever a picture of another window was drawn."""
    seen = (axes.get_xlim(), axes.get_ylim())

    def on_draw(_: object) -> None:
        nonlocal seen
        window = axes.get_xlim(), axes.get_ylim()
        if window == seen:
            return
        box = axes.get_window_extent()
        points = int(min(max(box.width, box.height, 2), MOST_PIXELS))
        ends = {n: (min(w), max(w)) for n, w in zip(names, window, strict=True)}
        _draw(axes, zoom(dataset, points=points, **ends), what, ball, names)
        axes.set(xlim=window[0], ylim=window[1])
        seen = axes.get_xlim(), axes.get_ylim()
        axes.figure.canvas.draw_idle()

    axes.figure.canvas.mpl_connect('draw_event', on_draw)
