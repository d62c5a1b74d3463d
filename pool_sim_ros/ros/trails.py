"""The paths of the balls since the strike, as one marker of lines."""

from __future__ import annotations

import math

from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

TRAIL_HEIGHT = 0.003
"""m."""

BEND = 2e-3
"""How far a ball may be off the way in which its line began, m: a curve becomes lines that are at
most a quarter of it off."""


class Trails:
    """Draws each path as lines: a new one begins at each contact, and where a path bends.

    Parameters
    ----------
    marker : Marker
        Of lines; its points are drawn here.
    curved : bool
        Whether paths are curved between contacts, as those of balls that spin.
    """

    def __init__(self, marker: Marker, curved: bool) -> None:
        self.marker = marker
        self._curved = curved
        self._ends: dict[int, Point] = {}
        self._ways: dict[int, tuple[float, float, float, float]] = {}
        self.clear()

    def clear(self) -> None:
        """Forget all paths."""
        # Viewers complain of lines without points, so there is no such marker then.
        self.marker.action = Marker.DELETE
        self.marker.points = []
        self.marker.colors = []
        self._ends = {}
        self._ways = {}

    def extend(
        self, ball: int, color: ColorRGBA, before: tuple[float, float], x: float, y: float
    ) -> None:
        """Draw a ball's way on to (x, y), m; it was `before`, m, where it has no path yet."""
        end = self._ends.get(ball) or self.begin(ball, color, *before)
        if self._curved and self._bends(ball, end, x, y):
            end = self.begin(ball, color, end.x, end.y)
            self._bends(ball, end, x, y)
        end.x, end.y = x, y

    def turn(self, ball: int, color: ColorRGBA, x: float, y: float) -> None:
        """End the present line of a ball at (x, y), m, and begin the next one there."""
        end = self._ends.get(ball)
        if end is not None:
            end.x, end.y = x, y
        self.begin(ball, color, x, y)

    def begin(self, ball: int, color: ColorRGBA, x: float, y: float) -> Point:
        """Begin a line of a ball at (x, y), m; return its end."""
        start, end = (Point(x=x, y=y, z=TRAIL_HEIGHT) for _ in range(2))
        self.marker.points.extend((start, end))
        self.marker.colors.extend((color, color))
        self.marker.action = Marker.ADD
        self._ends[ball] = end
        self._ways.pop(ball, None)
        return end

    def _bends(self, ball: int, end: Point, x: float, y: float) -> bool:
        """Return whether (x, y) is off the line of a ball, or back on it."""
        way = self._ways.get(ball)
        if way is None:
            dx, dy = x - end.x, y - end.y
            length = math.hypot(dx, dy)
            if length > 0.0:
                self._ways[ball] = end.x, end.y, dx / length, dy / length
            return False
        start_x, start_y, ux, uy = way
        across = ux * (y - start_y) - uy * (x - start_x)
        return abs(across) > BEND or ux * (x - end.x) + uy * (y - end.y) < 0.0
