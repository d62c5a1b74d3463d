"""The section of the page about the shots: the log, the snapshots, and each shot."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from pool_sim_ros.me212 import inches, nearest_ball
from pool_sim_ros.physics import INCH, EventKind
from pool_sim_ros.report.markup import (
    Cell,
    Html,
    ball_name,
    figure,
    fill,
    join,
    link,
    listing,
    number,
    pair,
    table,
    to_html,
)
from pool_sim_ros.report.played import PlayedShot

LAST_FIGURE_BEFORE = 3
"""Number of the figure before those of the shots, of which each has two."""


def shots_section(
    log: str,
    shots: Sequence[PlayedShot],
    pictures: Mapping[str, bytes],
    films: Mapping[int, str],
) -> Html:
    """Return the section as HTML.

    Parameters
    ----------
    log : str
        Listing 1 of this run.
    shots : sequence of PlayedShot
    pictures : mapping
        Path of a picture relative to the page -> the same picture as SVG.
    films : mapping
        Number of a shot -> path of its film relative to the page.
    """
    snapshots = [
        [f'{shot.number}', *(_snapshot(pictures, shot, when) for when in ('start', 'end'))]
        for shot in shots
    ]
    return fill(
        'shots.html',
        log=listing(log.rstrip('\n'), 'Listing 1: Script output (output.log)'),
        snapshots=table(
            ['Simulation', Cell('Start', 'snapshot'), Cell('End', 'snapshot')],
            snapshots,
            'Table 2: Simulation snapshots.',
        ),
        shots=join((_shot(shot, films.get(shot.number)) for shot in shots), '\n'),
    )


def _snapshot(pictures: Mapping[str, bytes], shot: PlayedShot, when: str) -> Cell:
    first = LAST_FIGURE_BEFORE + 2 * shot.number - 1
    descriptions = {
        'start': f'The table before simulation {shot.number}.',
        'end': f'The table after simulation {shot.number}, with the path of each ball that moved.',
    }
    html = figure(
        pictures,
        f'images/Simulation_{shot.number}_{when}.png',
        f'Figure {first + (when == "end")}: Simulation {shot.number}, {when}',
        descriptions[when],
    )
    return Cell(html, 'snapshot')


def _shot(shot: PlayedShot, film: str | None) -> Html:
    kinds = shot.trajectory.events['kind']
    aim = f', toward ball {shot.table.labels[nearest_ball(shot.table)]}' if shot.number == 4 else ''
    return fill(
        'shot.html',
        number=shot.number,
        velocity=pair(shot.velocity, 3),
        speed=f'{math.hypot(*shot.velocity):.3f}',
        direction=number(math.degrees(math.atan2(*reversed(shot.velocity))), 3),
        aim=aim,
        duration=f'{shot.trajectory.duration:.3f}',
        ball_contacts=int((kinds == EventKind.BALL_BALL).sum()),
        cushion_contacts=int((kinds == EventKind.CUSHION).sum()),
        film=_film(shot.number, film) if film else '',
        positions=_positions(shot),
    )


def _film(shot: int, path: str) -> Html:
    return Html(
        f'<figure class="film"><video controls preload="metadata" src="{to_html(path)}"></video>'
        f'<figcaption>Film of simulation {shot} ({link(path, "file")}).</figcaption></figure>'
    )


def _positions(shot: PlayedShot) -> Html:
    head, rows = ['Ball', 'End, m', 'End, in'], []
    if shot.printed:
        head += ['Printed, in', 'Difference, in']
    for ball in shot.table.balls:
        end = shot.final_positions[ball.label]
        row = [ball_name(ball), pair(end, 6), pair([part / INCH for part in end], 2)]
        if shot.printed:
            printed = shot.printed[ball.label]
            off = [inches(here) - there for here, there in zip(end, printed, strict=True)]
            row += [pair(printed, 2), pair(off, 2)]
        rows.append(row)
    return table(head, rows, f'End positions of simulation {shot.number}, [x, y].')
