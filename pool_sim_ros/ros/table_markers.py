"""What never changes on a table, as markers: cloth, cushions, noses and pockets."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

from pool_sim_ros.physics import Table

CLOTH = (0.11, 0.42, 0.26)
WOOD = (0.42, 0.25, 0.13)
RUBBER = (0.07, 0.3, 0.18)
HOLE = (0.02, 0.02, 0.02)

CLOTH_THICKNESS = 0.01
CUSHION_WIDTH = 0.06
EDGE_WIDTH = 0.012
HOLE_THICKNESS = 0.002
"""m."""

HOLE_ALPHA = 0.75
"""A ball that lies below the cloth is seen through the hole."""


def new_marker(
    frame_id: str,
    namespace: str,
    number: int,
    type_: int,
    size: Sequence[float],
    color: Sequence[float] = (1.0, 1.0, 1.0),
) -> Marker:
    """Return a marker of this size, in m, and colour at the origin of a frame."""
    marker = Marker(ns=namespace, id=number, type=type_, action=Marker.ADD)
    marker.header.frame_id = frame_id
    marker.pose.orientation.w = 1.0
    marker.scale.x, marker.scale.y, marker.scale.z = (float(part) for part in size)
    red, green, blue = (float(part) for part in color)
    marker.color = ColorRGBA(r=red, g=green, b=blue, a=1.0)
    return marker


def put(marker: Marker, x: float, y: float, z: float) -> None:
    """Put a marker to a place, m."""
    marker.pose.position = Point(x=float(x), y=float(y), z=float(z))


def table_markers(table: Table, frame_id: str) -> list[Marker]:
    """Return the markers of a table: a wooden frame around its cloth, and what bounds the balls."""

    def make(*what: Any) -> Marker:
        return new_marker(frame_id, *what)

    cloth = make('table', 0, Marker.CUBE, (table.length, table.width, CLOTH_THICKNESS), CLOTH)
    put(cloth, table.length / 2, table.width / 2, -CLOTH_THICKNESS / 2)
    height = 1.2 * float(table.radii.max())
    if table.cushions is None:
        return [cloth, *_frame(make, table, 0.0, height)]
    reach = max(
        float(-table.cushions.segments[:, :4].min()), float((-table.pockets[:, :2]).max(initial=0))
    )
    around = make(
        'table', 1, Marker.CUBE, (table.length + 2 * reach, table.width + 2 * reach, 0.002), WOOD
    )
    put(around, table.length / 2, table.width / 2, -CLOTH_THICKNESS)
    return [cloth, around, *_frame(make, table, reach, height), *_edges(make, table)]


def _frame(make: Callable[..., Marker], table: Table, reach: float, height: float) -> list[Marker]:
    """Return four boxes, `reach` m outside the rectangle of the table."""
    length, width = table.length, table.width
    half = reach + CUSHION_WIDTH / 2
    across = (CUSHION_WIDTH, width + 2 * (reach + CUSHION_WIDTH), height)
    along = (length + 2 * reach, CUSHION_WIDTH, height)
    boxes = (
        (across, -half, width / 2),
        (across, length + half, width / 2),
        (along, length / 2, -half),
        (along, length / 2, width + half),
    )
    cushions = []
    for index, (size, x, y) in enumerate(boxes):
        cushion = make('cushions', index, Marker.CUBE, size, WOOD)
        put(cushion, x, y, height / 2 - CLOTH_THICKNESS)
        cushions.append(cushion)
    return cushions


def _edges(make: Callable[..., Marker], table: Table) -> list[Marker]:
    """Return the straight cushions, the noses and the pockets."""
    assert table.cushions is not None, 'a plain rectangle has only its frame'
    height = float(table.nose_height or 0.0)
    markers = []
    for k, (x0, y0, x1, y1, nx, ny) in enumerate(table.cushions.segments.tolist()):
        size = (math.hypot(x1 - x0, y1 - y0), EDGE_WIDTH, height)
        edge = make('rails', k, Marker.CUBE, size, RUBBER)
        inside = EDGE_WIDTH / 2
        put(edge, (x0 + x1) / 2 - nx * inside, (y0 + y1) / 2 - ny * inside, height / 2)
        half = math.atan2(y1 - y0, x1 - x0) / 2
        edge.pose.orientation.z, edge.pose.orientation.w = math.sin(half), math.cos(half)
        markers.append(edge)
    for k, (x, y, radius) in enumerate(table.cushions.noses.tolist()):
        if radius > 0.0:
            size = (2 * radius, 2 * radius, height)
            nose = make('noses', k, Marker.CYLINDER, size, RUBBER)
            put(nose, x, y, height / 2)
            markers.append(nose)
    for k, (x, y, radius) in enumerate(table.pockets.tolist()):
        pocket = make('pockets', k, Marker.CYLINDER, (2 * radius, 2 * radius, HOLE_THICKNESS), HOLE)
        pocket.color.a = HOLE_ALPHA
        put(pocket, x, y, 0.0)
        markers.append(pocket)
    return markers
