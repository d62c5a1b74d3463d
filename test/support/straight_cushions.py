"""A boundary that only the tests have: a convex table of straight cushions in any direction."""

import math
from typing import NamedTuple

import numpy as np

from pool_sim_ros.physics import boundary as seam
from pool_sim_ros.physics.boundary import PHASE_END, partner_of_cushion
from pool_sim_ros.physics.jit import register


class StraightCushions(NamedTuple):
    """Cushions along lines, each with the unit normal from the cloth into it."""

    nx: np.ndarray
    ny: np.ndarray
    offset: np.ndarray  # nx x + ny y on the line, m
    length: float  # of a rectangle from (0, 0) that holds the cloth, m
    width: float


def polygon(corners):
    """Return the boundary through corners, (k, 2) in m, which go round counterclockwise."""
    corners = np.asarray(corners, dtype=float)
    steps = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(*steps.T)
    nx, ny = steps[:, 1] / lengths, -steps[:, 0] / lengths
    offset = nx * corners[:, 0] + ny * corners[:, 1]
    return StraightCushions(nx, ny, offset, *map(float, corners.max(axis=0)))


def rectangle_of(table, cushions_of=(0, 1, 2, 3)):
    """Return a table's rectangle as lines, exactly, its cushions numbered as they are there."""
    nx, ny = np.array([-1.0, 1.0, 0.0, 0.0]), np.array([0.0, 0.0, -1.0, 1.0])
    offset = np.array([0.0, table.length, 0.0, table.width])
    order = list(cushions_of)
    return StraightCushions(nx[order], ny[order], offset[order], table.length, table.width)


def turned(boundary, degrees, shift):
    """Return a boundary turned about (0, 0), counterclockwise, and then moved by `shift`, m."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    nx, ny = c * boundary.nx - s * boundary.ny, s * boundary.nx + c * boundary.ny
    offset = boundary.offset + nx * shift[0] + ny * shift[1]
    return boundary._replace(nx=nx, ny=ny, offset=offset)


def _n(boundary):
    return len(boundary.offset)


def _gap(boundary, cushion, x, y, radius):
    along = boundary.nx[cushion] * x + boundary.ny[cushion] * y
    return boundary.offset[cushion] - radius - along


def _normal(boundary, cushion, x, y):
    return boundary.nx[cushion], boundary.ny[cushion]


def _distance(boundary, x, y, ux, uy, radius):
    distance, partner = np.inf, PHASE_END
    for k in range(len(boundary.offset)):
        towards = boundary.nx[k] * ux + boundary.ny[k] * uy
        if towards > 0.0:
            gap = boundary.offset[k] - radius - (boundary.nx[k] * x + boundary.ny[k] * y)
            if gap / towards < distance:
                distance, partner = gap / towards, partner_of_cushion(k)
    return max(distance, 0.0), partner


def _to_axes(boundary, cushion, normal, v):
    return normal[0] * v[0] + normal[1] * v[1], normal[0] * v[1] - normal[1] * v[0]


def _from_axes(boundary, cushion, normal, v):
    return normal[0] * v[0] - normal[1] * v[1], normal[0] * v[1] + normal[1] * v[0]


def _touches(boundary, x, y, reach, but):
    for k in range(len(boundary.offset)):
        gap = boundary.offset[k] - (boundary.nx[k] * x + boundary.ny[k] * y)
        if k != but and gap <= reach:
            return True
    return False


def _outside(boundary, x, y, radius, tolerance):
    for k in range(len(boundary.offset)):
        gap = boundary.offset[k] - radius - (boundary.nx[k] * x + boundary.ny[k] * y)
        # Written so that NaN is outside too.
        if not gap >= -tolerance:
            return True
    return False


def _time(boundary, path, radius):
    """Only discs move here, and they ask for a distance."""
    return np.inf, PHASE_END


def _nose_radius(boundary, cushion):
    return 0.0


def _put_on(boundary, cushion, x, y, radius):
    gap = _gap(boundary, cushion, x, y, radius)
    return x + gap * boundary.nx[cushion], y + gap * boundary.ny[cushion]


def _is_pocket(boundary, partner):
    return False


def _no_pocket(boundary, partner):
    return -1


def _pocket_at(boundary, x, y):
    return -1


def _pocket_centre(boundary, pocket):
    return np.nan, np.nan


def _to_mouths(boundary, x, y):
    return np.inf


IMPLEMENTATIONS = {
    seam.n_cushions: _n,
    seam.cushion_gap: _gap,
    seam.cushion_normal: _normal,
    seam.distance_to_cushions: _distance,
    seam.to_cushion_axes: _to_axes,
    seam.from_cushion_axes: _from_axes,
    seam.touches_cushion: _touches,
    seam.is_outside: _outside,
    seam.time_to_cushions: _time,
    seam.nose_radius: _nose_radius,
    seam.put_on_cushion: _put_on,
    seam.is_pocket: _is_pocket,
    seam.pocket_of_partner: _no_pocket,
    seam.pocket_at: _pocket_at,
    seam.pocket_centre: _pocket_centre,
    seam.distance_to_mouths: _to_mouths,
}

for _choice, _implementation in IMPLEMENTATIONS.items():
    register(_choice, StraightCushions, _implementation)
