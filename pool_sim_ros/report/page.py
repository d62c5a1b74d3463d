"""The report as one page: the given data, the equations, the shots, and their accuracy."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pool_sim_ros
from pool_sim_ros.physics import INCH
from pool_sim_ros.report.comparison import Comparison, final_inches, greatest_difference
from pool_sim_ros.report.comparison_page import comparison_section
from pool_sim_ros.report.listing_lines import listing_lines_section
from pool_sim_ros.report.markup import (
    Html,
    ball_name,
    figure,
    fill,
    join,
    link,
    number,
    pair,
    short,
    table,
)
from pool_sim_ros.report.mathml import with_formulae
from pool_sim_ros.report.outline import contents, list_of, numbered
from pool_sim_ros.report.part_one import example
from pool_sim_ros.report.played import PlayedShot, verdict
from pool_sim_ros.report.shots_page import shots_section
from pool_sim_ros.simulator import Settings

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
    log : str
        Listing 1 of this run.
    """

    settings: Settings
    shots: Sequence[PlayedShot]
    comparisons: Sequence[Comparison]
    pictures: Mapping[str, bytes]
    films: Mapping[int, str]
    files: Sequence[str]
    log: str


def make_page(content: Content) -> str:
    """Return the page as HTML, with all pictures inside."""
    sections = numbered(
        join(
            [
                _part_1(content),
                _part_2(content),
                shots_section(content.log, content.shots, content.pictures, content.films),
                comparison_section(content.settings.table, content.comparisons),
                listing_lines_section(),
            ],
            '\n',
        )
    )
    page = fill(
        'page.html',
        policy=POLICY,
        style=fill('style.css'),
        version=pool_sim_ros.__version__,
        ball_count=len(content.settings.table.balls),
        findings=_findings(content),
        contents=contents(sections),
        figures=list_of('Figure', sections),
        tables=list_of('Table', sections),
        listings=list_of('Listing', sections),
        sections=sections,
        files=join((link(name) for name in content.files), ', '),
    )
    return with_formulae(page)


def _findings(content: Content) -> Html:
    """Return the result of the run, and how far the exact result is from the print."""
    settings = content.settings
    how = ['time slicing with slices of ', short(settings.time_slice), ' s, as the listing does it']
    if settings.report_integrator == 'event':
        how = ['the exact integrator, from contact to contact']
    found = ['Computed by ', *how, '. ', verdict(settings, content.shots)]
    off = [
        (*greatest_difference(final_inches(each.exact), each.printed), each.number)
        for each in content.comparisons
    ]
    if off:
        most, ball, shot = max(off)
        found += [
            ' The exact result of the same equations differs from the print by up to ',
            f'{most:.2f} in (ball {settings.table.labels[ball]} in shot {shot}); ',
            'section 4 has the reasons.',
        ]
    return join(found, '')


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
            'Figure 1: Part 1 set-up',
            'Ball a moves past the centre of ball b at the offset e.',
            'set-up',
        ),
        construction_picture=figure(
            content.pictures,
            'images/Part_1_construction.png',
            'Figure 2: Part 1 construction lines',
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
            'Velocities of the example, m/s. The tangent t points to the left of n.',
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
    method = fill(f'{settings.report_integrator}.html', time_slice=short(settings.time_slice))
    return fill(
        'part_2.html',
        ball_count=len(given.balls),
        layout_picture=figure(
            content.pictures,
            'images/Table_layout.png',
            'Figure 3: Table layout',
            'The table from above with all balls where they start.',
        ),
        constants=table(['Constant', 'Value'], constants, 'Constants of the table.', (1,)),
        balls=table(
            ['Ball', 'Start, in', 'Start, m', 'Radius, in', 'Mass, g'],
            balls,
            'Table 1: Starting positions of the balls, [x, y].',
        ),
        deceleration=f'{given.deceleration:g}',
        ball_friction=given.ball_friction,
        angle_error=f'{math.degrees(error):.4f}',
        distance_error=f'{math.sin(error) * 2000:.4f}',
        method=method,
    )
