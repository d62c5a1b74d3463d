"""The setup and the construction lines of Part 1, as in the report's Figures 1 and 2."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle

from pool_sim_ros.report.drawing import LONG_SIDE, empty_figure
from pool_sim_ros.report.part_one import Example

A_COLOR, B_COLOR = (1.0, 0.55, 0.55), 'white'
"""Red and white as in the report; the red is light enough to read text on it."""

FONT_SIZE = 11

THIN: dict[str, Any] = {'color': 'black', 'linewidth': 0.8}
GUIDE: dict[str, Any] = {'color': '0.35', 'linewidth': 0.8, 'linestyle': (0, (5, 3))}


def draw_setup(collision: Example) -> Figure:
    """Return Figure 1: the balls before the collision, and the offset of their centres."""
    h, along, left = _frame(collision)
    b = h * np.array([2.3, 1.0])
    a = b - 2.0 * h * along - collision.offset * left
    figure, axes = _axes((-0.6 * h, 3.55 * h), (-0.85 * h, 1.7 * h))
    for centre in (a, b):
        _line(axes, centre - 0.9 * h * along, centre + 3.2 * h * along, **GUIDE)
    _balls(axes, collision, a, b)
    _arrow(axes, a, a + 0.95 * h * along, '->', linewidth=1.8, shrink=True)
    _text(axes, a + 0.98 * h * along + 0.13 * h * left, '$v_a$')
    _text(axes, a - 0.17 * h * left, '$m_a,\\ r_a$')
    _text(axes, b - 0.17 * h * left, '$m_b,\\ r_b$')
    end = b + 0.85 * h * along
    _arrow(axes, end, end - collision.offset * left, '<->')
    _text(axes, end - 0.5 * collision.offset * left + 0.1 * h * along, '$e$')
    _coordinates(axes, h * np.array([-0.4, 0.95]), 0.4 * h)
    return figure


def draw_construction(collision: Example) -> Figure:
    """Return Figure 2: the balls at impact, with the lines and angles of Equation 4."""
    h, along, left = _frame(collision)
    a = np.zeros(2)
    normal = _direction(collision.impact_angle)
    tangent = np.array([-normal[1], normal[0]])
    b, contact = h * normal, collision.a.radius * normal
    foot = b - collision.offset * left
    up = np.array([0.0, 1.0])
    figure, axes = _axes((-1.55 * h, 2.45 * h), (-0.75 * h, 1.6 * h))
    _balls(axes, collision, a, b)
    _line(axes, a - 1.15 * h * along, a + 2.2 * h * along, **GUIDE)
    _line(axes, a, a + 1.4 * h * up, **GUIDE)
    _line(axes, contact - 0.9 * h * tangent, contact + 0.5 * h * tangent, **GUIDE)
    _line(axes, a, b + 0.65 * h * normal, **GUIDE)
    _line(axes, a, b, **THIN)
    _line(axes, b, foot, **THIN)
    _right_angle(axes, foot, -along, left, 0.07 * h)
    _arrow(axes, a - 1.15 * h * along, a - 0.55 * h * along, '->', linewidth=1.8)
    _text(axes, a - 1.0 * h * along + 0.13 * h * left, '$v_a$')
    _text(axes, a + 1.47 * h * up, '$y$')
    _text(axes, b + 0.72 * h * normal, '$n$')
    _text(axes, contact + 0.57 * h * tangent, '$t$')
    _text(axes, 0.3 * b + 0.09 * h * tangent, '$h$')
    _text(axes, (b + foot) / 2 + 0.09 * h * along, '$e$')
    _angle(axes, (collision.impact_angle, collision.velocity_angle), 0.42 * h)
    _text(
        axes,
        0.34 * h * _direction(collision.velocity_angle - 0.45 * collision.offset_angle),
        '$\\theta$',
    )
    # The other two angles begin at the y axis; their names stand on its free side.
    for angle, radius, name in (
        (collision.impact_angle, 0.92, 'impact'),
        (collision.velocity_angle, 1.24, 'velocity'),
    ):
        _angle(axes, (0.0, angle), radius * h)
        label = f'$\\theta_{{\\mathrm{{{name}}}}}$'
        axes.text(-0.05 * h, radius * h, label, ha='right', va='center', fontsize=FONT_SIZE)
    return figure


def _frame(collision: Example) -> tuple[float, np.ndarray, np.ndarray]:
    """Return the distance of the centres, and unit vectors along a's motion and to its left."""
    along = _direction(collision.velocity_angle)
    return collision.reach, along, np.array([-along[1], along[0]])


def _direction(angle: float) -> np.ndarray:
    """Return the unit vector at an angle in rad from the y axis towards x."""
    return np.array([math.sin(angle), math.cos(angle)])


def _axes(xlim: tuple[float, float], ylim: tuple[float, float]) -> tuple[Figure, Axes]:
    height = LONG_SIDE * (ylim[1] - ylim[0]) / (xlim[1] - xlim[0])
    figure = empty_figure(LONG_SIDE, height)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=xlim, ylim=ylim)
    axes.set_axis_off()
    return figure, axes


def _balls(axes: Axes, collision: Example, a: np.ndarray, b: np.ndarray) -> None:
    for centre, ball, color in ((a, collision.a, A_COLOR), (b, collision.b, B_COLOR)):
        axes.add_patch(
            Circle(
                (centre[0], centre[1]), ball.radius, facecolor=color, edgecolor='black', zorder=0.5
            )
        )
        axes.plot(*centre, 'k.', markersize=3)


def _line(axes: Axes, start: np.ndarray, end: np.ndarray, **style: Any) -> None:
    axes.plot(*np.transpose([start, end]), **style)


def _arrow(
    axes: Axes,
    start: np.ndarray,
    end: np.ndarray,
    style: str,
    linewidth: float = 0.8,
    shrink: bool = False,
) -> None:
    axes.annotate(
        '',
        (end[0], end[1]),
        (start[0], start[1]),
        arrowprops={
            'arrowstyle': style,
            'linewidth': linewidth,
            'shrinkA': 4 if shrink else 0,
            'shrinkB': 0,
        },
    )


def _text(axes: Axes, place: np.ndarray, text: str) -> None:
    axes.text(place[0], place[1], text, ha='center', va='center', fontsize=FONT_SIZE)


def _angle(axes: Axes, angles: tuple[float, float], radius: float) -> None:
    """Draw an arc around the origin between two directions, rad from the y axis towards x."""
    start, end = (90.0 - math.degrees(angle) for angle in reversed(angles))
    axes.add_patch(Arc((0.0, 0.0), 2 * radius, 2 * radius, theta1=start, theta2=end, linewidth=0.8))


def _right_angle(
    axes: Axes, corner: np.ndarray, one: np.ndarray, other: np.ndarray, size: float
) -> None:
    corners = [corner + size * one, corner + size * (one + other), corner + size * other]
    axes.plot(*np.transpose(corners), **THIN)


def _coordinates(axes: Axes, origin: np.ndarray, length: float) -> None:
    for direction, name in ((np.array([1.0, 0.0]), '$x$'), (np.array([0.0, 1.0]), '$y$')):
        _arrow(axes, origin, origin + length * direction, '->')
        _text(axes, origin + 1.22 * length * direction, name)
