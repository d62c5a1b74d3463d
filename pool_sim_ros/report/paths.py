"""The paths of the balls, drawn into the picture of a shot's end."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.markers import MarkerStyle
from matplotlib.patches import Circle, PathPatch
from matplotlib.transforms import Affine2D

from pool_sim_ros.physics import Ball, EventKind, Trajectory
from pool_sim_ros.report.drawing import PATH_LEVEL, label_outline
from pool_sim_ros.report.played import moved_balls

Dashes = tuple[float, tuple[float, ...]]
"""A pattern of dashes as matplotlib has it: offset, then lengths of dashes and gaps, points."""

DASHES: tuple[Dashes, ...] = (
    (0, ()),
    (0, (5, 2.5)),
    (0, (1.5, 1.5)),
    (0, (7, 2, 1.5, 2)),
    (0, (3, 3)),
    (0, (5, 1.5, 1.5, 1.5, 1.5, 1.5)),
    (0, (10, 3)),
    (0, (1.5, 3.5)),
)
"""One pattern for each ball in turn, so that the lines differ in grey too."""

WIDTH, EDGE = 1.3, 0.55
"""Width of a path, and of the edge on either side of it, points."""

LABEL_ROOM = 0.36
"""Radius of the room that the label of a start takes, as a part of the ball's radius."""

SHORTEST_WITH_ARROW = 2.5
"""A stretch shorter than this has no arrow, in radii of its ball."""

SAMPLES = 33
"""Points at which a stretch is looked up to place its arrow; enough for a curve."""


def draw_paths(axes: Axes, trajectory: Trajectory) -> None:
    """Draw the path of each ball that moved, in the direction that its arrows show.

    A dashed circle with a label is where the ball started.

    Parameters
    ----------
    axes : Axes
        Those of a `TablePicture`, in m.
    trajectory : Trajectory
    """
    paths = {int(index): trajectory.path(index) for index in moved_balls(trajectory)}
    for order, (index, path) in enumerate(paths.items()):
        ball = trajectory.table.balls[index]
        _draw_line(axes, ball, path, DASHES[order % len(DASHES)])
        for place, angle in arrows(trajectory, index):
            _draw_arrow(axes, ball, place, angle)
        _draw_start(axes, ball, _label_place(trajectory, paths, index))


def arrows(trajectory: Trajectory, index: int) -> Iterator[tuple[np.ndarray, float]]:
    """Yield the arrows of one ball: one for each stretch from contact to contact.

    Parameters
    ----------
    trajectory : Trajectory
    index : int
        Of the ball.

    Yields
    ------
    place : ndarray of shape (2,)
        The middle of the stretch along its length, m.
    angle : float
        The direction of the motion there, rad from the x axis.
    """
    radius = trajectory.table.balls[index].radius
    ends = [0.0, *_contact_times(trajectory, index), trajectory.duration]
    times = np.linspace(ends[:-1], ends[1:], SAMPLES, axis=1)
    places = trajectory.positions(times.ravel())[:, index].reshape(*times.shape, 2)
    for points in places:
        steps = np.diff(points, axis=0)
        travelled = np.concatenate([[0.0], np.cumsum(np.hypot(*steps.T))])
        length = travelled[-1]
        if length < SHORTEST_WITH_ARROW * radius:
            continue
        step = int(np.searchsorted(travelled, 0.5 * length, side='right')) - 1
        share = (0.5 * length - travelled[step]) / (travelled[step + 1] - travelled[step])
        direction = math.atan2(steps[step, 1], steps[step, 0])
        yield points[step] + share * steps[step], direction


def _contact_times(trajectory: Trajectory, index: int) -> np.ndarray:
    """Return when a ball meets a cushion or another ball, (k,) in s."""
    events = trajectory.events
    with_ball = events['kind'] == EventKind.BALL_BALL
    as_first = (events['a'] == index) & (with_ball | (events['kind'] == EventKind.CUSHION))
    as_second = (events['b'] == index) & with_ball
    times: np.ndarray = events['t'][as_first | as_second]
    return times


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
    outline = label_outline(ball.label, 2 * LABEL_ROOM * ball.radius)
    if label_place is not None and np.size(outline.vertices):
        axes.add_patch(
            PathPatch(
                outline,
                facecolor='black',
                linewidth=0.0,
                transform=Affine2D().translate(*label_place) + axes.transData,
                zorder=PATH_LEVEL,
            )
        )


def _label_place(
    trajectory: Trajectory, paths: Mapping[int, np.ndarray], index: int
) -> np.ndarray | None:
    """Return the place of the label of a start, (2,) in m; None where there is no room.

    The best place is behind the start, within its circle. The next best is the nearest one that
    no ball and no path covers.
    """
    table = trajectory.table
    start, radius = paths[index][0], table.balls[index].radius
    room, size = LABEL_ROOM * radius, np.array([table.length, table.width])
    first_step = paths[index][1] - start
    behind = math.atan2(-first_step[1], -first_step[0])
    for distance in (0.52 * radius, 0.68 * radius, 1.45 * radius):
        for turn in sorted(np.radians(np.arange(-165, 181, 15)), key=abs):
            direction = np.array([math.cos(behind + turn), math.sin(behind + turn)])
            place: np.ndarray = start + distance * direction
            off_balls = np.hypot(*(trajectory.final_positions - place).T) > table.radii + room
            off_starts = [
                np.hypot(*(paths[other][0] - place)) > table.radii[other]
                for other in paths
                if other != index
            ]
            off_paths = [distance_to(place, path) > 0.8 * room for path in paths.values()]
            on_table = np.abs(place - size / 2) < size / 2 - room
            if all((*off_balls, *off_starts, *off_paths, *on_table)):
                return place
    return None


def distance_to(point: np.ndarray, path: np.ndarray) -> float:
    """Return the distance of a point from a path.

    Parameters
    ----------
    point : ndarray of shape (2,)
        m.
    path : ndarray of shape (k, 2)
        m; k > 1, and no point twice in a row.

    Returns
    -------
    float
        m.
    """
    starts, steps = path[:-1], np.diff(path, axis=0)
    along = np.sum((point - starts) * steps, axis=1) / np.sum(steps**2, axis=1)
    nearest = starts + np.clip(along, 0.0, 1.0)[:, np.newaxis] * steps
    return float(np.hypot(*(point - nearest).T).min())


def _draw_line(axes: Axes, ball: Ball, path: np.ndarray, dashes: Dashes) -> None:
    x, y = path.T
    edge = Line2D(x, y, color=_edge_color(ball), linewidth=WIDTH + 2 * EDGE, zorder=PATH_LEVEL)
    line = Line2D(x, y, color=ball.color, linewidth=WIDTH, linestyle=dashes, zorder=PATH_LEVEL)
    for artist in (edge, line):
        artist.set_solid_joinstyle('round')
        artist.set_solid_capstyle('butt')
        artist.set_dash_joinstyle('round')
        artist.set_dash_capstyle('butt')
        axes.add_line(artist)


def _draw_arrow(axes: Axes, ball: Ball, place: np.ndarray, angle: float) -> None:
    triangle = MarkerStyle((3, 0, 0)).rotated(rad=angle - math.pi / 2)
    axes.add_line(
        Line2D(
            [place[0]],
            [place[1]],
            marker=triangle,
            markersize=6.0,
            markerfacecolor=ball.color,
            markeredgecolor=_edge_color(ball),
            markeredgewidth=EDGE,
            zorder=PATH_LEVEL,
        )
    )


def _edge_color(ball: Ball) -> str:
    """Return black, or white around a dark ball (luma, ITU-R BT.601)."""
    red, green, blue = ball.color
    return 'white' if 0.299 * red + 0.587 * green + 0.114 * blue < 0.35 else 'black'
