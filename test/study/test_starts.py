"""Layouts at random."""

import dataclasses
import re

import numpy as np
import pytest

from pool_sim_ros.physics import check_layout, pool_table, report_table
from pool_sim_ros.study.starts import drawn_starts, starts_of


@pytest.fixture(scope='module')
def report():
    return report_table()


@pytest.fixture(scope='module')
def seven():
    return pool_table('7ft')


@pytest.mark.parametrize('name', ['report', 'seven'])
def test_each_drawn_layout_can_be_and_no_two_are_equal(name, request):
    table = request.getfixturevalue(name)
    layouts = starts_of(table, 300)
    assert layouts.shape == (300, len(table.balls), 2)
    for layout in layouts:
        check_layout(table, layout)
    assert len(np.unique(layouts.reshape(300, -1), axis=0)) == 300


def test_balls_lie_everywhere_on_the_cloth(report):
    x, y = starts_of(report, 2000)[:, 0].T
    radius = report.radii[0]
    for values, size in ((x, report.length), (y, report.width)):
        counts = np.histogram(values, 4, (radius, size - radius))[0]
        assert counts.sum() == 2000 and counts.min() > 400


def test_they_are_drawn_once(report):
    assert drawn_starts(report, 50) is drawn_starts(report_table(), 50)


def test_a_layout_of_ones_own_is_taken(report):
    assert (starts_of(report, report.positions) == report.positions).all()
    assert starts_of(report, [report.positions] * 3).shape == (3, 11, 2)


@pytest.mark.parametrize(
    ('starts', 'message'),
    [
        (0, 'starts: 0 must be 1 to 10,000,000 layouts, or an array'),
        (-5, 'starts: -5 must be'),
        (True, 'starts: must be a whole number'),
        ('many', 'starts: must be a whole number, or layouts of shape (11, 2) or (k, 11, 2)'),
        (np.zeros((0, 11, 2)), 'starts: must be'),
        (np.zeros((2, 10, 2)), 'starts: must be'),
        (np.zeros((2, 11, 2)), "starts[0]: ball 'C'"),
        (np.full((1, 11, 2), np.nan), "starts[0]: ball 'C'"),
    ],
)
def test_what_is_no_layout_is_refused(report, starts, message):
    with pytest.raises(ValueError, match='^' + re.escape(message)):
        starts_of(report, starts)


def test_the_cue_ball_may_not_lie_in_a_pocket(seven):
    layout = seven.positions.copy()
    layout[0] = seven.pockets[0, :2]
    with pytest.raises(ValueError, match=r'^starts\[0\]: the cue ball lies in a pocket$'):
        starts_of(seven, layout)


def test_a_table_that_is_too_full_is_refused(report):
    balls = [
        dataclasses.replace(ball, radius=0.13, position=(0.2 + 0.3 * (k % 7), 0.2 + 0.3 * (k // 7)))
        for k, ball in enumerate(report.balls * 2)
    ]
    balls = [dataclasses.replace(ball, label=str(k)) for k, ball in enumerate(balls)][:21]
    with pytest.raises(ValueError, match='^table: no room at random for ball'):
        starts_of(dataclasses.replace(report, balls=balls), 50)
