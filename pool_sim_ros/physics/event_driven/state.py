"""Everything that the kernels of the engine work on, in one named tuple."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import cushion_gap, distance_to_mouths, n_cushions
from pool_sim_ros.physics.event_driven.cell_grid import CellGrid, fill, has_few, new_grid
from pool_sim_ros.physics.event_driven.contact_group import ContactGroup, new_group
from pool_sim_ros.physics.event_driven.event_queue import first, new_queue
from pool_sim_ros.physics.event_driven.few_balls import note_motion
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.log import Log, clear


class State(NamedTuple):
    """A shot that is being played."""

    table: Any  # what the kernels know of the table; its type chooses the motion
    balls: NDArray[np.void]  # (n,) of the motion's record
    grid: CellGrid
    queue: NDArray[np.void]  # see `event_queue`
    group: ContactGroup
    log: Log


class Start(NamedTuple):
    """What a state is put back to before each shot."""

    balls: NDArray[np.void]
    first: NDArray[np.int32]  # of the grid
    following: NDArray[np.int32]
    queue: NDArray[np.void]
    clearance_squared: float  # m^2; balls that are all moved by less may lie there


def new_state(table: Any, at_rest: NDArray[np.void], log: Log) -> State:
    """Return a state in which all balls rest where `at_rest`, (n,), has them."""
    balls = copied(at_rest)
    n = len(balls)
    grid = new_grid(table.boundary.length, table.boundary.width, balls)
    fill(balls, grid)
    return State(table, balls, grid, new_queue(n), new_group(n), log)


def types_of(state: State) -> tuple[type, ...]:
    """Return the types that decide which code is compiled for a state."""
    return type(state.table), type(state.table.boundary)


def start_of(state: State) -> Start:
    """Return what `reset` needs to bring a state back to where it is now, at rest."""
    balls, grid = copied(state.balls), state.grid
    room = max(clearance(balls, state.table.boundary), 0.0) if has_few(grid) else 0.0
    return Start(balls, grid.first.copy(), grid.following.copy(), state.queue.copy(), room * room)


@kernel
def clearance(balls: NDArray[np.void], boundary: Any) -> float:
    """Return by how much all balls may be moved from where they rest, each anywhere, m."""
    least = np.inf
    for i in range(len(balls)):
        one = balls[i]
        if one.x == np.inf:  # in a pocket
            continue
        least = min(least, distance_to_mouths(boundary, one.x, one.y))
        for cushion in range(n_cushions(boundary)):
            least = min(least, cushion_gap(boundary, cushion, one.x, one.y, one.radius))
        for k in range(i):
            other = balls[k]
            if other.x == np.inf:
                continue
            dx, dy = other.x - one.x, other.y - one.y
            gap = np.sqrt(dx * dx + dy * dy) - one.radius - other.radius
            least = min(least, 0.5 * gap)
    return least


def copied(records: NDArray[np.void]) -> NDArray[np.void]:
    """Return a copy of records, byte by byte: numpy goes field by field, which takes longer."""
    return records.view(f'V{records.itemsize}').copy().view(records.dtype)


@inlined
def reset(state: State, start: Start, whole: bool) -> None:
    """Put everything back to the start.

    Balls that have not moved since the last reset stay as they are, unless `whole`.
    """
    balls, grid, queue = state.balls, state.grid, state.queue
    few = has_few(grid)
    clear(state.log)
    for i in range(len(balls)):
        if whole or balls[i].changes > 0 or not few:
            balls[i] = start.balls[i]
            note_motion(grid.few, balls, i)
    if first(queue)[0] < np.inf:  # else nothing is due any more
        for k in range(len(queue)):
            queue[k] = start.queue[k]
    if few:
        return
    for i in range(len(balls)):
        grid.following[i] = start.following[i]
    rows, columns = grid.first.shape
    for row in range(rows):
        for column in range(columns):
            grid.first[row, column] = start.first[row, column]
