"""The cushions and pockets of a table with six pockets, from the measures of two mouths.

Rails end before a mouth, where a jaw turns away from the table; between them is a round nose, or a
point. x runs along the length of the table.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.cushions import Cushions, rows

Point = tuple[float, float]


class Mouth(NamedTuple):
    """The measures of a pocket.

    Attributes
    ----------
    width : float
        From lip to lip, where the lines of the rails and of the jaws meet, m.
    slope : float
        Angle between a jaw and the way straight out of the table, degrees: 0 to 90. It is 90 less
        than the angle of the cut, which is between rail and jaw.
    depth : float
        From the corner of the lines of the rails, or from the line of the rail, out to the middle
        of the hole, m.
    hole : float
        Radius of the circle in which a ball's centre is caught, m.
    nose : float
        Radius of the nose between rail and jaw, m; 0 for a point.
    slant : float, optional
        How far a jaw goes along the rail while it goes 1 m out; by default the tangent of `slope`.
    """

    width: float
    slope: float
    depth: float
    hole: float
    nose: float
    slant: float | None = None

    @property
    def rounding(self) -> float:
        """How far from the lip the nose touches rail and jaw, m."""
        return self.nose / math.tan((math.pi / 2.0 + math.radians(self.slope)) / 2.0)


def pocket_table(
    length: float, width: float, corner: Mouth, side: Mouth, cushion_width: float
) -> tuple[Cushions, NDArray[np.float64]]:
    """Return the cushions and the pockets, rows as in `Cushions` and `Table`.

    Parameters
    ----------
    length, width : float
        Between the straight cushions, m.
    corner, side : Mouth
    cushion_width : float
        How far the jaws reach out from the straight cushions, m.
    """
    lip = corner.width * math.cos(math.pi / 4.0)
    near, far, high = lip, length - lip, width - lip
    left, right = (length - side.width) / 2.0, (length + side.width) / 2.0
    start, before, after = near + corner.rounding, left - side.rounding, right + side.rounding
    end, top = length - start, width - start
    rails = [
        (start, 0.0, before, 0.0, 0.0, 1.0),
        (after, 0.0, end, 0.0, 0.0, 1.0),
        (start, width, before, width, 0.0, -1.0),
        (after, width, end, width, 0.0, -1.0),
        (0.0, start, 0.0, top, 1.0, 0.0),
        (length, start, length, top, -1.0, 0.0),
    ]
    at_side, at_corners = _lips((near, far, left, right), (near, high), (length, width))
    jaws = [
        _jaw(mouth, *end, cushion_width)
        for mouth, ends in ((side, at_side), (corner, at_corners))
        for end in ends
        if _has_jaws(mouth, cushion_width)
    ]
    # Around the table, counterclockwise from the first corner.
    mouths = [corner] * 2 + [side] * 2 + [corner] * 4 + [side] * 2 + [corner] * 2
    ends = [at_corners[k] for k in (0, 1)] + [at_side[k] for k in (1, 0)]
    ends += [at_corners[k] for k in (3, 2, 5, 4)] + [at_side[k] for k in (2, 3)]
    ends += [at_corners[k] for k in (6, 7)]
    noses = [_nose(mouth, *end) for mouth, end in zip(mouths, ends, strict=True)]
    out, aside = corner.depth / math.sqrt(2.0), length / 2.0
    pockets = [
        (-out, -out, corner.hole),
        (aside, -side.depth, side.hole),
        (length + out, -out, corner.hole),
        (-out, width + out, corner.hole),
        (aside, width + side.depth, side.hole),
        (length + out, width + out, corner.hole),
    ]
    return Cushions(np.array(rails + jaws), np.array(noses)), rows('pockets', pockets, 3)


def _lips(
    along: tuple[float, ...], across: Point, size: Point
) -> tuple[list[tuple[Point, Point, Point]], list[tuple[Point, Point, Point]]]:
    """Return where rails meet mouths, at the sides and at the corners.

    Each is the lip, the way along the rail into the mouth, and the way out of the table.
    """
    (near, far, left, right), (low, high), (length, width) = along, across, size
    at_side = [
        ((right, 0.0), (-1.0, 0.0), (0.0, -1.0)),
        ((left, 0.0), (1.0, 0.0), (0.0, -1.0)),
        ((right, width), (-1.0, 0.0), (0.0, 1.0)),
        ((left, width), (1.0, 0.0), (0.0, 1.0)),
    ]
    at_corners = [
        ((0.0, low), (0.0, -1.0), (-1.0, 0.0)),
        ((near, 0.0), (-1.0, 0.0), (0.0, -1.0)),
        ((length, low), (0.0, -1.0), (1.0, 0.0)),
        ((far, 0.0), (1.0, 0.0), (0.0, -1.0)),
        ((far, width), (1.0, 0.0), (0.0, 1.0)),
        ((length, high), (0.0, 1.0), (1.0, 0.0)),
        ((near, width), (-1.0, 0.0), (0.0, 1.0)),
        ((0.0, high), (0.0, 1.0), (-1.0, 0.0)),
    ]
    return at_side, at_corners


def _has_jaws(mouth: Mouth, cushion_width: float) -> bool:
    """Return whether a straight jaw begins where a nose ends, before the cushion does."""
    return mouth.rounding * math.cos(math.radians(mouth.slope)) < cushion_width


def _jaw(
    mouth: Mouth, lip: Point, along: Point, out: Point, cushion_width: float
) -> tuple[float, ...]:
    """Return the row of the jaw beyond a lip: from outside to its nose."""
    angle = math.radians(mouth.slope)
    slant = math.tan(angle) if mouth.slant is None else mouth.slant
    inner_out, inner_along = mouth.rounding * math.cos(angle), mouth.rounding * math.sin(angle)
    x0, y0 = (lip[k] + cushion_width * slant * along[k] + cushion_width * out[k] for k in (0, 1))
    x1, y1 = (lip[k] + inner_along * along[k] + inner_out * out[k] for k in (0, 1))
    tilt = (x1 - x0) / (y1 - y0)
    size = math.hypot(1.0, tilt)
    nx, ny = 1.0 / size, -tilt / size
    if nx * along[0] + ny * along[1] < 0.0:
        nx, ny = -nx, -ny
    return x0, y0, x1, y1, nx, ny


def _nose(mouth: Mouth, lip: Point, along: Point, out: Point) -> tuple[float, ...]:
    """Return the row of the nose between rail and jaw."""
    x, y = (lip[k] - mouth.rounding * along[k] + mouth.nose * out[k] for k in (0, 1))
    return x, y, mouth.nose
