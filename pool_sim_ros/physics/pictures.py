"""Pictures and films of a shot, for a notebook or a window. Only this module knows matplotlib."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle
from numpy.typing import NDArray

from pool_sim_ros.physics.validation import number

if TYPE_CHECKING:
    from pool_sim_ros.physics.table import Table
    from pool_sim_ros.physics.trajectory import Trajectory

CLOTH, EDGE, HOLE = (0.5, 0.78, 0.5), 'black', (0.1, 0.1, 0.1)
WIDTH = 8.0
"""Of a new figure, inches."""

MARGIN = 0.02
"""Around the table, as a part of its length."""

MOST_FRAMES = 2000
"""Of a film: more would not fit into a notebook."""


def draw_table(table: Table, axes: Axes | None) -> Axes:
    """Draw cloth, cushions and pockets, in m, into new axes where none are given."""
    if axes is None:
        height = WIDTH * table.width / table.length + 1.0
        axes = plt.subplots(figsize=(WIDTH, height))[1]
    axes.add_patch(Rectangle((0, 0), table.length, table.width, color=CLOTH, zorder=0))
    if table.cushions is None:
        edge = Rectangle((0, 0), table.length, table.width, fill=False, ec=EDGE, zorder=1)
        axes.add_patch(edge)
    else:
        segments = list(table.cushions.segments[:, :4].reshape(-1, 2, 2))
        axes.add_collection(LineCollection(segments, colors=EDGE, linewidths=1.2, zorder=1))
        for x, y, radius in table.cushions.noses:
            axes.add_patch(Circle((x, y), radius, fill=False, ec=EDGE, zorder=1))
    for x, y, radius in table.pockets:
        axes.add_patch(Circle((x, y), radius, color=HOLE, zorder=1))
    low, high = _extent(table)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), xlabel='x (m)', ylabel='y (m)')
    axes.set_aspect('equal')
    return axes


def plot(shot: Trajectory, axes: Axes | None) -> Axes:
    """Draw the path of each ball, where it began, dashed, and where it is at the end."""
    table = shot.table
    axes = draw_table(table, axes)
    starts = shot.positions(0.0)
    for k, ball in enumerate(table.balls):
        path = shot.path(k)
        if len(path) > 1:
            # In the ball's colour, on a dark line: a white or a green path is to be seen too.
            axes.plot(*path.T, color=EDGE, linewidth=1.6, zorder=2)
            axes.plot(*path.T, color=ball.color, linewidth=0.9, zorder=2)
            start = Circle(starts[k], ball.radius, fill=False, ec=EDGE, linestyle='--', zorder=3)
            axes.add_patch(start)
    _draw_balls(table, shot.final_positions, axes)
    axes.set_title(f'{shot.duration:.3g} s, {len(shot.events)} events')
    return axes


class Film(FuncAnimation):
    """The balls as they move; a notebook shows it with a bar to play it by."""

    def __init__(self, shot: Trajectory, speed: float, fps: float, axes: Axes | None) -> None:
        speed, fps = number('speed', speed, above=0.0), number('fps', fps, above=0.0)
        frames = math.ceil(shot.duration / speed * fps) + 1
        if frames > MOST_FRAMES:
            raise ValueError(
                f'fps: {frames} frames are more than {MOST_FRAMES}; lower fps, or raise speed'
            )
        times = np.minimum(np.arange(frames) * speed / fps, shot.duration)
        self._places = shot.positions(times)
        self._times = times
        drawn = draw_table(shot.table, axes)
        self._balls = _draw_balls(shot.table, self._places[0], drawn)
        self._title = drawn.set_title('0.00 s')
        # The axes may be those of a part of a figure.
        self._whole: Figure = drawn.figure.figure
        super().__init__(self._whole, self._show, frames, interval=1000.0 / fps, repeat=False)

    def _show(self, frame: int) -> list[Any]:
        for (body, label), place in zip(self._balls, self._places[frame], strict=True):
            body.center = tuple(place)
            label.set_position(place)
        self._title.set_text(f'{self._times[frame]:.2f} s')
        return [self._title]

    def _repr_html_(self) -> str:
        """Return the film for a notebook, which would else show its first frame beside it."""
        html: str = self.to_jshtml()
        plt.close(self._whole)
        return html


def _draw_balls(table: Table, positions: NDArray[np.float64], axes: Axes) -> list[tuple[Any, Any]]:
    drawn = []
    for ball, place in zip(table.balls, positions, strict=True):
        body = axes.add_patch(
            Circle(tuple(place), ball.radius, fc=ball.color, ec=EDGE, linewidth=0.6, zorder=4)
        )
        light = 0.3 * ball.color[0] + 0.6 * ball.color[1] + 0.1 * ball.color[2]
        label = axes.text(
            float(place[0]),
            float(place[1]),
            # A dollar sign would begin a formula.
            ball.label.replace('$', r'\$'),
            color='black' if light > 0.5 else 'white',
            fontsize=7,
            ha='center',
            va='center',
            clip_on=True,
            zorder=5,
        )
        drawn.append((body, label))
    return drawn


def _extent(table: Table) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    low, high = np.zeros(2), np.array([table.length, table.width])
    if len(table.pockets):
        centres, radii = table.pockets[:, :2], table.pockets[:, 2:]
        low = np.minimum(low, (centres - radii).min(axis=0))
        high = np.maximum(high, (centres + radii).max(axis=0))
    margin = MARGIN * table.length
    return low - margin, high + margin
