"""Trajectories made by hand, of any motion."""

import numpy as np
from tables import table_of

from pool_sim_ros.physics import Trajectory
from pool_sim_ros.physics.log import EVENT, SEGMENT


def by_hand(segments, duration, n=1, complete=True):
    """Return a trajectory of segments (ball, t, x, y, vx, vy, ax, ay)."""
    table = table_of([(0.5 + 0.2 * k, 0.5) for k in range(n)])
    records = np.array(segments, SEGMENT)
    last = [records[records['ball'] == ball][-1] for ball in range(n)]
    ends = [
        [one[p] + (duration - one['t']) * (one[v] + 0.5 * (duration - one['t']) * one[a])]
        for one in last
        for p, v, a in (('x', 'vx', 'ax'), ('y', 'vy', 'ay'))
    ]
    finals = np.reshape(ends, (n, 2))
    events = np.empty(0, EVENT)
    return Trajectory(table, finals, np.zeros((n, 2)), duration, events, records, complete)
