"""A shot to compute: made at the strike, computed later and elsewhere."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Integrator, Table, Trajectory, simulate
from pool_sim_ros.simulator.settings import Settings

MOST_SLICES = 2_000_000_000
"""Slices in a shot: what parameters in their ranges ask for would else be computed for days."""


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
    spin : tuple of float or None
        Of the cue ball, rad/s; None on a table of discs.
    """

    table: Table
    velocity: tuple[float, float]
    positions: NDArray[np.float64]
    integrator: Integrator
    time_slice: float
    until: float
    spin: tuple[float, float, float] | None = None
    _cancelled: threading.Event = field(default_factory=threading.Event, init=False, repr=False)

    def cancel(self) -> None:
        """Let `run` come to its end soon, with ShotCancelled: nobody wants the shot any more."""
        self._cancelled.set()

    def run(self) -> Trajectory:
        """Compute the shot; this takes microseconds to minutes, mostly without the GIL."""
        return simulate(
            self.table,
            self.velocity,
            spins=self.spin,
            positions=self.positions,
            integrator=self.integrator,
            time_slice=self.time_slice,
            until=self.until,
            cancelled=self._cancelled.is_set,
        )


def make_job(
    settings: Settings,
    shot: int | None,
    velocity: tuple[float, float],
    positions: NDArray[np.float64],
    spin: tuple[float, float, float] | None = None,
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
    spin : tuple of float, optional
        Of the cue ball, where balls spin, rad/s.
    """
    integrator = settings.integrator if shot is None else settings.report_integrator
    until = settings.max_shot_duration
    if integrator == 'time_slice':
        until = min(until, MOST_SLICES * settings.time_slice)
    return Job(
        table=settings.table,
        velocity=velocity,
        positions=positions if shot is None else settings.table.positions,
        integrator=integrator,
        time_slice=settings.time_slice,
        until=until,
        spin=spin,
    )
