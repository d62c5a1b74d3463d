"""What may be seen and done, as gymnasium's spaces."""

from __future__ import annotations

from typing import cast

import numpy as np
from gymnasium.spaces import Box, Space
from numpy.typing import NDArray

from pool_sim_ros.study.tasks import Task


def observation_space(task: Task) -> Space[NDArray[np.float64]]:
    """Return the space of positions and goals, in m.

    A ball may lie anywhere between the cushions and in the mouths of pockets, and is at the centre
    of a pocket once it is caught there.
    """
    table = task.table
    low, high = np.zeros(2), np.array([table.length, table.width])
    if len(table.pockets):
        centres, radii = table.pockets[:, :2], table.pockets[:, 2:]
        low = np.minimum(low, (centres - radii).min(axis=0))
        high = np.maximum(high, (centres + radii).max(axis=0))
    least, most = task.goal_limits()
    n = len(table.balls)
    low, high = np.append(np.tile(low, n), least), np.append(np.tile(high, n), most)
    return cast('Space[NDArray[np.float64]]', Box(low, high, dtype=np.float64))


def action_space(task: Task) -> Space[NDArray[np.float64]]:
    """Return the space of strikes: each number -1 to 1."""
    space = Box(-1.0, 1.0, (task.strikes.count,), np.float64)
    return cast('Space[NDArray[np.float64]]', space)
