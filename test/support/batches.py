"""Shots as the kernels take them, many at a time."""

import numpy as np

from pool_sim_ros.physics.outcomes import Ends

NO_LIMITS = (np.inf, 100_000)
"""End of the clock, s, and most events."""


def ends_of(outcomes):
    """Return the arrays of outcomes that kernels write to."""
    return Ends(*(getattr(outcomes, name) for name in Ends._fields))


def in_rows(velocities):
    """Return velocities of the cue ball, (m, 2), as (m, 1, 2)."""
    return np.array(velocities, dtype=float).reshape(-1, 1, 2)
