"""One shot, played by the kernel that plays many."""

import numpy as np

from pool_sim_ros.physics.event_driven.batch import play_some
from pool_sim_ros.physics.log import EVENT
from pool_sim_ros.physics.outcomes import Ends


def play_one(state, start, velocities, layout, limits, ends, spins=None):
    """Play one shot; return how it ended, how long it took in s, and whether all balls rest.

    `ends`, (2, n, 2), takes the final positions and velocities; `spins`, (k, 3) in rad/s, are none
    by default.
    """
    spins = np.empty((0, 3)) if spins is None else np.array(spins, dtype=float).reshape(-1, 3)
    counts = [np.empty(1, np.int64) for _ in range(2)]
    pocketed = np.empty((1, len(state.balls)), np.int64)
    one = Ends(ends[:1], np.empty(1), counts[0], pocketed, counts[1], np.empty(1, np.int8))
    shots = velocities[np.newaxis], spins[np.newaxis], layout[np.newaxis]
    room = (one, ends[1], np.empty(0, EVENT))
    _, _, complete = play_some(state, start, shots, (0, 0), limits, room)
    return int(one.failed[0]), float(one.durations[0]), complete
