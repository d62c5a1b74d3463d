"""The integrators by name, for those that only name them."""

import subprocess
import sys

from pool_sim_ros.physics import INTEGRATORS, REPORT_TIME_SLICE, integrators, report_table, simulate


def test_names():
    assert INTEGRATORS == ('event', 'time_slice') == integrators.INTEGRATORS
    assert REPORT_TIME_SLICE == 1e-6, 'Listing 2'


def test_each_plays():
    for integrator in INTEGRATORS:
        shot = simulate(report_table(), (-0.1, 0.0), integrator=integrator, time_slice=1e-3)
        assert shot.events['kind'].tolist() == [2]


def test_to_name_them_loads_no_numba():
    look = 'import pool_sim_ros.physics.integrators, sys; print("numba" in sys.modules)'
    found = subprocess.run(
        [sys.executable, '-c', look], capture_output=True, text=True, check=True, timeout=60
    )
    assert found.stdout.strip() == 'False'
