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
    turn : float
        Angle between rail and jaw, degrees: 0 if the jaw went on along the rail.
    depth : float
        From the corner of the lines of the rails, or from the line of the rail, out to the middle
        of the hole, m.
    hole : float
        Radius of the circle in which a ball's centre is caught, m.
    nose : float
        Radius of the nose between rail and jaw, m; 0 for a point.
    slant : float, optional
        How far a jaw goes along the rail while it goes 1 m out; by default as `turn` has it.
    """

    width: float
    turn: float
    depth: float
    hole: float
    nose: float
    slant: float | None = None

    @property
    def rounding(self) -> float:
        """How far from the lip the nose touches rail and jaw, m."""
        return self.nose * math.tan(math.radians(self.turn) / 2.0)


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
    at_corner = corner.width * math.cos(math.pi / 4.0) + corner.rounding
    left, right = (length - side.width) / 2.0 - side.rounding, (length + side.width) / 2.0
    right += side.rounding
    far, high = length - at_corner, width - at_corner
    rails = [
        (at_corner, 0.0, left, 0.0, 0.0, 1.0),
        (right, 0.0, far, 0.0, 0.0, 1.0),
        (at_corner, width, left, width, 0.0, -1.0),
        (right, width, far, width, 0.0, -1.0),
        (0.0, at_corner, 0.0, high, 1.0, 0.0),
        (length, at_corner, length, high, -1.0, 0.0),
    ]
    # Where a rail ends: the point, the way along the rail into the mouth, and out of the table.
    at_side = [
        ((right, 0.0), (-1.0, 0.0), (0.0, -1.0)),
        ((left, 0.0), (1.0, 0.0), (0.0, -1.0)),
        ((right, width), (-1.0, 0.0), (0.0, 1.0)),
        ((left, width), (1.0, 0.0), (0.0, 1.0)),
    ]
    at_corners = [
        ((0.0, at_corner), (0.0, -1.0), (-1.0, 0.0)),
        ((at_corner, 0.0), (-1.0, 0.0), (0.0, -1.0)),
        ((length, at_corner), (0.0, -1.0), (1.0, 0.0)),
        ((far, 0.0), (1.0, 0.0), (0.0, -1.0)),
        ((far, width), (1.0, 0.0), (0.0, 1.0)),
        ((length, high), (0.0, 1.0), (1.0, 0.0)),
        ((at_corner, width), (-1.0, 0.0), (0.0, 1.0)),
        ((0.0, high), (0.0, 1.0), (-1.0, 0.0)),
    ]
    jaws = [
        _jaw(mouth, *end, cushion_width)
        for mouth, ends in ((side, at_side), (corner, at_corners))
        for end in ends
        if _has_jaws(mouth, cushion_width)
    ]
    # Around the table, counterclockwise from the first corner.
    low, left_low = at_corners[:2], [at_side[1], at_side[0]]
    right_high = [at_side[2], at_side[3]]
    noses = [_nose(corner, *end) for end in low]
    noses += [_nose(side, *end) for end in left_low]
    noses += [_nose(corner, *end) for end in (at_corners[3], at_corners[2], *at_corners[5:3:-1])]
    noses += [_nose(side, *end) for end in right_high]
    noses += [_nose(corner, *end) for end in at_corners[6:]]
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


def _has_jaws(mouth: Mouth, cushion_width: float) -> bool:
    """Return whether a straight jaw begins where a nose ends, before the cushion does."""
    return mouth.rounding * math.sin(math.radians(mouth.turn)) < cushion_width


def _jaw(
    mouth: Mouth, end: Point, along: Point, out: Point, cushion_width: float
) -> tuple[float, ...]:
    """Return the row of the jaw beyond the end of a rail: from outside to its nose."""
    turn = math.radians(mouth.turn)
    cosine, sine = math.cos(turn), math.sin(turn)
    slant = cosine / sine if mouth.slant is None else mouth.slant
    lip = [end[k] + mouth.rounding * along[k] for k in (0, 1)]
    outer = [lip[k] + cushion_width * (slant * along[k] + out[k]) for k in (0, 1)]
    inner = [lip[k] + mouth.rounding * (cosine * along[k] + sine * out[k]) for k in (0, 1)]
    way = [inner[k] - outer[k] for k in (0, 1)]
    length = math.hypot(*way)
    normal = [-way[1] / length, way[0] / length]
    side = 1.0 if normal[0] * along[0] + normal[1] * along[1] > 0.0 else -1.0
    return *outer, *inner, side * normal[0], side * normal[1]


def _nose(mouth: Mouth, end: Point, along: Point, out: Point) -> tuple[float, ...]:
    """Return the row of the nose at the end of a rail."""
    return *(end[k] + mouth.nose * out[k] for k in (0, 1)), mouth.nose
