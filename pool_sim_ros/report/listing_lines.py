"""The section that says, line by line, what Listings 2 and 3 do and which function does it here."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from pool_sim_ros.report.markup import Cell, Html, fill, table, to_html


class Lines(NamedTuple):
    """Some lines of a listing.

    Attributes
    ----------
    first, last : int
        As the report numbers them.
    task : str
        What they do.
    here : tuple of str
        What does it in this package; none where nothing has to.
    """

    first: int
    last: int
    task: str
    here: tuple[str, ...]


_MOVE = 'physics.time_slice.listing.move'
_MEET_CUSHIONS = 'physics.time_slice.listing.meet_cushions'
_MEET_BALLS = 'physics.time_slice.listing.meet_balls'
_COLLIDE = 'physics.time_slice.listing.collide'
_FRICTION = 'physics.contacts.report_friction'
_NEW_STATE = 'physics.time_slice.play.new_state'
_RUN = 'physics.time_slice.play.run'
_SLICES = 'physics.time_slice.slices.Slices'
_PICTURES = 'report.outputs.write_pictures'
_FRAMES = 'report.films.film_frames'

LISTING_2: Sequence[Lines] = (
    Lines(1, 5, 'Close figures and clear variables', ()),
    Lines(6, 12, 'Open the log', ('report.files.write_text',)),
    Lines(
        13,
        19,
        'Length of a slice, 1/1,000,000 s, and slices for each frame of the films',
        ('physics.REPORT_TIME_SLICE', 'report.films.RATE'),
    ),
    Lines(20, 25, 'Open the film of all shots', ('report.outputs.join_films',)),
    Lines(26, 34, 'Draw the table', ('report.drawing.TablePicture',)),
    Lines(35, 47, 'The balls: masses, radii, positions, colours', ('physics.report_table',)),
    Lines(48, 50, 'All pairs of balls; which ball is the cue ball', (_MEET_BALLS,)),
    Lines(
        51,
        57,
        'Ball nearest to the cue ball and the direction to it, for shot 4',
        ('me212.nearest_ball', 'me212.attitude_to_nearest', 'me212.format_aim'),
    ),
    Lines(58, 67, 'Velocities of the cue ball in the four shots', ('me212.cue_velocity',)),
    Lines(
        68,
        73,
        'For each shot: put all balls back',
        ('report.played.play_shots', _NEW_STATE),
    ),
    Lines(74, 79, 'Open the film of the shot', ('report.outputs.write_film',)),
    Lines(80, 82, 'Picture of the start', (_PICTURES,)),
    Lines(83, 85, 'Give the cue ball its velocity', (_NEW_STATE,)),
    Lines(
        86,
        94,
        'Slice after slice, until no ball has a velocity',
        (_RUN, 'physics.time_slice.play.anything_moves'),
    ),
    Lines(95, 96, 'Move every ball', (_MOVE,)),
    Lines(97, 97, 'Every ball against the cushions', (_MEET_CUSHIONS,)),
    Lines(98, 99, 'Every pair of balls', (_MEET_BALLS,)),
    Lines(100, 108, 'A frame of the films, 60 times a second', (_FRAMES,)),
    Lines(109, 116, 'Hold the last frame for one second', (_FRAMES, 'report.films.HOLD')),
    Lines(117, 117, 'Close the film of the shot', ('report.encoder.encode',)),
    Lines(118, 119, 'Picture of the end', (_PICTURES,)),
    Lines(120, 131, 'Log velocity and end positions, in inches', ('me212.format_shot',)),
    Lines(
        132,
        133,
        'Close the film of all shots and the log',
        ('report.outputs.join_films', 'report.files.write_text'),
    ),
)
"""The script, BilliardsCode.m."""

LISTING_3: Sequence[Lines] = (
    Lines(1, 4, 'One object for each ball; here one record of all balls', (_SLICES,)),
    Lines(
        5,
        18,
        'Table size, coefficients, gravity',
        ('physics.Table', 'physics.report_table'),
    ),
    Lines(
        19,
        33,
        'What a ball has: mass, radius, places, velocity, colour, label, balls that it touches',
        ('physics.Ball', _SLICES),
    ),
    Lines(34, 46, 'A new ball, in kg and m', ('physics.Ball',)),
    Lines(47, 53, 'Its picture', ('report.drawing.TablePicture',)),
    Lines(54, 59, 'Move: direction and speed', (_MOVE,)),
    Lines(60, 63, 'The cloth takes speed, at most all of it (Equation 10)', (_MOVE,)),
    Lines(64, 67, 'New velocity, and new place by the mean speed (Equation 10)', (_MOVE,)),
    Lines(68, 72, 'Cushions: the limits of the table', (_MEET_CUSHIONS,)),
    Lines(
        73,
        82,
        'Cushions at both ends: restitution, back inside, friction (Equation 9)',
        (_MEET_CUSHIONS,),
    ),
    Lines(83, 93, 'The same at both sides', (_MEET_CUSHIONS,)),
    Lines(94, 98, 'Two balls: whether they overlap', (_MEET_BALLS,)),
    Lines(99, 112, 'Once only for each contact: remember the pair', (_MEET_BALLS,)),
    Lines(
        113,
        118,
        'Coefficient of restitution; line 115 takes that of the cushions (section 4)',
        ('physics.contacts.restitution',),
    ),
    Lines(
        119,
        123,
        'Line of centres, and velocities along and across it (Equations 4 and 5)',
        (_COLLIDE,),
    ),
    Lines(
        124,
        129,
        'Normal velocities (Equations 1, 2 and 6): solved as symbols there, as a formula here',
        (_COLLIDE,),
    ),
    Lines(130, 132, 'Friction by the sign of the slip (Equations 3 and 6)', (_FRICTION,)),
    Lines(133, 139, 'Friction stops a tangential velocity at zero', (_FRICTION,)),
    Lines(140, 143, 'Back to x and y (Equation 7)', (_COLLIDE,)),
    Lines(144, 152, 'Forget a pair that is apart again', (_MEET_BALLS,)),
    Lines(153, 162, 'Draw the ball where it is', ('report.drawing.TablePicture.place',)),
    Lines(163, 169, 'Put it back to its start, at rest', (_NEW_STATE,)),
    Lines(170, 174, 'Give it a velocity', (_NEW_STATE,)),
    Lines(175, 190, 'The nearest of some balls', ('me212.nearest_ball',)),
    Lines(191, 195, 'The matrix of a rotation (Equations 5 and 7)', (_COLLIDE,)),
)
"""The class, PoolBall.m."""


def listing_lines_section() -> Html:
    """Return the section as HTML."""
    return fill(
        'listing_lines.html',
        listing_2=_described(LISTING_2, 'Listing 2: MATLAB script (BilliardsCode.m)'),
        listing_3=_described(LISTING_3, 'Listing 3: Class of a ball (PoolBall.m)'),
    )


def _described(listing: Sequence[Lines], caption: str) -> Html:
    rows = [
        [
            f'{part.first}' if part.first == part.last else f'{part.first}–{part.last}',
            Cell(to_html(part.task), 'words'),
            Cell('<br>'.join(map(_code, part.here)) or 'nothing', 'words'),
        ]
        for part in listing
    ]
    head = ['Lines', Cell('What they do', 'words'), Cell('Here, in pool_sim_ros', 'words')]
    return table(head, rows, f'{caption}, line by line.')


def _code(name: str) -> str:
    """Return a dotted name that may break after each dot."""
    return f'<code>{name.replace(".", ".<wbr>")}</code>'
