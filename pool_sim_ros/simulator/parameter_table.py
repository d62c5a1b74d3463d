"""The node's parameters: their names, defaults, ranges and meanings, and when a change counts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

from pool_sim_ros.physics import (
    BALL_FRICTION_LAWS,
    CUSHION_MODELS,
    DISC_FRICTION_LAWS,
    FRICTION_BOUNDS,
    INTEGRATORS,
    MOTIONS,
    POOL_TABLES,
    REPORT_TIME_SLICE,
    pool_table_dimensions,
    report_table,
)

ParameterValue = bool | int | float | str | list[float] | list[str]
"""A value of a parameter, in the type of its default."""

BALL_LISTS = {'labels': 1, 'masses': 1, 'radii': 1, 'positions': 2, 'colors': 3}
"""The parameters ``balls.*``, and how many values each has for a ball."""

BOUNDARY_LISTS = {'cushion_segments': 6, 'cushion_noses': 3, 'pockets': 3}
"""The parameters ``table.*`` that are lists, and how many values make a row."""

REPORT = 'report'
"""The preset without parameters: the table of the report."""

PRESETS: tuple[str, ...] = (REPORT, *POOL_TABLES)


class Change(Enum):
    """When a new value counts."""

    NEVER = 'fixed at start-up'
    NEXT_STRIKE = 'counts from the next strike'
    NOW = 'counts at once'


SMALLEST = 1e-6
"""Least value beside 0 of a number whose range begins there. What comes near 1e-308 overflows where
something is divided by it, and means nothing on a table."""


@dataclass(frozen=True)
class ParameterSpec:
    """One parameter.

    Attributes
    ----------
    name : str
    default : ParameterValue
        Its type is the parameter's.
    doc : str
        What the parameter means, with its unit.
    change : Change
    least, most : float
        Range of a number, both ends included.
    smallest : float
        Where the range begins at 0: the least value beside 0.
    choices : tuple of str
        What a string may be; none = anything.
    choices_of : dict
        What it may be on a table of this motion only, where that is less.
    motion : str
        The motion of the tables that have it; empty = any.
    may_be_empty : bool
        Whether a string or a list may be empty.
    is_frame : bool
        Whether a string is the name of a frame.
    """

    name: str
    default: ParameterValue
    doc: str
    change: Change = Change.NEVER
    least: float = -math.inf
    most: float = math.inf
    smallest: float = 0.0
    choices: tuple[str, ...] = ()
    choices_of: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    motion: str = ''
    may_be_empty: bool = False
    is_frame: bool = False

    @property
    def holds_strings(self) -> bool:
        """Whether it is a list of strings."""
        return isinstance(self.default, list) and isinstance(self.default[0], str)

    @property
    def when(self) -> str:
        """When a new value counts, and on which tables, in words."""
        only = f'; only where table.motion is {self.motion}' if self.motion else ''
        return self.change.value + only

    def on(self, motion: str) -> ParameterSpec:
        """Return it as it is on a table of this motion."""
        return replace(self, choices=self.choices_of.get(motion, self.choices))


def _parameters() -> tuple[ParameterSpec, ...]:
    table, strike, now = report_table(), Change.NEXT_STRIKE, Change.NOW
    balls = table.balls
    friction = (
        ('mu_ball_ball', 'friction between two balls', 0.0, ''),
        ('mu_ball_surface', 'friction between a ball and the cloth', 1e-4, 'disc'),
        ('mu_ball_cushion', 'friction between a ball and a cushion', 0.0, ''),
    )
    restitution = (
        ('e_cue_ball', 'restitution between the cue ball and another'),
        ('e_ball_ball', 'restitution between two other balls'),
        ('e_ball_cushion', 'restitution between a ball and a cushion'),
    )
    per_ball = 'one given means all given'
    spec = ParameterSpec
    return (
        spec(
            'table.preset',
            REPORT,
            'the table that the other parameters change, racked where no balls are given',
            choices=PRESETS,
        ),
        spec(
            'table.motion',
            table.motion,
            'discs slide and lose speed; balls slide, roll and spin, and need what table.mu_slide '
            'to table.nose_height say',
            choices=MOTIONS,
        ),
        spec('table.length', table.length, 'x size between the cushions, m', least=0.01, most=1e3),
        spec('table.width', table.width, 'y size between the cushions, m', least=0.01, most=1e3),
        spec('table.gravity', table.gravity, 'm/s^2', least=0.01, most=1e3),
        *(
            spec(
                f'table.{name}',
                getattr(table, name),
                f'coefficient of {doc}',
                strike,
                least,
                10,
                smallest=0.0 if least else SMALLEST,
                motion=motion,
            )
            for name, doc, least, motion in friction
        ),
        *(
            spec(
                f'table.{name}',
                getattr(table, name),
                f'coefficient of {doc}',
                strike,
                0.0,
                1.0,
                smallest=SMALLEST,
            )
            for name, doc in restitution
        ),
        spec(
            'table.ball_friction',
            table.ball_friction,
            'law of friction between two balls',
            strike,
            choices=BALL_FRICTION_LAWS,
            choices_of={'disc': DISC_FRICTION_LAWS, 'ball': BALL_FRICTION_LAWS[1:]},
        ),
        *_of_balls_that_spin(),
        spec('balls.labels', list(table.labels), f'one for each ball, cue ball first; {per_ball}'),
        spec('balls.masses', [ball.mass for ball in balls], f'kg; {per_ball}'),
        spec('balls.radii', [ball.radius for ball in balls], f'm; {per_ball}'),
        spec(
            'balls.positions',
            [v for ball in balls for v in ball.position],
            f'start layout, x0, y0, x1, ..., m; {per_ball}',
        ),
        spec(
            'balls.colors',
            [v for ball in balls for v in ball.color],
            f'r0, g0, b0, r1, ..., each 0 to 1; {per_ball}',
        ),
        spec(
            'integrator',
            'event',
            'plays every strike but the report shots',
            strike,
            choices=INTEGRATORS,
            choices_of={'ball': INTEGRATORS[:1]},
        ),
        spec(
            'report_integrator',
            'time_slice',
            'plays the report shots; time_slice ends where the report printed',
            strike,
            choices=INTEGRATORS,
            choices_of={'ball': INTEGRATORS[:1]},
        ),
        spec(
            'time_slice',
            REPORT_TIME_SLICE,
            'slice of the integrator time_slice, s',
            strike,
            1e-7,
            1e-2,
        ),
        spec('max_cue_speed', 15.0, 'a faster strike is rejected, m/s', strike, 1e-3, 1e3),
        spec('max_shot_duration', 120.0, 'a longer shot is preempted, s', strike, 1e-3, 1e5),
        spec(
            'real_time_factor',
            1.0,
            'sim seconds per second; 0 = as fast as possible, and real time while nothing moves',
            now,
            0.0,
            1e4,
            smallest=SMALLEST,
        ),
        spec('step_ticks', 1, 'ticks that ~/step advances', now, 1, 1000),
        spec('publish_rate', 60, 'frames per second of sim time', least=1, most=1000),
        spec('frame_id', 'table', 'frame of all that is published', is_frame=True),
        spec('publish_clock', False, 'whether to publish /clock'),
        spec('start_paused', False, 'whether to start paused'),
        spec(
            'record',
            '',
            'new file to write a log of all commands to, for replay; empty = none',
            may_be_empty=True,
        ),
    )


def _of_balls_that_spin() -> tuple[ParameterSpec, ...]:
    """Return the parameters that only tables of motion `ball` have; the values are those of 7ft."""
    given, strike = pool_table_dimensions('7ft'), Change.NEXT_STRIKE
    assert given.cushions is not None, 'a table with pockets has cushions'
    lists = (
        (
            'cushion_segments',
            given.cushions.segments,
            'straight cushions: x0, y0, x1, y1 of the ends, m, and nx, ny, the unit normal into '
            'the table; empty with noses and pockets: four cushions around length x width',
        ),
        ('cushion_noses', given.cushions.noses, 'round noses of the cushions: x, y, radius, m'),
        ('pockets', given.pockets, "circles in which a ball's centre is caught: x, y, radius, m"),
    )
    coefficients = (
        ('mu_slide', given.mu_slide, 'coefficient of friction of a ball that slides', 1e-4, 10),
        ('mu_roll', given.mu_roll, 'coefficient of friction of a ball that rolls', 1e-4, 10),
        (
            'mu_spin',
            given.mu_spin,
            'spin about the vertical axis falls by 5 mu_spin g / (2 R), m',
            1e-6,
            10,
        ),
        ('nose_height', given.nose_height, "of the cushions' edge above the cloth, m", 1e-6, 1e3),
    )
    laws = (
        ('cushion_model', CUSHION_MODELS, 'what a cushion does to a ball'),
        ('friction_bound', FRICTION_BOUNDS, 'what bounds the friction between two balls'),
    )
    return (
        *(
            ParameterSpec(f'table.{name}', value, doc, strike, least, most, motion='ball')
            for name, value, doc, least, most in coefficients
        ),
        *(
            ParameterSpec(f'table.{name}', names[0], doc, strike, choices=names, motion='ball')
            for name, names, doc in laws
        ),
        *(
            ParameterSpec(
                f'table.{name}', rows.ravel().tolist(), doc, motion='ball', may_be_empty=True
            )
            for name, rows, doc in lists
        ),
    )


PARAMETERS = {spec.name: spec for spec in _parameters()}
"""Every parameter of the node but those of ROS itself, by name."""


def parameters_of(motion: str) -> dict[str, ParameterSpec]:
    """Return the parameters that a node has whose table is of this motion, by name."""
    return {
        name: spec.on(motion) for name, spec in PARAMETERS.items() if spec.motion in ('', motion)
    }


def default_values() -> dict[str, ParameterValue]:
    """Return the values without a parameter file: the report's table."""
    return {name: spec.default for name, spec in parameters_of('disc').items()}
