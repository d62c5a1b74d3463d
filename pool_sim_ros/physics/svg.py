"""A table and a shot as HTML with a small picture: what a notebook shows of them."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pool_sim_ros.physics.table import Table
    from pool_sim_ros.physics.trajectory import Trajectory

WIDTH = 420
"""Of the picture, pixels."""

MOST_BALLS = 200
"""Beyond it a picture would be a large text: then there are words alone."""

MOST_POINTS = 20_000
"""Of all paths, for the same reason."""

CLOTH = '#7fc77f'


def table_html(table: Table) -> str:
    """Return a table with its balls where they start, and its coefficients."""
    names = ['ball_friction', 'e_cue_ball', 'e_ball_ball', 'e_ball_cushion', 'gravity']
    names += ['mu_ball_ball', 'mu_ball_cushion']
    if table.motion == 'ball':
        names += ['mu_slide', 'mu_roll', 'mu_spin', 'cushion_model', 'nose_height']
    else:
        names += ['mu_ball_surface']
    values = ', '.join(f'{name} {_short(getattr(table, name))}' for name in names)
    picture = _picture(table, table.positions, [])
    return (
        f'<div>{picture}<div>{escape(repr(table))}<br><small>{escape(values)}</small></div></div>'
    )


def shot_html(shot: Trajectory) -> str:
    """Return the table with the paths of a shot and the balls at its end."""
    paths = [] if len(shot.table.balls) > MOST_BALLS else _paths(shot)
    picture = _picture(shot.table, shot.final_positions, paths)
    return f'<div>{picture}<div>{escape(repr(shot))}</div></div>'


def _paths(shot: Trajectory) -> list[tuple[str, NDArray[np.float64]]]:
    found = [(_color(ball.color), shot.path(k)) for k, ball in enumerate(shot.table.balls)]
    moved = [(color, path) for color, path in found if len(path) > 1]
    return moved if sum(len(path) for _, path in moved) <= MOST_POINTS else []


def _picture(
    table: Table,
    positions: NDArray[np.float64],
    paths: list[tuple[str, NDArray[np.float64]]],
) -> str:
    """Return SVG, in millimetres: y points up on a table, and down in SVG."""
    if len(table.balls) > MOST_BALLS:
        return ''
    low, high = np.zeros(2), np.array([table.length, table.width])
    if len(table.pockets):
        centres, radii = table.pockets[:, :2], table.pockets[:, 2:]
        low = np.minimum(low, (centres - radii).min(axis=0))
        high = np.maximum(high, (centres + radii).max(axis=0))
    size = high - low
    thin = 0.003 * size[0]
    parts = [
        f'<rect x="0" y="0" width="{_mm(table.length)}" height="{_mm(table.width)}" '
        f'fill="{CLOTH}" stroke="black" stroke-width="{_mm(thin)}"/>'
    ]
    parts += [f'<circle {_at(x, y)} r="{_mm(r)}"/>' for x, y, r in table.pockets]
    for color, path in paths:
        points = ' '.join(f'{_mm(x)},{_mm(y)}' for x, y in path)
        for stroke, width in (('black', 1.6 * thin), (color, 0.9 * thin)):
            parts.append(
                f'<polyline points="{points}" fill="none" stroke="{stroke}" '
                f'stroke-width="{_mm(width)}"/>'
            )
    for ball, (x, y) in zip(table.balls, positions, strict=True):
        parts.append(
            f'<circle {_at(x, y)} r="{_mm(ball.radius)}" fill="{_color(ball.color)}" '
            f'stroke="black" stroke-width="{_mm(0.5 * thin)}">'
            f'<title>{escape(ball.label)}</title></circle>'
        )
    height = round(WIDTH * size[1] / size[0])
    box = f'{_mm(low[0])} {_mm(-high[1])} {_mm(size[0])} {_mm(size[1])}'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
        f'viewBox="{box}"><g transform="scale(1,-1)">{"".join(parts)}</g></svg>'
    )


def _mm(metres: float) -> str:
    return f'{1000.0 * metres:.2f}'


def _at(x: float, y: float) -> str:
    return f'cx="{_mm(x)}" cy="{_mm(y)}"'


def _color(color: tuple[float, float, float]) -> str:
    return '#' + ''.join(f'{round(255 * part):02x}' for part in color)


def _short(value: object) -> str:
    return f'{value:g}' if isinstance(value, float) else str(value)
