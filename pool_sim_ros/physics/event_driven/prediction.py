"""What happens next: every moving ball keeps its own next event, and there is no table of pairs.

When a ball's motion changes, its next event is found anew, and each ball that it will now meet
before anything else is told. A ball that was about to meet it learns of the change when that
contact falls due: nothing can have come before.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import PHASE_END
from pool_sim_ros.physics.contact_time import time_to_moving_ball
from pool_sim_ros.physics.event_driven.cell_grid import (
    all_moving,
    cell_edges,
    has_few,
    move_on,
    neighbours,
)
from pool_sim_ros.physics.event_driven.event_queue import reschedule
from pool_sim_ros.physics.event_driven.few_balls import DISTANCE, n_moving, note_motion
from pool_sim_ros.physics.event_driven.state import State
from pool_sim_ros.physics.jit import NONE, inlined, kernel
from pool_sim_ros.physics.motion import (
    RESTS,
    first_resting_ball,
    first_resting_of,
    keep_path,
    path_from,
    phase_end_time,
    relative_motion,
    sift,
    time_to_boundary,
    time_to_cell_edge,
    time_to_resting_ball,
)
from pool_sim_ros.physics.tolerances import SIFTED


@inlined
def predict_after(state: State, count: int, now: float) -> None:
    """Find the next events of the `count` balls in the group, whose motion is new at `now`."""
    balls, changed = state.balls, state.group.members
    for m in range(count):
        balls[changed[m]].next_contact_time = np.inf
        note_change(state, changed[m])
    for m in range(count):
        if balls[changed[m]].phase != RESTS:
            predict(state, changed[m], m, now)
        else:
            lay_down(state, changed[m], now)


@inlined
def note_change(state: State, i: int) -> None:
    """Note that ball `i` has a new motion, or rests."""
    few, ball = state.grid.few, state.balls[i]
    note_motion(few, state.balls, i)
    if has_few(state.grid):
        keep_path(ball, state.table, few.rows, i)


@kernel
def predict(state: State, i: int, n_done: int, now: float) -> None:
    """Find the next event of moving ball `i`, and tell those that it meets before theirs.

    The first `n_done` balls of the group have looked at their pair with this one already.
    """
    table, ball = state.table, state.balls[i]
    path = path_from(ball, table, now)
    seconds, partner = time_to_boundary(path, table, ball)
    t = max(phase_end_time(ball, table), now)
    if partner != PHASE_END:
        t = min(now + seconds, t)
    if t < ball.next_contact_time:
        ball.next_contact_time = t
        ball.partner = partner
    count = neighbours(state.balls, state.grid, i)
    meet(state, i, path, count, n_done, now)
    plan(state, i, path, now)


@kernel
def cross(state: State, i: int, now: float) -> None:
    """Let ball `i` go on into the next cell, and look at what is new there."""
    balls, grid = state.balls, state.grid
    path = path_from(balls[i], state.table, now)
    _, step_x, step_y = time_to_cell_edge(path, state.table, *cell_edges(grid, balls[i]))
    count = move_on(balls, grid, i, step_x, step_y)
    meet(state, i, path, count, NONE, now)
    plan(state, i, path, now)


@inlined
def plan(state: State, i: int, path: Any, now: float) -> None:
    """Find when ball `i` leaves its cell, and put down what is first."""
    ball = state.balls[i]
    ball.cell_exit_time = np.inf
    if not has_few(state.grid):
        edges = cell_edges(state.grid, ball)
        seconds, _, _ = time_to_cell_edge(path, state.table, *edges)
        ball.cell_exit_time = now + seconds
    reschedule(state.queue, i, min(ball.next_contact_time, ball.cell_exit_time))


@inlined
def meet(state: State, i: int, path: Any, count: int, n_done: int, now: float) -> None:
    """Let ball `i` meet the first of the `count` balls that are near."""
    table, balls, grid = state.table, state.balls, state.grid
    ball = balls[i]
    lasts = ball.next_contact_time - now
    if has_few(grid):
        seconds, partner = first_resting_ball(path, table, ball.radius, lasts, grid.few.rows)
        n_others = n_moving(grid.few)
    else:
        n_resting, n_others = sort_out(state, count, i)
        seconds, partner = first_resting_of(
            path, table, ball.radius, lasts, balls, grid.near, n_resting
        )
    if partner >= 0:
        book(balls, i, partner, now + seconds)
    sifted = has_few(grid) and n_others >= SIFTED
    if sifted:
        times = now, ball.next_contact_time - now
        sifted = sift(path, table, ball.radius, times, grid.few.rows)
    for m in range(n_others):
        j = grid.few.moving[m]
        if sifted and grid.few.rows[DISTANCE, j] == 0.0:
            continue
        if j != i and not is_among(j, state.group.members, n_done):
            meet_moving(state, i, j, path, now)


@inlined
def sort_out(state: State, count: int, i: int) -> tuple[int, int]:
    """Divide the `count` balls that are near into those that rest, in `near`, and those that move.

    Ball `i`, which moves, is left out. Returns how many rest and how many move. No branches: they
    would be guessed wrong.
    """
    balls, grid = state.balls, state.grid
    n_resting = n_moves = 0
    for m in range(count):
        j = grid.near[m]
        moves = balls[j].phase != RESTS
        grid.near[n_resting] = j
        grid.few.moving[n_moves] = j
        n_resting += not moves
        n_moves += moves & (j != i)
    return n_resting, n_moves


@inlined
def is_among(j: int, some: NDArray[np.int64], count: int) -> bool:
    """Return whether ball `j` is one of the first `count` of `some`."""
    for m in range(count):
        if some[m] == j:
            return True
    return False


@inlined
def book(balls: NDArray[np.void], i: int, j: int, t: float) -> bool:
    """Let ball `i` meet ball `j` at `t`, if it has nothing before; return whether it does."""
    ball = balls[i]
    if t < ball.next_contact_time:
        ball.next_contact_time = t
        ball.partner = j
        ball.partner_changes = balls[j].changes
        return True
    return False


@inlined
def meet_moving(state: State, i: int, j: int, path: Any, now: float) -> None:
    """Let balls `i` and `j`, both moving, meet if that comes before what either has next."""
    table = state.table
    ball, other = state.balls[i], state.balls[j]
    ends = min(phase_end_time(ball, table), phase_end_time(other, table))
    t = now + time_to_moving_ball(
        relative_motion(path, table, path_from(other, table, now)),
        ball.radius + other.radius,
        min(ball.next_contact_time, other.next_contact_time, ends) - now,
    )
    if t < other.next_contact_time and book(state.balls, i, j, t):
        book(state.balls, j, i, t)
        reschedule(state.queue, j, min(t, other.cell_exit_time))


@inlined
def take_out(state: State, j: int) -> None:
    """Take ball `j`, which moves no more, out of the queue."""
    other = state.balls[j]
    other.next_contact_time = other.cell_exit_time = np.inf
    note_motion(state.grid.few, state.balls, j)
    reschedule(state.queue, j, np.inf)


@inlined
def lay_down(state: State, j: int, now: float) -> None:
    """Take ball `j`, which has come to rest, out of the queue; tell the moving balls near it."""
    table, balls, grid = state.table, state.balls, state.grid
    other = balls[j]
    take_out(state, j)
    others, count = all_moving(balls, grid, j)
    sifted = has_few(grid) and count >= SIFTED
    if sifted:
        here = path_from(other, table, now)
        sifted = sift(here, table, other.radius, (now, np.inf), grid.few.rows)
    for m in range(count):
        i = others[m]
        ball = balls[i]
        if ball.phase == RESTS or (sifted and grid.few.rows[DISTANCE, i] == 0.0):
            continue
        path = path_from(ball, table, now)
        touch = ball.radius + other.radius
        seconds = time_to_resting_ball(path, table, other.x - path.x, other.y - path.y, touch)
        if seconds < np.inf and book(balls, i, j, now + seconds):
            reschedule(state.queue, i, min(ball.next_contact_time, ball.cell_exit_time))
