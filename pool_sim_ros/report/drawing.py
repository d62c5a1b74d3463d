"""Pictures of a table: the cloth, and the balls as in Listing 3.

Everything is drawn to scale in metres, labels too, so a picture is the same at every size.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import IO

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Circle, PathPatch, Rectangle
from matplotlib.path import Path
from matplotlib.textpath import TextPath, text_to_path
from matplotlib.transforms import Affine2D

from pool_sim_ros.physics import Ball, Table

DPI = 600
"""Dots per inch of the report's pictures (Listing 2, line 81)."""

LONG_SIDE = 6.5
"""Longer side of a picture, inches: the width of a printed page between its margins."""

CLOTH = (0.5, 1.0, 0.5)
"""MATLAB's 'g' at an opacity of 0.5 on white."""

MARGIN = 0.01
"""White around the table, as a part of its longer side."""

CLOTH_LEVEL, PATH_LEVEL, BALL_LEVEL = 0, 1, 2
"""Levels of drawing: the higher over the lower."""


class TablePicture:
    """A table from above.

    Parameters
    ----------
    table : Table
    axes : Axes, optional
        Where to draw; by default a new figure, `LONG_SIDE` long.

    Attributes
    ----------
    figure : Figure
    axes : Axes
        In m.
    balls : list of Artist
        In the order of drawing.
    """

    def __init__(self, table: Table, axes: Axes | None = None) -> None:
        self.table = table
        self.axes = _table_axes(table) if axes is None else axes
        figure = self.axes.get_figure()
        assert isinstance(figure, Figure)
        self.figure = figure
        self._places = [Affine2D() for _ in table.balls]
        self.axes.set_axis_off()
        self.axes.set_aspect('equal')
        margin = MARGIN * max(table.length, table.width)
        self.axes.set(xlim=(-margin, table.length + margin), ylim=(-margin, table.width + margin))
        self.axes.add_patch(
            Rectangle(
                (0.0, 0.0),
                table.length,
                table.width,
                facecolor=CLOTH,
                edgecolor='black',
                linewidth=0.8,
                zorder=CLOTH_LEVEL,
            )
        )
        self.balls: list[Artist] = []
        for ball, place in zip(table.balls, self._places, strict=True):
            for artist in _ball_artists(ball):
                artist.set_transform(place + self.axes.transData)
                self.balls.append(self.axes.add_artist(artist))
        self.place(table.positions)

    def place(self, positions: np.ndarray) -> None:
        """Move the balls to `positions`, (n, 2) in m."""
        for place, (x, y) in zip(self._places, positions, strict=True):
            place.clear().translate(x, y)

    def save(self, file: IO[bytes] | str, image_format: str, dpi: float = DPI) -> None:
        """Write the picture; `image_format` is ``png`` or ``svg``."""
        save_figure(self.figure, file, image_format, dpi)


def save_figure(figure: Figure, file: IO[bytes] | str, image_format: str, dpi: float = DPI) -> None:
    """Write a figure; the same figure gives the same bytes.

    Parameters
    ----------
    figure : Figure
    file : binary file or str
    image_format : {'png', 'svg'}
    dpi : float, optional
        Dots per inch.
    """
    metadata = {'Date': None} if image_format == 'svg' else {'Software': None}
    with matplotlib.rc_context({'svg.hashsalt': 'pool_sim_ros'}):
        figure.savefig(file, format=image_format, dpi=dpi, facecolor='white', metadata=metadata)


def empty_figure(width: float, height: float) -> Figure:
    """Return an empty figure, width and height in inches, that needs no window."""
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    return figure


def label_outline(label: str, size: float) -> Path:
    """Return the outline of a label in bold type, centred on the origin, that fits a circle.

    Characters that cannot be printed are left out.

    Parameters
    ----------
    label : str
    size : float
        Diameter of the circle, m.
    """
    text = ''.join(filter(str.isprintable, label)).replace('$', r'\$')
    with warnings.catch_warnings():
        warnings.simplefilter('ignore')  # a character that the font has not is a box
        if not len(text_to_path.get_text_path(_BOLD, text)[0]):
            return Path(np.empty((0, 2)))
        outline = TextPath((0.0, 0.0), text, 1.0, prop=_BOLD)
    box = outline.get_extents()
    scale = size / max(np.hypot(box.width, box.height), _LEAST_DIAGONAL)
    centre = (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2
    return Affine2D().translate(-centre[0], -centre[1]).scale(scale).transform_path(outline)


_BOLD = FontProperties(family='DejaVu Sans', weight='bold')
_LEAST_DIAGONAL = 1.15
"""Least diagonal of a label at size 1, so that one character is not larger than two."""


def _ball_artists(ball: Ball) -> Sequence[Artist]:
    """Return a ball around the origin: body, white spot, blue label (Listing 3, lines 50 to 52)."""
    body = Circle((0.0, 0.0), ball.radius, facecolor=ball.color, edgecolor='black', linewidth=0.5)
    spot = Circle((0.0, 0.0), ball.radius / 2, facecolor='white', linewidth=0.0)
    outline = label_outline(ball.label, 0.9 * ball.radius)
    label = PathPatch(outline, facecolor='blue', linewidth=0.0)
    for artist in (body, spot, label):
        artist.set_zorder(BALL_LEVEL)
    return body, spot, label


def _table_axes(table: Table) -> Axes:
    margin = 2 * MARGIN * max(table.length, table.width)
    width, height = table.length + margin, table.width + margin
    inches = LONG_SIDE / max(width, height)
    return empty_figure(width * inches, height * inches).add_axes((0.0, 0.0, 1.0, 1.0))
