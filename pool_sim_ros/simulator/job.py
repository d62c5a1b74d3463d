"""A shot to compute."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pool_sim_ros.physics import Table, Trajectory, simulate
from pool_sim_ros.simulator.settings import Settings


@dataclass(frozen=True, eq=False)
class Job:
    """A shot to compute: everything that `simulate` needs, as it was at the strike."""

    table: Table
    velocity: tuple[float, float]
    positions: np.ndarray
    integrator: str
    time_slice: float
    until: float

    def run(self) -> Trajectory:
        """Compute the shot; takes from microseconds to seconds, most of it without the GIL."""
        return simulate(
            self.table,
            self.velocity,
            positions=self.positions,
            integrator=self.integrator,
            time_slice=self.time_slice,
            until=self.until,
        )


def make_job(
    settings: Settings, shot: int | None, velocity: tuple[float, float], positions: np.ndarray
) -> Job:
    """Return what is to be computed for a strike.

    Parameters
    ----------
    settings : Settings
    shot : int or None
        Number of a report shot, which begins on the start layout.
    velocity : tuple of float
        Of the cue ball, m/s.
    positions : ndarray of shape (n, 2)
        Where any other strike begins, m.
    """
    return Job(
        table=settings.table,
        velocity=velocity,
        positions=positions if shot is None else settings.table.positions,
        integrator=settings.integrator if shot is None else settings.report_integrator,
        time_slice=settings.time_slice,
        until=settings.max_shot_duration,
    )
