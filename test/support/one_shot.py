"""One shot, played by the kernel that plays many."""

import numpy as np

from pool_sim_ros.physics.event_driven.batch import play_some
from pool_sim_ros.physics.log import EVENT
from pool_sim_ros.physics.outcomes import Ends


def play_one(state, start, velocities, layout, limits, ends):
    """Play one shot; return how it ended, how long it took in s, and whether all balls rest.

    `ends`, (2, n, 2), takes the final positions and velocities.
    """
    numbers = np.empty(1), np.empty(1, np.int64), np.empty(1, np.int64), np.empty(1, np.int8)
    one = Ends(ends[:1], *numbers)
    shots = velocities[np.newaxis], layout[np.newaxis]
    room = (one, ends[1], np.empty(0, EVENT))
    _, _, complete = play_some(state, start, shots, (0, 0), limits, room)
    return int(one.failed[0]), float(one.durations[0]), complete
