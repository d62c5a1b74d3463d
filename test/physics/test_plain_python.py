"""With NUMBA_DISABLE_JIT=1 everything plays as it does compiled, only slowly."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

from pool_sim_ros.physics.plain_python import as_plain_python, with_attributes

PLAY = """
import dataclasses, json
import numpy as np
from benchmark.workloads import dense_table
from pool_sim_ros.physics import (
    compile_kernels, report_table, simulate, simulate_many, two_ball_collision
)
from tables import LAWS, report_shots, table_of, under

found = []
few = table_of([(0.3, 0.5), (0.8, 0.52), (1.2, 0.4)])
compile_kernels(few)
for law in LAWS:
    table = under(report_table(), ball_friction=law)
    for velocity in report_shots()[1:3]:
        shot = simulate(table, velocity)
        found.append(shot.final_positions.tolist())
        found.append(shot.positions([0.0, 0.5, 1.0]).tolist())
        found.append(shot.path(0).tolist())
        found.append([list(map(float, event)) for event in shot.events.tolist()])
    sliced = simulate(under(few, ball_friction=law), (2.0, 0.1), integrator='time_slice',
                      time_slice=1e-3)
    found.append(sliced.final_positions.tolist())
    found.append(len(sliced.events))
layouts = np.array([few.positions, few.positions + 0.01, few.positions - 1.0])
for integrator in ('event', 'time_slice'):
    outcomes = simulate_many(
        few, [(2.0, 0.0), (1.0, 0.3), (1.0, 1.0)], positions=layouts, integrator=integrator,
        time_slice=1e-3, errors='mark', threads=2, events=True,
    )
    found += [outcomes.finals[:2].tolist(), outcomes.failed.tolist(), outcomes.offsets.tolist()]
many = dense_table(45, decelerating=True)
velocities = np.random.default_rng(1).normal(size=(45, 2))
found.append(simulate(many, velocities, until=0.05).final_positions.tolist())
try:
    simulate(few, (1.0, 0.0), positions=few.positions - 1.0)
except ValueError as error:
    found.append(str(error))
print(json.dumps(found))
"""


def played(**environment):
    """Return what a process finds, and what else it says."""
    done = subprocess.run(
        [sys.executable, '-c', PLAY],
        env={**os.environ, 'PYTHONPATH': os.pathsep.join(sys.path), **environment},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert (done.returncode, done.stderr) == (0, '')
    return json.loads(done.stdout)


def assert_equal(found, expected):
    assert type(found) is type(expected)
    if isinstance(found, list):
        assert len(found) == len(expected)
        for one, other in zip(found, expected, strict=True):
            assert_equal(one, other)
    elif isinstance(found, float):
        assert found == pytest.approx(expected, abs=1e-9, nan_ok=True)
    else:
        assert found == expected


def test_everything_plays_as_it_does_compiled():
    assert_equal(played(NUMBA_DISABLE_JIT='1'), played(NUMBA_DISABLE_JIT='0'))


RECORDS = np.zeros(2, [('width', 'f8'), ('count', 'i8')])


def test_fields_are_attributes_and_shared():
    inner, number, plain = with_attributes((RECORDS, 1.5, np.zeros(3)))
    inner[1].width = 2.0
    assert RECORDS['width'].tolist() == [0.0, 2.0]
    assert number == 1.5 and type(plain) is np.ndarray
    assert with_attributes(inner).width.tolist() == [0.0, 2.0]


def test_a_kernel_that_another_calls_is_called_as_it_is():
    seen = []

    @as_plain_python
    def inner(records):
        seen.append(records)

    @as_plain_python
    def outer(records):
        inner(RECORDS)
        inner(records)
        return records[0].count

    assert outer(RECORDS) == 0
    assert seen[0] is RECORDS and isinstance(seen[1], np.recarray)


def test_after_an_error_all_is_as_before():
    @as_plain_python
    def fail(records):
        raise ValueError(type(records).__name__)

    for _ in range(2):
        with pytest.raises(ValueError, match='recarray'):
            fail(RECORDS)
    with np.errstate(all='raise'), pytest.raises(FloatingPointError):
        np.float64(1.0) / np.float64(0.0)
