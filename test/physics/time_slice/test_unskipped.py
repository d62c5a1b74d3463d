"""The report's integrator against the same loop with nothing left out, to the last bit."""

import numpy as np
import pytest
from benchmark import unskipped
from tables import report_shots

from pool_sim_ros.physics import report_table, simulate


def assert_nothing_was_skipped_wrongly(velocity, time_slice):
    table = report_table()
    positions, velocities, slices = unskipped.play(table, velocity, time_slice)
    shot = simulate(table, velocity, integrator='time_slice', time_slice=time_slice)
    assert np.any(positions != table.positions)
    assert_same_bits(shot.final_positions, positions)
    assert_same_bits(shot.final_velocities, velocities)
    assert shot.duration == slices * time_slice


def assert_same_bits(found, expected):
    """Equal to the last bit; the two zeros count as one number."""
    np.testing.assert_array_equal((found + 0.0).view(np.int64), (expected + 0.0).view(np.int64))


@pytest.mark.parametrize('time_slice', [1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize('shot', [0, 1, 2, 3])
def test_coarse_slices(shot, time_slice):
    assert_nothing_was_skipped_wrongly(report_shots()[shot], time_slice)


def test_the_slices_of_the_report():
    """Shot 1, with 24 contacts and stops, in slices of 1e-6 s."""
    assert_nothing_was_skipped_wrongly(report_shots()[0], 1e-6)
