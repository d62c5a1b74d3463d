"""Parts of many shots, as one of several threads plays them."""

import numpy as np
import pytest
from batches import NO_LIMITS, ends_of, in_rows
from benchmark.workloads import random_velocities

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.physics.event_driven.parts import play_parts
from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.outcomes import PLAYED, new_outcomes


@pytest.mark.parametrize('moved', [False, True])
@pytest.mark.parametrize('wanted', [False, True])
def test_only_the_parts_that_are_given_are_played(wanted, moved):
    table, velocities = report_table(), random_velocities(10, seed=4)
    layout = simulate(table, (-2.0, 0.3)).final_positions if moved else None
    outcomes = new_outcomes(10, 11, None)
    ends = ends_of(outcomes)
    ends.failed[:] = 9
    store, told = EventStore(10) if wanted else None, []
    parts = [slice(0, 4), slice(4, 5)]
    play_parts(
        table,
        layout,
        (in_rows(velocities), np.empty((10, 0, 3)), np.empty((10, 0, 2))),
        NO_LIMITS,
        ends,
        iter(parts),
        store,
        told.append,
    )
    assert told == [4, 1]
    assert ends.failed.tolist() == [PLAYED] * 5 + [9] * 5
    shots = [simulate(table, velocity, positions=layout) for velocity in velocities[:5]]
    for k, shot in enumerate(shots):
        assert ends.finals[k].tobytes() == shot.final_positions.tobytes()
    if wanted:
        assert store.joined().tobytes() == b''.join(shot.events.tobytes() for shot in shots)
