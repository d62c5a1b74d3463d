"""The table as markers for RViz and Foxglove: this builds the messages and sends none."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from visualization_msgs.msg import Marker, MarkerArray

from pool_sim_ros.physics import Table
from pool_sim_ros.ros.table_markers import new_marker, put, table_markers
from pool_sim_ros.ros.trails import Trails
from pool_sim_ros.simulator import COLLISION_COLUMNS

FLASH = (1.0, 0.95, 0.6)

TRAIL_WIDTH = 0.008
"""m."""

LABEL_HEIGHT = 2.7
"""Of a label above the cloth, in radii."""

LIGHT = 1.5
"""Least sum of red, green and blue of a light ball."""

SPOTS = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
"""Where a ball that spins has spots: its turning is seen from wherever one looks."""

SPOT_SIZE = 0.5
SPOT_DEPTH = 0.8
"""Diameter of a spot, and how far from the ball's centre its own centre is, in radii."""

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
        self._spins = table.motion == 'ball'
        self._positions = np.full((len(table.balls), 2), np.nan)
        self._turned: np.ndarray | None = None
        self._balls = [self._ball(i) for i in range(len(table.balls))]
        self._labels = [self._label(i) for i in range(len(table.balls))]
        self._spots = [self._spots_of(i) for i in range(len(table.balls))] if self._spins else []
        lines = self._marker('trails', 0, Marker.LINE_LIST, (TRAIL_WIDTH, 0.0, 0.0))
        self._trails = Trails(lines, self._spins)
        self._flash_count = 0
        self._flashes: list[Marker] = []
        self._clean = self._marker('', 0, Marker.ARROW, (0.0, 0.0, 0.0))
        self._clean.action = Marker.DELETEALL

    def everything(
        self,
        positions: np.ndarray,
        turned: np.ndarray | None = None,
        pocketed: Sequence[int] = (),
    ) -> MarkerArray:
        """Return all there is; a viewer needs nothing else.

        It begins with the end of whatever a viewer shows under this topic: a simulator that was
        here before may have had more balls. It holds the flashes of the latest change. Parameters
        are as those of `changes`.
        """
        self._move(range(len(self._balls)), positions, turned, pocketed)
        table = self.table().markers
        moving = [*self._balls, *self._spots, *self._labels, self._trails.marker, *self._flashes]
        return MarkerArray(markers=[self._clean, *table, *moving])

    def table(self) -> MarkerArray:
        """Return what never changes: the cloth and what bounds it."""
        return MarkerArray(markers=table_markers(self._table, self._frame_id))

    def changes(
        self,
        positions: np.ndarray,
        collisions: np.ndarray,
        *,
        started: bool,
        rolling: bool,
        turned: np.ndarray | None = None,
        pocketed: Sequence[int] = (),
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
        turned : ndarray of shape (n, 4), optional
            Unit quaternions x, y, z, w, where balls spin.
        pocketed : sequence of int, optional
            The balls in pockets.
        """
        self._flashes = []
        changed = np.any(positions != self._positions, axis=1)
        rolled = np.flatnonzero(changed).tolist()
        if turned is not None:
            changed |= True if self._turned is None else np.any(turned != self._turned, axis=1)
        moved = np.flatnonzero(changed).tolist()
        if not (moved or len(collisions) or started):
            return None
        if started or not rolling:
            self._trails.clear()
            self._positions = positions.copy()
        for row in collisions:
            self._turn(row)
        self._flashes = [self._flash(row) for row in collisions[-FLASHES:]]
        if rolling and not started:
            for i in rolled:
                before, now = self._positions[i].tolist(), positions[i].tolist()
                self._trails.extend(i, self._balls[i].color, before, *now)
        self._move(moved, positions, turned, pocketed)
        kinds = (
            (self._balls, self._spots, self._labels) if self._spins else (self._balls, self._labels)
        )
        markers = [kind[i] for i in moved for kind in kinds]
        return MarkerArray(markers=[*markers, self._trails.marker, *self._flashes])

    def _move(
        self,
        balls: Sequence[int],
        positions: np.ndarray,
        turned: np.ndarray | None,
        pocketed: Sequence[int],
    ) -> None:
        for i in balls:
            x, y = positions[i].tolist()
            for marker in (self._balls[i], self._labels[i]):
                marker.pose.position.x, marker.pose.position.y = x, y
            if turned is not None:
                pose, radius = self._balls[i].pose, self._table.balls[i].radius
                fallen = 2.0 * radius if i in pocketed else 0.0
                pose.position.z = radius - fallen
                self._labels[i].pose.position.z = LABEL_HEIGHT * radius - fallen
                q = pose.orientation
                q.x, q.y, q.z, q.w = turned[i].tolist()
                self._spots[i].pose = pose
        self._positions = positions.copy()
        self._turned = None if turned is None else turned.copy()

    def _turn(self, row: np.ndarray) -> None:
        """End the present line of each ball in a collision, and begin the next one there."""
        point, normal = row[_COLUMN['x'] : _COLUMN['y'] + 1], row[_COLUMN['nx'] : _COLUMN['ny'] + 1]
        kind, a, b = (int(row[_COLUMN[name]]) for name in ('kind', 'a', 'b'))
        # Where a ball is caught, the point is its centre.
        sides = {0: ((a, -1.0), (b, 1.0)), 1: ((a, -1.0),), 3: ((a, 0.0),)}
        for ball, side in sides[kind]:
            x, y = (point + side * self._table.radii[ball] * normal).tolist()
            self._trails.turn(ball, self._balls[ball].color, x, y)

    def _ball(self, index: int) -> Marker:
        ball = self._table.balls[index]
        diameter = 2 * ball.radius
        marker = self._marker('balls', index, Marker.SPHERE, (diameter,) * 3, ball.color)
        put(marker, *ball.position, ball.radius)
        return marker

    def _label(self, index: int) -> Marker:
        ball = self._table.balls[index]
        size = (0.0, 0.0, 1.2 * ball.radius)
        marker = self._marker('labels', index, Marker.TEXT_VIEW_FACING, size, (1.0, 1.0, 1.0))
        put(marker, *ball.position, LABEL_HEIGHT * ball.radius)
        marker.text = ball.label
        return marker

    def _spots_of(self, index: int) -> Marker:
        """Return the spots of a ball: light on a dark one, dark on a light one."""
        ball = self._table.balls[index]
        light = 0.0 if sum(ball.color) > LIGHT else 1.0
        size = (SPOT_SIZE * ball.radius,) * 3
        marker = self._marker('spots', index, Marker.SPHERE_LIST, size, (light,) * 3)
        away = SPOT_DEPTH * ball.radius
        marker.points = [Point(x=away * x, y=away * y, z=away * z) for x, y, z in SPOTS]
        return marker

    def _flash(self, row: np.ndarray) -> Marker:
        radius = float(self._table.radii[int(row[_COLUMN['a']])])
        number = self._flash_count % FLASHES
        marker = self._marker('flashes', number, Marker.SPHERE, (0.8 * radius,) * 3, FLASH)
        put(marker, float(row[_COLUMN['x']]), float(row[_COLUMN['y']]), radius)
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
        return new_marker(self._frame_id, namespace, number, type_, size, color)
