"""Fixtures for the report's tests: the four shots, computed once."""

from dataclasses import replace

import pytest
from page_reader import page_of

from pool_sim_ros.report.comparison import compare
from pool_sim_ros.report.played import play_shots
from pool_sim_ros.simulator import build_settings, default_values


@pytest.fixture(scope='session')
def settings():
    """The settings of the report's own run."""
    return build_settings(default_values())


@pytest.fixture(scope='session')
def shots(settings):
    """The four shots as the report has them, by number."""
    return {shot.number: shot for shot in play_shots(settings, (1, 2, 3, 4))}


@pytest.fixture(scope='session')
def other_settings(settings):
    """The settings of a table that the report knows nothing of: two balls less."""
    table = replace(settings.table, balls=settings.table.balls[:9])
    return replace(settings, table=table, report_integrator='event')


@pytest.fixture(scope='session')
def comparisons(settings, shots):
    """The comparison of each shot, in order."""
    return [compare(settings.table, number, shot.printed) for number, shot in shots.items()]


@pytest.fixture(scope='session')
def page(settings, shots, comparisons):
    """The page of the report's own run."""
    return page_of(settings, list(shots.values()), comparisons)
