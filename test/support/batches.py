"""Shots as the kernels take them, many at a time."""

import numpy as np

from pool_sim_ros.physics.outcomes import NO_POCKETED, Ends

NO_LIMITS = (np.inf, 100_000)
"""End of the clock, s, and most events."""


NO_SPINS = np.empty((0, 3))
"""Of one shot without any."""


def ends_of(outcomes):
    """Return the arrays of outcomes that kernels write to where there are no pockets."""
    arrays = {name: getattr(outcomes, name) for name in Ends._fields}
    return Ends(**(arrays | {'pocketed': NO_POCKETED}))


def in_rows(velocities):
    """Return velocities of the cue ball, (m, 2), as (m, 1, 2)."""
    return np.array(velocities, dtype=float).reshape(-1, 1, 2)
