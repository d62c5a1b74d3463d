"""The table as markers for RViz and Foxglove: this builds the messages and sends none."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from pool_sim_ros.physics import Table
from pool_sim_ros.simulator import COLLISION_COLUMNS

CLOTH = (0.11, 0.42, 0.26)
WOOD = (0.42, 0.25, 0.13)
FLASH = (1.0, 0.95, 0.6)

CLOTH_THICKNESS = 0.01
CUSHION_WIDTH = 0.06
TRAIL_WIDTH = 0.008
TRAIL_HEIGHT = 0.003
"""m."""

FLASH_TIME = 150_000_000
"""Duration of a flash in the viewer's time, ns."""

FLASHES = 32
"""Most flashes at a time, and in a message; a further one replaces the oldest."""

_COLUMN = {name: index for index, name in enumerate(COLLISION_COLUMNS)}


class Markers:
    """Tells what to draw: all of it, or what has changed.

    A trail is the path of a ball since the strike. It ends at the ball, and its corners are exactly
    where the ball touched something.

    Parameters
    ----------
    table : Table
        Size, balls and colours.
    frame_id : str
        Frame of the markers' coordinates.
    """

    def __init__(self, table: Table, frame_id: str) -> None:
        self._table = table
        self._frame_id = frame_id
        self._positions = np.full((len(table.balls), 2), np.nan)
        self._balls = [self._ball(i) for i in range(len(table.balls))]
        self._labels = [self._label(i) for i in range(len(table.balls))]
        self._trails = self._marker('trails', 0, Marker.LINE_LIST, (TRAIL_WIDTH, 0.0, 0.0))
        self._ends: dict[int, Point] = {}
        self._clear_trails()
        self._flash_count = 0
        self._flashes: list[Marker] = []
        self._clean = self._marker('', 0, Marker.ARROW, (0.0, 0.0, 0.0))
        self._clean.action = Marker.DELETEALL

    def everything(self, positions: np.ndarray) -> MarkerArray:
        """Return all there is, for balls at `positions`, (n, 2), m; a viewer needs nothing else.

        It begins with the end of whatever a viewer shows under this topic: a simulator that was
        here before may have had more balls. It holds the flashes of the latest change.
        """
        self._move(range(len(self._balls)), positions)
        table = self.table().markers
        moving = [*self._balls, *self._labels, self._trails, *self._flashes]
        return MarkerArray(markers=[self._clean, *table, *moving])

    def table(self) -> MarkerArray:
        """Return what never changes: the cloth and the four cushions."""
        length, width = self._table.length, self._table.width
        height = 1.2 * float(self._table.radii.max())
        cloth = self._marker('table', 0, Marker.CUBE, (length, width, CLOTH_THICKNESS), CLOTH)
        _place(cloth, length / 2, width / 2, -CLOTH_THICKNESS / 2)
        across = (CUSHION_WIDTH, width + 2 * CUSHION_WIDTH, height)
        along = (length, CUSHION_WIDTH, height)
        half = CUSHION_WIDTH / 2
        cushions = []
        for index, (size, x, y) in enumerate(
            (
                (across, -half, width / 2),
                (across, length + half, width / 2),
                (along, length / 2, -half),
                (along, length / 2, width + half),
            )
        ):
            cushion = self._marker('cushions', index, Marker.CUBE, size, WOOD)
            _place(cushion, x, y, height / 2 - CLOTH_THICKNESS)
            cushions.append(cushion)
        return MarkerArray(markers=[cloth, *cushions])

    def changes(
        self, positions: np.ndarray, collisions: np.ndarray, *, started: bool, rolling: bool
    ) -> MarkerArray | None:
        """Return what a frame changes; None if it changes nothing.

        Parameters
        ----------
        positions : ndarray of shape (n, 2)
            m.
        collisions : ndarray of shape (k, 10)
            Since the last frame, in the columns `COLLISION_COLUMNS`.
        started : bool
            Whether this is the first frame of a shot, which shows the balls at their start.
        rolling : bool
            Whether the balls roll, or have just rolled to their rest. Balls that were placed
            elsewhere leave no trails.
        """
        self._flashes = []
        moved = np.flatnonzero(np.any(positions != self._positions, axis=1)).tolist()
        if not (moved or len(collisions) or started):
            return None
        if started or not rolling:
            self._clear_trails()
            self._positions = positions.copy()
        for row in collisions:
            self._turn(row)
        self._flashes = [self._flash(row) for row in collisions[-FLASHES:]]
        self._move(moved, positions, moved if rolling and not started else ())
        markers = [marker for i in moved for marker in (self._balls[i], self._labels[i])]
        return MarkerArray(markers=[*markers, self._trails, *self._flashes])

    def _move(
        self, balls: Sequence[int], positions: np.ndarray, rolling: Sequence[int] = ()
    ) -> None:
        for i in rolling:
            end = self._ends.get(i) or self._begin(i, *self._positions[i].tolist())
            end.x, end.y = positions[i].tolist()
        for i in balls:
            x, y = positions[i].tolist()
            for marker in (self._balls[i], self._labels[i]):
                marker.pose.position.x, marker.pose.position.y = x, y
        self._positions = positions.copy()

    def _turn(self, row: np.ndarray) -> None:
        """End the present line of each ball in a collision, and begin the next one there."""
        point, normal = row[_COLUMN['x'] : _COLUMN['y'] + 1], row[_COLUMN['nx'] : _COLUMN['ny'] + 1]
        kind, a, b = (int(row[_COLUMN[name]]) for name in ('kind', 'a', 'b'))
        for ball, side in ((a, -1.0), (b, 1.0)) if kind == 0 else ((a, -1.0),):
            x, y = (point + side * self._table.radii[ball] * normal).tolist()
            end = self._ends.get(ball)
            if end is not None:
                end.x, end.y = x, y
            self._begin(ball, x, y)

    def _begin(self, ball: int, x: float, y: float) -> Point:
        color = self._balls[ball].color
        start, end = (Point(x=x, y=y, z=TRAIL_HEIGHT) for _ in range(2))
        self._trails.points.extend((start, end))
        self._trails.colors.extend((color, color))
        self._trails.action = Marker.ADD
        self._ends[ball] = end
        return end

    def _clear_trails(self) -> None:
        # Viewers complain of lines without points, so there is no such marker then.
        self._trails.action = Marker.DELETE
        self._trails.points = []
        self._trails.colors = []
        self._ends = {}

    def _ball(self, index: int) -> Marker:
        ball = self._table.balls[index]
        diameter = 2 * ball.radius
        marker = self._marker('balls', index, Marker.SPHERE, (diameter,) * 3, ball.color)
        _place(marker, *ball.position, ball.radius)
        return marker

    def _label(self, index: int) -> Marker:
        ball = self._table.balls[index]
        size = (0.0, 0.0, 1.2 * ball.radius)
        marker = self._marker('labels', index, Marker.TEXT_VIEW_FACING, size, (1.0, 1.0, 1.0))
        _place(marker, *ball.position, 2.7 * ball.radius)
        marker.text = ball.label
        return marker

    def _flash(self, row: np.ndarray) -> Marker:
        radius = float(self._table.radii[int(row[_COLUMN['a']])])
        number = self._flash_count % FLASHES
        marker = self._marker('flashes', number, Marker.SPHERE, (0.8 * radius,) * 3, FLASH)
        _place(marker, float(row[_COLUMN['x']]), float(row[_COLUMN['y']]), radius)
        marker.color.a = 0.8
        marker.lifetime = Duration(nanosec=FLASH_TIME)
        self._flash_count += 1
        return marker

    def _marker(
        self,
        namespace: str,
        number: int,
        type_: int,
        size: Sequence[float],
        color: Sequence[float] = (1.0, 1.0, 1.0),
    ) -> Marker:
        marker = Marker(ns=namespace, id=number, type=type_, action=Marker.ADD)
        marker.header.frame_id = self._frame_id
        marker.pose.orientation.w = 1.0
        marker.scale.x, marker.scale.y, marker.scale.z = (float(part) for part in size)
        red, green, blue = (float(part) for part in color)
        marker.color = ColorRGBA(r=red, g=green, b=blue, a=1.0)
        return marker


def _place(marker: Marker, x: float, y: float, z: float) -> None:
    marker.pose.position = Point(x=float(x), y=float(y), z=float(z))
