"""Whether a run is the run that the report printed, and how it differs."""

from __future__ import annotations

from dataclasses import replace

from pool_sim_ros.physics import REPORT_TIME_SLICE, Table, report_table


def is_report_table(table: Table) -> bool:
    """Return whether this is the report's table; colours do not count.

    Parameters
    ----------
    table : Table
    """
    return _without_colors(table) == _without_colors(report_table())


def deviations(table: Table, integrator: str, time_slice: float) -> list[str]:
    """Return the differences from the run that the report printed, in words; empty = none.

    Parameters
    ----------
    table : Table
    integrator : str
        The one that plays the shots of the report.
    time_slice : float
        Slice of the integrator `time_slice`, s.
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
