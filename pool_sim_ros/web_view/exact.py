"""The exact result of a shot of the report beside the printed one, and why they differ."""

from __future__ import annotations

from typing import Any

import numpy as np

from pool_sim_ros.me212 import cue_velocity
from pool_sim_ros.physics import INCH, EventKind, Table, Trajectory, simulate
from pool_sim_ros.web_view.motion import motion_fields

HEAD_ON = 4
"""The shot in which the cue ball hits a ball without slip."""


def exact_fields(table: Table, number: int, printed: Trajectory) -> dict[str, Any]:
    """Return the exact result of a shot of the report.

    Parameters
    ----------
    table : Table
        The report's.
    number : int
        1 to 4.
    printed : Trajectory
        The shot as the report printed it, by time slicing.

    Returns
    -------
    dict
        The fields of `motion_fields`, and ``reason``: in one sentence, by how much and why the
        print differs.
    """
    exact = simulate(table, cue_velocity(number, table))
    return {**motion_fields(exact, table.positions), 'reason': _reason(number, printed, exact)}


def _reason(number: int, printed: Trajectory, exact: Trajectory) -> str:
    off = np.hypot(*(printed.final_positions - exact.final_positions).T) / INCH
    ball = int(off.argmax())
    apart = f'Ball {exact.table.labels[ball]} ends {_inches(off[ball])} from the exact result'
    if number == HEAD_ON:
        return (
            f'{apart}: the cue ball hits ball 1 head-on, and in the report the sign of a rounding '
            'error decides to which side friction pushes ball 1.'
        )
    contacts = int((exact.events['kind'] != EventKind.STOP).sum())
    return (
        f'{apart}: the report finds each contact up to one slice of 1e-6 s late, and {contacts} '
        'contacts amplify the error.'
    )


def _inches(distance: float) -> str:
    for digits in (2, 3, 4):
        if round(distance, digits) > 0.0:
            return f'{distance:.{digits}f} in'
    return 'less than 0.0001 in'
