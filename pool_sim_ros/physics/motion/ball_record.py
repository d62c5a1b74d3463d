"""What the engine keeps of a ball that slides, rolls and spins, and of the table under it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import pocket_at

BALL = np.dtype(
    [
        # What others look at when they look for whom they meet: the first cache line.
        ('x', 'f8'),  # position at `since`, m; infinite for a ball in a pocket
        ('y', 'f8'),
        ('vx', 'f8'),  # velocity at `since`, m/s
        ('vy', 'f8'),
        ('ax', 'f8'),  # m/s^2
        ('ay', 'f8'),
        ('since', 'f8'),  # when this motion began, s
        ('changes', 'i4'),  # how often its motion has changed
        ('phase', 'i2'),
        ('is_cue', 'i2'),
        # The second one.
        ('next_contact_time', 'f8'),  # when its next contact or end of phase is due, s; inf: none
        ('cell_exit_time', 'f8'),  # when it leaves its cell, s; inf for never
        ('phase_end', 'f8'),  # when it stops to slide, or to roll, s
        ('radius', 'f8'),
        ('inverse_mass', 'f8'),
        ('last_contact_time', 'f8'),  # s
        ('partner', 'i4'),  # what it meets then: a ball, or as in `boundary`
        ('partner_changes', 'i4'),  # the partner's `changes` when this was found
        ('cell_x', 'i4'),
        ('cell_y', 'i4'),
        # The third one.
        ('wx', 'f8'),  # angular velocity at `since`, rad/s
        ('wy', 'f8'),
        ('wz', 'f8'),
        ('previous', 'i4'),  # the ball before it in its cell; -1 for none
        ('pocket', 'i4'),  # in which it is; -1 for none
        ('repeats', 'i2'),  # weak contacts in quick succession, up to now
        ('presses', 'i2'),  # the same over a while
        ('rounds', 'i4'),  # contacts in the rattle that `last_contact_time` belongs to
    ],
    align=True,
)
"""The state of one ball in the event-driven engine: less than three cache lines."""


class BallTable(NamedTuple):
    """What the kernels know of a table on which balls spin; SI units."""

    boundary: Any
    slide: float  # deceleration of a ball that slides, m/s^2
    roll: float  # of one that rolls, m/s^2
    spin: float  # angular deceleration of the spin about the vertical axis, rad/s^2
    radius: float  # of every ball, m
    rubbing: Any  # a BallLaw
    edge: Any  # an EdgeLaw
    e_cue_ball: float
    e_ball_ball: float
    e_ball_cushion: float
    coulomb: bool  # friction here never adds energy: no shot runs away
    cue_ball: int  # its number; -1 for none

    @staticmethod
    def compile_notice() -> str:
        """Return what to say before this is compiled, see `kernel_cache`."""
        return 'the physics of balls that spin, on the first run only: this takes about 20 s'


def spheres_at_rest(
    positions: NDArray[np.float64],
    radii: NDArray[np.float64],
    masses: NDArray[np.float64],
    is_cue: NDArray[np.bool_],
    boundary: Any,
) -> NDArray[np.void]:
    """Return the records, (n,) of BALL, of balls at rest at (n, 2) positions in m, (n,) kg."""
    records = np.zeros(len(positions), BALL)
    records['x'], records['y'] = positions.T
    records['radius'], records['inverse_mass'] = radii, 1.0 / masses
    records['is_cue'] = is_cue
    records['phase_end'] = np.inf
    records['next_contact_time'] = records['cell_exit_time'] = np.inf
    records['last_contact_time'] = -np.inf
    for record in records:
        record['pocket'] = pocket_at(boundary, record['x'], record['y'])
        if record['pocket'] >= 0:
            record['x'] = record['y'] = np.inf
    return records
