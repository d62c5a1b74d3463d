from dataclasses import replace

import pytest

from pool_sim_ros.me212.printed import deviations, is_report_table
from pool_sim_ros.physics import REPORT_TIME_SLICE, report_table

TABLE = report_table()
BALLS = TABLE.balls


def with_cue_ball(**fields):
    return replace(TABLE, balls=(replace(BALLS[0], **fields), *BALLS[1:]))


def test_the_run_of_the_report_deviates_in_nothing():
    assert is_report_table(TABLE)
    assert deviations(TABLE, 'time_slice', REPORT_TIME_SLICE) == []


def test_colours_do_not_count():
    painted = with_cue_ball(color=(0.0, 0.0, 0.0))
    assert painted != TABLE and is_report_table(painted)


@pytest.mark.parametrize(
    'table',
    [
        with_cue_ball(mass=0.21),
        with_cue_ball(label='cue'),
        with_cue_ball(position=(1.6, 0.5)),
        replace(TABLE, balls=BALLS[:10]),
        replace(TABLE, e_cue_ball=0.95),
        replace(TABLE, ball_friction='coulomb'),
    ],
)
def test_another_table_is_a_deviation(table):
    assert not is_report_table(table)
    assert deviations(table, 'time_slice', REPORT_TIME_SLICE) == ['another table']


def test_another_integrator_is_a_deviation_and_its_slice_then_is_none():
    assert deviations(TABLE, 'event', 1e-3) == ['integrator event']


def test_another_slice_is_a_deviation():
    assert deviations(TABLE, 'time_slice', 1e-5) == ['slices of 1e-05 s']


def test_all_deviations_are_named():
    other = replace(TABLE, e_cue_ball=0.95)
    assert deviations(other, 'event', REPORT_TIME_SLICE) == ['another table', 'integrator event']
