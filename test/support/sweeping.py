"""Sweeps of the tests, and whether two datasets have the same bits."""

import numpy as np
import xarray  # noqa: F401, without it and zarr there are no sweeps
import zarr  # noqa: F401

from pool_sim_ros.physics import report_table
from pool_sim_ros.study.ranges import normal, uniform

TABLE = report_table()
NAMES = {'angle': np.linspace(150.0, 210.0, 30), 'speed': normal(3.0, 0.2), 'e_ball_ball': 0.9}
"""Inputs with a row, and with numbers that are drawn."""

TEXTS = ['angle=150:210:30', 'speed=normal(3,0.2)', 'e_ball_ball=0.9']
"""The same for the command."""

DRAWN = {'angle': uniform(150.0, 210.0), 'speed': uniform(1.0, 4.0)}


def assert_same_bits(one, other):
    """Fail where two datasets differ, even in a bit."""
    assert set(one.variables) == set(other.variables) and one.sizes == other.sizes
    for name in one.variables:
        first, second = one[name].values, other[name].values
        if first.dtype.kind in 'iuf':
            assert first.dtype == second.dtype and one[name].dims == other[name].dims, name
            assert first.tobytes() == second.tobytes(), name
        else:
            assert first.tolist() == second.tolist(), name
