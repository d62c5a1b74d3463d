"""Whether a run is the one that the report printed."""

from __future__ import annotations

from dataclasses import replace

from pool_sim_ros.physics import REPORT_TIME_SLICE, Table, report_table


def is_report_table(table: Table) -> bool:
    """Return whether balls move on this table as on the report's; colours do not matter."""
    return _without_colors(table) == _without_colors(report_table())


def deviations(table: Table, integrator: str, time_slice: float) -> list[str]:
    """Return in words all that differs from the run that the report printed; empty = nothing.

    Parameters
    ----------
    table : Table
    integrator : str
        The one that plays the report's shots.
    time_slice : float
        s.
    """
    found = []
    if not is_report_table(table):
        found.append('another table')
    if integrator != 'time_slice':
        found.append(f'integrator {integrator}')
    elif time_slice != REPORT_TIME_SLICE:
        found.append(f'slices of {time_slice:g} s')
    return found


def _without_colors(table: Table) -> Table:
    balls = tuple(replace(ball, color=(0.0, 0.0, 0.0)) for ball in table.balls)
    return replace(table, balls=balls)
