"""Each shot by several methods, to show how print, time slicing and exact result differ."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from pool_sim_ros.me212 import cue_velocity
from pool_sim_ros.physics import INCH, Table, Trajectory, simulate

SLICES = (1e-4, 1e-5, 2e-6, 1e-6)
"""Slices to compare, s; the last is the report's."""

STATED_E_CUE_BALL = 0.95
"""`e_cn` of Listing 3, line 13, which states it but does not use it."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """One of the report's shots on its table, computed by several methods.

    Attributes
    ----------
    number : int
        The shot.
    printed : ndarray of shape (n, 2)
        The final positions that the report printed, inches.
    exact : Trajectory
    sliced : dict
        Slice in s -> Trajectory.
    with_e_cn : Trajectory
        Time slicing with the cue ball's restitution from the property list.
    with_coulomb : Trajectory
        Time slicing with friction that opposes the slip of both balls.
    """

    number: int
    printed: np.ndarray
    exact: Trajectory
    sliced: Mapping[float, Trajectory]
    with_e_cn: Trajectory
    with_coulomb: Trajectory


def compare(table: Table, number: int, printed: Mapping[str, tuple[float, float]]) -> Comparison:
    """Compute a shot of the report by all methods.

    Parameters
    ----------
    table : Table
    number : int
        1 to 4.
    printed : mapping
        Label -> final (x, y) in inches, as the report printed it.

    Returns
    -------
    Comparison
    """
    velocity = cue_velocity(number, table)

    def slicing(table: Table, time_slice: float = SLICES[-1]) -> Trajectory:
        return simulate(table, velocity, integrator='time_slice', time_slice=time_slice)

    return Comparison(
        number,
        np.array([printed[label] for label in table.labels]),
        exact=simulate(table, velocity),
        sliced={time_slice: slicing(table, time_slice) for time_slice in SLICES},
        with_e_cn=slicing(replace(table, e_cue_ball=STATED_E_CUE_BALL)),
        with_coulomb=slicing(replace(table, ball_friction='coulomb')),
    )


def final_inches(trajectory: Trajectory) -> np.ndarray:
    """Return where the balls stopped, (n, 2) in inches."""
    return trajectory.final_positions / INCH


def greatest_difference(one: np.ndarray, other: np.ndarray) -> tuple[float, int]:
    """Return the greatest difference of two outcomes in x or y, and the index of its ball.

    Parameters
    ----------
    one, other : ndarray of shape (n, 2)

    Returns
    -------
    difference : float
        In the unit of `one` and `other`.
    ball : int
    """
    differences = np.abs(one - other).max(axis=1)
    return float(differences.max()), int(differences.argmax())
