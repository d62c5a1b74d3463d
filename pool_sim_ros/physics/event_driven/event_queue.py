"""Which ball is next: a tournament over the balls' next events.

Node k's children are 2 k and 2 k + 1; of n balls, ball i is node n + i, and node 1 is the winner.
"""

import numpy as np

from pool_sim_ros.physics.jit import inlined

NODE = np.dtype([('t', 'f8'), ('ball', 'i8')])
"""The earlier of two events: when, in s, and whose."""


def new_schedule(n: int) -> np.ndarray:
    """Return a schedule of `n` balls, (2 n,) of NODE, in which nothing is due."""
    schedule = np.zeros(2 * n, NODE)
    schedule['t'] = np.inf
    schedule['ball'][n:] = np.arange(n)
    return schedule


@inlined
def put_down(schedule, i, t):
    """Note that ball `i` is next due at `t`, s."""
    node = len(schedule) // 2 + i
    schedule[node].t = t
    while node > 1:
        left = node & ~1
        # Of two at one time the left one. No branch: it would be guessed wrong half the time.
        winner = left + (schedule[left + 1].t < schedule[left].t)
        node >>= 1
        t, ball = schedule[winner].t, schedule[winner].ball
        if schedule[node].t == t and schedule[node].ball == ball:
            break
        schedule[node].t = t
        schedule[node].ball = ball
