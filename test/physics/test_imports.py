"""The physics is plain Python: beside the standard library it pulls in numpy and numba alone."""

import subprocess
import sys


def loaded_by(statement):
    """Return the packages that a fresh interpreter has loaded after a statement."""
    listing = subprocess.run(
        [sys.executable, '-c', f'{statement}; import sys; print(*sys.modules)'],
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    )
    return {name.partition('.')[0] for name in listing.stdout.split()}


def test_physics_imports_nothing_else():
    needed = loaded_by('import numpy, numba, concurrent.futures')
    assert loaded_by('import pool_sim_ros.physics') - needed - set(sys.stdlib_module_names) == {
        'pool_sim_ros'
    }
