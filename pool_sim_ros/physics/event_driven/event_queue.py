"""Which ball is next: a tournament over the balls' next events.

Node k's children are 2 k and 2 k + 1; of n balls, ball i is node n + i, and node 1 is the winner.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.jit import inlined

NODE = np.dtype([('t', 'f8'), ('ball', 'i8')])
"""The earlier of two events: when, in s, and whose."""


def new_queue(n: int) -> NDArray[np.void]:
    """Return the queue of `n` balls, (2 n,) of NODE, in which nothing is due."""
    queue = np.zeros(2 * n, NODE)
    queue['t'] = np.inf
    queue['ball'][n:] = np.arange(n)
    return queue


@inlined
def first(queue: NDArray[np.void]) -> tuple[float, int]:
    """Return when the next event is due, in s, and whose it is."""
    return queue[1].t, queue[1].ball


@inlined
def reschedule(queue: NDArray[np.void], i: int, t: float) -> None:
    """Note that ball `i` is next due at `t`, s."""
    node = len(queue) // 2 + i
    queue[node].t = t
    while node > 1:
        left = node & ~1
        # Of two at one time the left one. No branch: it would be guessed wrong half the time.
        winner = left + (queue[left + 1].t < queue[left].t)
        node >>= 1
        t, ball = queue[winner].t, queue[winner].ball
        if queue[node].t == t and queue[node].ball == ball:
            break
        queue[node].t = t
        queue[node].ball = ball
