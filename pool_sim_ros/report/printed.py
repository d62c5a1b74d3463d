"""Whether a run is the one that the report printed."""

from __future__ import annotations

from dataclasses import replace

from pool_sim_ros.physics import Table, report_table
from pool_sim_ros.physics.simulate import REPORT_TIME_SLICE
from pool_sim_ros.settings import Settings


def is_report_table(table: Table) -> bool:
    """Return whether balls move on this table as on the report's; colours do not matter."""
    return _without_colors(table) == _without_colors(report_table())


def deviations(settings: Settings) -> list[str]:
    """Return in words all that differs from the run that the report printed; empty = nothing."""
    found = []
    if not is_report_table(settings.table):
        found.append('another table')
    if settings.report_integrator != 'time_slice':
        found.append(f'integrator {settings.report_integrator}')
    elif settings.time_slice != REPORT_TIME_SLICE:
        found.append(f'slices of {settings.time_slice:g} s')
    return found


def _without_colors(table: Table) -> Table:
    balls = tuple(replace(ball, color=(0.0, 0.0, 0.0)) for ball in table.balls)
    return replace(table, balls=balls)
