"""How balls lie: those in a pocket are at its centre, in the order in which they fell."""

import numpy as np
import pytest

from pool_sim_ros.physics import pool_table, report_table
from pool_sim_ros.simulator.layout import layout_at, pockets_at, start_layout


@pytest.fixture(scope='module')
def table():
    return pool_table('7ft')


def test_at_the_start_no_ball_is_turned_or_caught(table):
    layout = start_layout(table)
    assert np.array_equal(layout.orientations, [[0, 0, 0, 1]] * 16)
    assert layout.pocketed == () and np.array_equal(layout.positions, table.positions)


def test_discs_have_no_orientation():
    layout = start_layout(report_table())
    assert layout.orientations is None and layout.pocketed == ()
    assert pockets_at(report_table(), layout.positions).tolist() == [-1] * 11


def test_a_ball_within_a_pocket_lies_at_its_centre(table):
    positions = table.positions.copy()
    for ball, pocket in ((5, 1), (9, 4), (2, 1)):
        positions[ball] = table.pockets[pocket, :2] + 0.6 * table.pockets[pocket, 2]
    before = positions.copy()
    layout = layout_at(table, positions, before=(9, 7, 5))
    assert layout.pocketed == (9, 5, 2)  # 7 has come back
    for ball, pocket in ((5, 1), (9, 4), (2, 1)):
        assert np.array_equal(layout.positions[ball], table.pockets[pocket, :2])
    assert np.array_equal(positions, before)


def test_the_circle_of_a_pocket_begins_at_its_radius(table):
    x, y, radius = table.pockets[1]
    places = np.array([[x, y + radius * 0.999999], [x, y + radius * 1.000001]])
    assert pockets_at(table, places).tolist() == [1, -1]
