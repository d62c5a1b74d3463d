"""The report as one page: the given data, the equations, the shots, and their accuracy."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pool_sim_ros
from pool_sim_ros.me212 import inches, nearest_ball
from pool_sim_ros.physics import INCH, EventKind
from pool_sim_ros.report.comparison import Comparison
from pool_sim_ros.report.comparison_page import comparison_section
from pool_sim_ros.report.markup import (
    Html,
    ball_name,
    figure,
    fill,
    join,
    number,
    pair,
    short,
    table,
    to_html,
)
from pool_sim_ros.report.mathml import with_formulae
from pool_sim_ros.report.part_one import example
from pool_sim_ros.report.played import PlayedShot, verdict
from pool_sim_ros.simulator import Settings

LAYOUT_FIGURE = 3
"""Number of the figure that shows the layout; two figures for each shot follow it."""

POLICY = Html(
    "default-src 'none'; img-src data:; media-src 'self' file:; "
    "style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
)
"""What the page may load: pictures, films and its own style, and no script at all. Browsers do not
agree on what 'self' is for a page that is a file."""


@dataclass(frozen=True, eq=False)
class Content:
    """Everything that the page shows.

    Attributes
    ----------
    settings : Settings
    shots : sequence of PlayedShot
    comparisons : sequence of Comparison
        One for each shot; empty on any table but the report's.
    pictures : mapping
        Path of a picture relative to the page -> the same picture as SVG.
    films : mapping
        Number of a shot -> path of its film relative to the page.
    files : sequence of str
        Paths of the other files, relative to the page.
    """

    settings: Settings
    shots: Sequence[PlayedShot]
    comparisons: Sequence[Comparison]
    pictures: Mapping[str, bytes]
    films: Mapping[int, str]
    files: Sequence[str]


def make_page(content: Content) -> str:
    """Return the page as HTML, with all pictures inside."""
    sections = join(
        [
            _part_1(content),
            _part_2(content),
            _shots(content),
            comparison_section(content.settings.table, content.comparisons),
        ],
        '\n',
    )
    headings = re.findall('<h2 id="(.+?)">(.+?)</h2>', sections)
    page = fill(
        'page.html',
        policy=POLICY,
        style=fill('style.css'),
        version=pool_sim_ros.__version__,
        ball_count=len(content.settings.table.balls),
        verdict=_verdict(content),
        contents=join(
            (Html(f'<li><a href="#{name}">{title}</a></li>') for name, title in headings), '\n'
        ),
        sections=sections,
        files=join((_link(name) for name in content.files), ', '),
    )
    return with_formulae(page)


def _verdict(content: Content) -> Html:
    settings = content.settings
    how = ['time slicing with slices of ', short(settings.time_slice), ' s, as the listing does it']
    if settings.report_integrator == 'event':
        how = ['the exact integrator, from contact to contact']
    return join(['Computed by ', *how, '. ', verdict(settings, content.shots)], '')


def _part_1(content: Content) -> Html:
    collision = example(content.settings.table)
    rows = []
    for law in ('coulomb', 'report'):
        result = collision.collide(law)
        in_frame = (
            result.normal_before,
            result.tangential_before,
            result.normal_after,
            result.tangential_after,
        )
        ends = ('a', result.velocity_a), ('b', result.velocity_b)
        for index, (name, velocity) in enumerate(ends):
            parts = [number(both[index], 4) for both in in_frame]
            rows.append([law.capitalize(), name, *parts, pair(velocity, 4)])
    return fill(
        'part_1.html',
        setup_picture=figure(
            content.pictures,
            'images/Part_1_setup.png',
            'Figure 1: set-up',
            'Ball a moves past the centre of ball b at the offset e.',
            'set-up',
        ),
        construction_picture=figure(
            content.pictures,
            'images/Part_1_construction.png',
            'Figure 2: construction lines',
            'The balls at impact, with the line of centres n, the tangent t and their angles.',
            'set-up',
        ),
        mass_a=f'{collision.a.mass:g}',
        mass_b=f'{collision.b.mass:g}',
        velocity=', '.join(f'{part:g}' for part in collision.velocity),
        radius_a=f'{collision.a.radius:g}',
        radius_b=f'{collision.b.radius:g}',
        offset=f'{collision.offset:.5g}',
        restitution=f'{collision.restitution:g}',
        friction=f'{collision.friction:g}',
        theta=f'{math.degrees(collision.offset_angle):.3f}',
        theta_velocity=f'{math.degrees(collision.velocity_angle):.3f}',
        theta_impact=f'{math.degrees(collision.impact_angle):.3f}',
        outcome=table(
            ['Law', 'Ball', 'vₙ before', 'vₜ before', 'vₙ after', 'vₜ after', '[x, y] after'],
            rows,
            'Velocities of the example, m/s; t points to the left of n.',
            (1,),
        ),
    )


def _part_2(content: Content) -> Html:
    settings = content.settings
    given = settings.table
    constants = (
        ('Length and width', f'{given.length:g} m, {given.width:g} m'),
        ('Friction, two balls', f'μ = {given.mu_ball_ball:g}'),
        ('Friction, ball and cloth', f'μ = {given.mu_ball_surface:g}'),
        ('Friction, ball and cushion', f'μ = {given.mu_ball_cushion:g}'),
        ('Restitution, cue ball and another', f'e = {given.e_cue_ball:g}'),
        ('Restitution, two other balls', f'e = {given.e_ball_ball:g}'),
        ('Restitution, ball and cushion', f'e = {given.e_ball_cushion:g}'),
        ('Gravity', f'{given.gravity:g} m/s²'),
    )
    balls = [
        [
            ball_name(ball),
            pair([part / INCH for part in ball.position], 2),
            pair(ball.position, 4),
            f'{ball.radius / INCH:.2f}',
            f'{ball.mass * 1000:g}',
        ]
        for ball in given.balls
    ]
    # Equation 8 as the report has it: its own speed, slice, ball and distance.
    error = math.atan(4 * 39.3701 * 1e-5 / 2.25)
    method = fill(
        f'{settings.report_integrator}.html',
        time_slice=short(settings.time_slice),
        angle_error=f'{math.degrees(error):.4f}',
        distance_error=f'{math.sin(error) * 2000:.4f}',
    )
    return fill(
        'part_2.html',
        ball_count=len(given.balls),
        layout_picture=figure(
            content.pictures,
            'images/Table_layout.png',
            f'Figure {LAYOUT_FIGURE}: the table',
            'The table from above with all balls where they start.',
        ),
        constants=table(['Constant', 'Value'], constants, 'The table.', (1,)),
        balls=table(
            ['Ball', 'Start, in', 'Start, m', 'Radius, in', 'Mass, g'],
            balls,
            'Table 1: the balls and where they start, [x, y].',
        ),
        deceleration=f'{given.deceleration:g}',
        ball_friction=given.ball_friction,
        method=method,
    )


def _shots(content: Content) -> Html:
    heading = Html('<h2 id="shots">3 The shots</h2>')
    return join([heading, *(_shot(content, shot) for shot in content.shots)], '\n')


def _shot(content: Content, shot: PlayedShot) -> Html:
    kinds = shot.trajectory.events['kind']
    first_figure = LAYOUT_FIGURE + 2 * shot.number - 1
    aim = f', toward ball {shot.table.labels[nearest_ball(shot.table)]}' if shot.number == 4 else ''
    film = content.films.get(shot.number)
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
        start_picture=figure(
            content.pictures,
            f'images/Simulation_{shot.number}_start.png',
            f'Figure {first_figure}: simulation {shot.number}, start',
            f'The table before simulation {shot.number}.',
        ),
        end_picture=figure(
            content.pictures,
            f'images/Simulation_{shot.number}_end.png',
            f'Figure {first_figure + 1}: simulation {shot.number}, end. Dashed circles: where the '
            'balls that moved started; lines: their paths',
            f'The table after simulation {shot.number}, with the path of each ball that moved.',
        ),
        film=_film(shot.number, film) if film else '',
        positions=_positions(shot),
    )


def _film(shot: int, path: str) -> Html:
    return Html(
        f'<figure class="film"><video controls preload="metadata" src="{to_html(path)}"></video>'
        f'<figcaption>Film of simulation {shot} ({_link(path, "file")}).</figcaption></figure>'
    )


def _link(path: str, text: str | None = None) -> Html:
    return Html(f'<a href="{to_html(path)}">{to_html(text or path)}</a>')


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
