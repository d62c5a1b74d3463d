"""The best shots of a plan as markers for RViz and Foxglove: this builds them and sends none."""

from __future__ import annotations

import numpy as np
from geometry_msgs.msg import Point
from visualization_msgs.msg import Marker, MarkerArray

from pool_sim_ros.oracle import Plan, RankedShot
from pool_sim_ros.physics import simulate
from pool_sim_ros.ros.simulator_view import Lying
from pool_sim_ros.ros.table_markers import new_marker, put

SHOWN = 3
"""Shots that are drawn."""

OPACITY = (1.0, 0.5, 0.3)
"""Of the best, and of the next ones."""

PATH_WIDTH = 0.008
PATH_HEIGHT = 0.004
SPOT_THICKNESS = 0.002
"""m."""

STILL = 1e-3
"""A ball whose ends are less than this away from its place, m, is not drawn."""

TEXT_HEIGHT = 0.05
"""m."""


def plan_markers(plan: Plan, lying: Lying, frame_id: str) -> MarkerArray:
    """Return markers of the best shots.

    The array begins with the end of those that were there before. A path is that of the shot
    without noise. Where a ball ends with it lies an ellipse of one standard deviation.

    Parameters
    ----------
    plan : Plan
    lying : Lying
        From which it starts.
    frame_id : str
        Frame of the coordinates.
    """
    markers = list(no_markers(frame_id).markers)
    for rank, shot in enumerate(plan[:SHOWN]):
        for marker in [*_paths(shot, lying, frame_id), *_spots(shot, lying, frame_id)]:
            marker.id += rank * len(lying.table.balls)
            marker.color.a = OPACITY[rank]
            markers.append(marker)
        size = (0.0, 0.0, TEXT_HEIGHT)
        text = new_marker(frame_id, 'plan_chances', rank, Marker.TEXT_VIEW_FACING, size)
        low, high = 100 * shot.low, 100 * shot.high
        text.text = f'{rank + 1}: {100 * shot.chance:.0f} % ({low:.0f} to {high:.0f})'
        put(text, 0.2 * lying.table.length, lying.table.width + (4 - rank) * TEXT_HEIGHT, 0.1)
        markers.append(text)
    return MarkerArray(markers=markers)


def no_markers(frame_id: str) -> MarkerArray:
    """Return what ends all markers of the topic."""
    clean = new_marker(frame_id, '', 0, Marker.ARROW, (0.0, 0.0, 0.0))
    clean.action = Marker.DELETEALL
    return MarkerArray(markers=[clean])


def _paths(shot: RankedShot, lying: Lying, frame_id: str) -> list[Marker]:
    table, positions = lying
    played = simulate(table, shot.velocity, spins=shot.spin, positions=positions)
    markers = []
    for index, ball in enumerate(table.balls):
        path = played.path(index)
        if len(path) > 1:
            size = (PATH_WIDTH, 0.0, 0.0)
            line = new_marker(frame_id, 'plan_paths', index, Marker.LINE_STRIP, size, ball.color)
            line.points = [Point(x=x, y=y, z=PATH_HEIGHT) for x, y in path.tolist()]
            markers.append(line)
    return markers


def _spots(shot: RankedShot, lying: Lying, frame_id: str) -> list[Marker]:
    away = np.hypot(*(shot.mean - lying.positions).T) + np.hypot(*shot.spread.T)
    markers = []
    for index in np.flatnonzero(away > STILL).tolist():  # NaN is no place on the cloth
        ball = lying.table.balls[index]
        size = np.maximum(2.0 * shot.spread[index], PATH_WIDTH).tolist()
        size = (*size, SPOT_THICKNESS)
        spot = new_marker(frame_id, 'plan_ends', index, Marker.CYLINDER, size, ball.color)
        x, y = shot.mean[index].tolist()
        put(spot, x, y, SPOT_THICKNESS)
        markers.append(spot)
    return markers
