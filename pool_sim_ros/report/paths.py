"""The ways that the balls went, drawn into the picture of a shot's end."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, PathPatch
from matplotlib.transforms import Affine2D

from pool_sim_ros.physics import Ball, Trajectory
from pool_sim_ros.report.drawing import PATH_LEVEL, label_outline
from pool_sim_ros.report.played import moved_balls

DASHES = (
    (0, ()),
    (0, (5, 2.5)),
    (0, (1.5, 1.5)),
    (0, (7, 2, 1.5, 2)),
    (0, (3, 3)),
    (0, (5, 1.5, 1.5, 1.5, 1.5, 1.5)),
    (0, (10, 3)),
    (0, (1.5, 3.5)),
)
"""Patterns of the lines, one ball after the other, so that they differ in grey too."""

WIDTH, EDGE = 1.3, 0.55
"""Width of a path, and of the edge on either side of it, points."""

LABEL_ROOM = 0.36
"""Radius of the room that the label of a start takes, as a part of the ball's radius."""


def draw_paths(axes: Axes, trajectory: Trajectory) -> None:
    """Draw where each ball that moved came from and which way it went.

    A dashed circle with a label is where it started; arrows show the direction.
    """
    ways = {index: trajectory.path(index) for index in moved_balls(trajectory)}
    for order, (index, corners) in enumerate(ways.items()):
        ball = trajectory.table.balls[index]
        _draw_line(axes, ball, corners, DASHES[order % len(DASHES)])
        _draw_arrows(axes, ball, corners)
        _draw_start(axes, ball, _label_place(trajectory, ways, index))


def _draw_start(axes: Axes, ball: Ball, label_place: np.ndarray | None) -> None:
    axes.add_patch(
        Circle(
            ball.position,
            ball.radius,
            facecolor='none',
            edgecolor='black',
            linewidth=0.6,
            linestyle=(0, (3, 2)),
            zorder=PATH_LEVEL,
        )
    )
    if label_place is not None:
        axes.add_patch(
            PathPatch(
                label_outline(ball.label, 2 * LABEL_ROOM * ball.radius),
                facecolor='black',
                linewidth=0.0,
                transform=Affine2D().translate(*label_place) + axes.transData,
                zorder=PATH_LEVEL,
            )
        )


def _label_place(
    trajectory: Trajectory, ways: dict[int, np.ndarray], index: int
) -> np.ndarray | None:
    """Return where to write which ball started here, (2,) in m; None where there is no room.

    Best behind the start, within its circle; else as near to that as no ball and no path is.
    """
    table = trajectory.table
    start, radius = ways[index][0], table.balls[index].radius
    room, size = LABEL_ROOM * radius, np.array([table.length, table.width])
    first_step = ways[index][1] - start
    behind = math.atan2(-first_step[1], -first_step[0])
    for distance in (0.52 * radius, 0.68 * radius, 1.45 * radius):
        for turn in sorted(np.radians(np.arange(-165, 181, 15)), key=abs):
            place = start + distance * np.array([math.cos(behind + turn), math.sin(behind + turn)])
            off_balls = np.hypot(*(trajectory.final_positions - place).T) > table.radii + room
            off_starts = [
                np.hypot(*(ways[other][0] - place)) > table.radii[other]
                for other in ways
                if other != index
            ]
            off_paths = [_distance(place, corners) > 0.8 * room for corners in ways.values()]
            on_table = np.abs(place - size / 2) < size / 2 - room
            if all((*off_balls, *off_starts, *off_paths, *on_table)):
                return place
    return None


def _distance(point: np.ndarray, corners: np.ndarray) -> float:
    """Return how far a point is from a line through `corners`, m."""
    starts, steps = corners[:-1], np.diff(corners, axis=0)
    along = np.sum((point - starts) * steps, axis=1) / np.sum(steps**2, axis=1)
    nearest = starts + np.clip(along, 0.0, 1.0)[:, np.newaxis] * steps
    return float(np.hypot(*(point - nearest).T).min())


def _draw_line(axes: Axes, ball: Ball, corners: np.ndarray, dashes: tuple) -> None:
    style = {'solid_joinstyle': 'round', 'solid_capstyle': 'butt', 'zorder': PATH_LEVEL}
    x, y = corners.T
    axes.add_line(Line2D(x, y, color=_edge_color(ball), linewidth=WIDTH + 2 * EDGE, **style))
    axes.add_line(
        Line2D(
            x,
            y,
            color=ball.color,
            linewidth=WIDTH,
            linestyle=dashes,
            dash_capstyle='butt',
            dash_joinstyle='round',
            **style,
        )
    )


def _draw_arrows(axes: Axes, ball: Ball, corners: np.ndarray) -> None:
    steps = np.diff(corners, axis=0)
    for start, step in zip(corners, steps, strict=False):
        if np.hypot(*step) < 2.5 * ball.radius:
            continue
        x, y = start + 0.5 * step
        angle = math.degrees(math.atan2(step[1], step[0]))
        axes.add_line(
            Line2D(
                [x],
                [y],
                marker=(3, 0, angle - 90.0),
                markersize=6.0,
                markerfacecolor=ball.color,
                markeredgecolor=_edge_color(ball),
                markeredgewidth=EDGE,
                zorder=PATH_LEVEL,
            )
        )


def _edge_color(ball: Ball) -> str:
    """Black, or white around a ball's colour that is itself dark (luma, ITU-R BT.601)."""
    red, green, blue = ball.color
    return 'white' if 0.299 * red + 0.587 * green + 0.114 * blue < 0.35 else 'black'
