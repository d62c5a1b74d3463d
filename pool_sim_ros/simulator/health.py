"""How the simulator is doing, as `/diagnostics` says; no ROS, no clock."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pool_sim_ros.physics import V_MIN
from pool_sim_ros.simulator.sim_time import stamp_to_seconds

if TYPE_CHECKING:  # clients use `Diagnosis` too, and need no physics
    from pool_sim_ros.physics import Trajectory

ENERGY_SAMPLES = 1000
"""Most events of a shot after which its energy is looked up: it bounds the memory."""

ENERGY_ROUNDING = 1e-9
"""Relative rise of the energy that is taken for rounding."""

REASON_LENGTH = 200
"""Characters of the last rejection that are shown: a client may send long names."""


@dataclass(frozen=True)
class Diagnosis:
    """How the simulator has been doing for a second.

    Attributes
    ----------
    warning : str
        What is wrong; empty if nothing is.
    values : dict of str
        Name -> value, in the order in which they are shown.
    """

    warning: str
    values: dict[str, str]


class Health:
    """Collects what the next diagnosis says."""

    def __init__(self) -> None:
        self._rejected = 0
        self._last_rejection = 'none'
        self._compute_time: float | None = None
        self._energy_rise: float | None = None
        self._may_rise = False
        self._worst_lateness = 0.0
        self._before: tuple[float, int, int] | None = None

    def frame(self, lateness: float) -> None:
        """Note a frame that was `lateness` seconds late."""
        self._worst_lateness = max(self._worst_lateness, lateness)

    def rejected(self, reason: str) -> None:
        """Note a command that was rejected."""
        self._rejected += 1
        self._last_rejection = reason[:REASON_LENGTH]

    def shot(self, compute_time: float, energy_rise: float | None, may_rise: bool) -> None:
        """Note a shot that was computed.

        Parameters
        ----------
        compute_time : float
            s.
        energy_rise : float or None
            As `energy_rise` returns it; None where the shot could not be computed.
        may_rise : bool
            Whether the law of friction between balls may let the energy rise.
        """
        self._compute_time = compute_time
        self._energy_rise = energy_rise
        self._may_rise = may_rise

    def diagnose(
        self, now: float, stamp: int, real_time_factor: float, ticks_behind: int, slips: int
    ) -> Diagnosis:
        """Return the diagnosis since the one before, and begin the next period.

        Parameters
        ----------
        now : float
            Wall time, s, from any origin.
        stamp : int
            Sim time, ns.
        real_time_factor : float
            Sim seconds per wall second that are aimed at; 0 = as fast as possible.
        ticks_behind : int
            Frames that are due and not yet shown.
        slips : int
            How often the simulator could not keep up since the start, so that time slipped.
        """
        before, self._before = self._before, (now, stamp, slips)
        speed = 'unknown'
        if before is not None and now > before[0]:
            speed = f'{stamp_to_seconds(stamp - before[1]) / (now - before[0]):.3f}'
        lateness, self._worst_lateness = self._worst_lateness, 0.0
        values = {
            'achieved speed (sim s / s)': speed,
            'real_time_factor': f'{real_time_factor:g}',
            'ticks behind': str(ticks_behind),
            'times slipped': str(slips),
            'worst frame lateness (ms)': f'{lateness * 1e3:.3f}',
            'rejected commands': str(self._rejected),
            'last rejection': self._last_rejection,
            'compute time of the last shot (s)': _number(self._compute_time),
            'energy rise of the last shot (relative)': _number(self._energy_rise),
            'energy check': self._energy_check(),
        }
        return Diagnosis(self._warning(slips - before[2] if before else 0), values)

    def _energy_check(self) -> str:
        if self._energy_rise is None:
            return 'no shot yet' if self._compute_time is None else 'no result'
        if self._energy_rise <= ENERGY_ROUNDING:
            return 'never rose, but for rounding and weak contacts'
        return 'rose, as ball_friction report may let it' if self._may_rise else 'rose'

    def _warning(self, slips: int) -> str:
        if self._energy_check() == 'rose':
            return 'the energy rose in the last shot'
        return 'too slow for the real_time_factor: time slipped' if slips > 0 else ''


def energy_rise(trajectory: Trajectory) -> float:
    """Return the largest rise of the kinetic energy from one event to a later one.

    Weak contacts may add a little (docs/physics.md): at each event that much is no rise.

    Parameters
    ----------
    trajectory : Trajectory

    Returns
    -------
    float
        Relative to the energy at the strike; 0 where it never rises.
    """
    times = trajectory.events['t'][:: len(trajectory.events) // ENERGY_SAMPLES + 1]
    times = np.concatenate([[0.0], times])
    squares = np.sum(trajectory.velocities(times) ** 2, axis=2)
    table, masses = trajectory.table, trajectory.table.masses
    if table.motion == 'ball':  # the inertia of a sphere is 2/5 m R^2
        squares += 0.4 * np.sum(trajectory.spins(times) ** 2, axis=2) * table.radii**2
    energies = 0.5 * squares @ masses
    if energies[0] == 0.0:
        return 0.0
    # Where balls in a row part at V_MIN, the outermost are several times as fast as one pair.
    allowed = len(trajectory.events) * float(np.sum(masses)) * V_MIN**2
    rise = float(np.max(energies - np.minimum.accumulate(energies))) - allowed
    return max(rise, 0.0) / float(energies[0])


def _number(value: float | None) -> str:
    return 'none' if value is None else f'{value:.6g}'
