"""What the engine keeps of a disc, and of the table on which it slides."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import Rectangle

DISC = np.dtype(
    [
        # What others look at when they look for whom they meet: the first cache line.
        ('x', 'f8'),  # position at `since`, m
        ('y', 'f8'),
        ('ux', 'f8'),  # unit direction of motion; zero at rest
        ('uy', 'f8'),
        ('speed', 'f8'),  # at `since`, m/s; zero at rest
        ('since', 'f8'),  # when this motion began, s
        ('radius', 'f8'),
        ('changes', 'i4'),  # how often its motion has changed
        ('phase', 'i2'),
        ('is_cue', 'i2'),
        # The second one.
        ('next_contact_time', 'f8'),  # when its next contact or end of phase is due, s; inf: none
        ('cell_exit_time', 'f8'),  # when it leaves its cell, s; inf for never
        ('inverse_mass', 'f8'),
        ('last_contact_time', 'f8'),  # s
        ('partner', 'i4'),  # what it meets then: a ball, or as in `boundary`
        ('partner_changes', 'i4'),  # the partner's `changes` when this was found
        ('cell_x', 'i4'),
        ('cell_y', 'i4'),
        ('previous', 'i4'),  # the ball before it in its cell; -1 for none
        ('repeats', 'i2'),  # weak contacts in quick succession, up to now
        ('presses', 'i2'),  # the same over a while: something presses it to others
        # Contacts in the rattle that `last_contact_time` belongs to; wide, so nothing is padded.
        ('rounds', 'i8'),
    ],
    align=True,
)
"""The state of one disc in the event-driven engine: two cache lines."""


class DiscTable(NamedTuple):
    """What the kernels know of a table on which discs slide; SI units."""

    boundary: Rectangle
    deceleration: float
    mu_ball_ball: float
    mu_ball_cushion: float
    e_cue_ball: float
    e_ball_ball: float
    e_ball_cushion: float
    coulomb: bool  # the law of friction between balls; otherwise `report`
    cue_ball: int  # its number; -1 for none


def discs_at_rest(
    positions: NDArray[np.float64],
    radii: NDArray[np.float64],
    masses: NDArray[np.float64],
    is_cue: NDArray[np.bool_],
) -> NDArray[np.void]:
    """Return the records, (n,) of DISC, of balls at rest at (n, 2) positions in m, (n,) kg."""
    records = np.zeros(len(positions), DISC)
    records['x'], records['y'] = positions.T
    records['radius'], records['inverse_mass'] = radii, 1.0 / masses
    records['is_cue'] = is_cue
    records['next_contact_time'] = records['cell_exit_time'] = np.inf
    records['last_contact_time'] = -np.inf
    return records
