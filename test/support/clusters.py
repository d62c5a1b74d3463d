"""Balls that touch, and are set off at once."""

import math

import numpy as np
from numba import njit

from pool_sim_ros.physics.event_driven.few_balls import note_motion
from pool_sim_ros.physics.event_driven.state import new_state
from pool_sim_ros.physics.log import new_log
from pool_sim_ros.physics.motion import set_off

APART = 0.1 * (1.0 + 1e-12)
"""Of the centres of balls of radius 0.05 that touch, m."""


def clusters(rng):
    """Return places of touching balls of radius 0.05 m, some of them in a corner."""
    rows = [
        (0.05 + APART * (i + j / 2), 0.05 + j * APART * math.sqrt(3) / 2)
        for i in range(3)
        for j in range(3)
    ]
    lonely = [(1.5, 0.5), (1.5 + APART, 0.5), (1.8, 0.2)]
    spots = [*(rows[k] for k in rng.permutation(9)[: rng.integers(2, 9)]), *lonely]
    return [spots[k] for k in rng.permutation(len(spots))]


@njit
def begin(state, velocities):
    for i in range(len(velocities)):
        set_off(state.balls[i], state.table, velocities[i, 0], velocities[i, 1])
        note_motion(state.grid.few, state.balls, i)


def moving(table, velocities, balls=None):
    """Return a state in which all balls of a table are set off, or records of balls at rest."""
    at_rest = table.balls_at_rest if balls is None else balls
    state = new_state(table.for_kernels, at_rest, new_log(0, 0))
    begin(state, np.asarray(velocities, dtype=float))
    return state
