"""A shot to compute: made at the strike, computed later and elsewhere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Integrator, Table, Trajectory, simulate
from pool_sim_ros.simulator.settings import Settings


@dataclass(frozen=True, eq=False)
class Job:
    """A shot to compute: everything that `simulate` needs, as it was at the strike.

    Attributes
    ----------
    table : Table
    velocity : tuple of float
        Of the cue ball, m/s.
    positions : ndarray of shape (n, 2)
        Where the balls start, m.
    integrator : str
    time_slice : float
        Slice of the integrator `time_slice`, s.
    until : float
        Longest duration, s; a shot that would last longer is cut there.
    """

    table: Table
    velocity: tuple[float, float]
    positions: NDArray[np.float64]
    integrator: Integrator
    time_slice: float
    until: float

    def run(self) -> Trajectory:
        """Compute the shot; this takes microseconds to seconds, mostly without the GIL."""
        return simulate(
            self.table,
            self.velocity,
            positions=self.positions,
            integrator=self.integrator,
            time_slice=self.time_slice,
            until=self.until,
        )


def make_job(
    settings: Settings,
    shot: int | None,
    velocity: tuple[float, float],
    positions: NDArray[np.float64],
) -> Job:
    """Return the job for a strike.

    Parameters
    ----------
    settings : Settings
    shot : int or None
        Number of a report shot, which starts from the start layout.
    velocity : tuple of float
        Of the cue ball, m/s.
    positions : ndarray of shape (n, 2)
        Where the balls rest, from which any other shot starts, m.
    """
    return Job(
        table=settings.table,
        velocity=velocity,
        positions=positions if shot is None else settings.table.positions,
        integrator=settings.integrator if shot is None else settings.report_integrator,
        time_slice=settings.time_slice,
        until=settings.max_shot_duration,
    )
