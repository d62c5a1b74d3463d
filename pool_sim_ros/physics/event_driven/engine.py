"""The exact integrator: from event to event, each found in closed form."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pool_sim_ros.physics.event_driven.cell_grid import Cells, fill, has_few, new_cells
from pool_sim_ros.physics.event_driven.contact_group import new_cluster
from pool_sim_ros.physics.event_driven.event_queue import new_schedule
from pool_sim_ros.physics.event_driven.false_sharing import own_lines
from pool_sim_ros.physics.event_driven.few_balls import note_motion
from pool_sim_ros.physics.event_driven.prediction import (
    cross,
    lay_down,
    predict,
    predict_after,
)
from pool_sim_ros.physics.event_driven.resolve import (
    gather_crowd,
    hit_ball,
    hit_crowd,
    hit_cushion,
    log_motion,
    stands_alone,
)
from pool_sim_ros.physics.jit import NONE, inlined, kernel
from pool_sim_ros.physics.motion.disc import STOP, copied, position_at, set_velocity, speed_at
from pool_sim_ros.physics.runaway import most_energy, runs_away
from pool_sim_ros.physics.state import STOPPED, enlarged, has_room, log_event, new_log
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.trajectory import Trajectory

FIRST_ROOM = 64
"""Events beyond one a ball that a log holds before it is enlarged; most shots have fewer."""


def play(table: Table, at_rest: np.ndarray, velocities: np.ndarray, until: float) -> Trajectory:
    """Play one shot; see `simulate`, which checks what it is given."""
    balls, cells = laid_out(table, at_rest)
    n = len(balls)
    schedule = new_schedule(n)
    log = new_log(FIRST_ROOM + n, FIRST_ROOM + 2 * n)
    cluster = new_cluster(n)
    most = start(balls, table.world, cells, schedule, velocities, log)
    while not run(balls, table.world, cells, schedule, cluster, until, most, log):
        log = enlarged(log)
    ends = np.empty((2, n, 2))
    duration, complete = finish(balls, table.world, until, most, ends[0], ends[1])
    events, segments = log.counts
    return Trajectory(
        table,
        ends[0],
        ends[1],
        duration,
        log.events[:events],
        log.segments[:segments],
        complete,
    )


def play_many(
    table: Table,
    at_rest: np.ndarray,
    velocities: np.ndarray,
    until: float,
    ends: tuple[np.ndarray, np.ndarray, np.ndarray],
    parts: Iterator[slice],
    alone: bool,
) -> None:
    """Play shots and fill in their ends; see `simulate_many`.

    Those in `parts`, of which other threads take theirs too unless this one is `alone`.
    """
    balls, cells = laid_out(table, at_rest)
    n = len(balls)
    start_layout = copied(balls), cells.first.copy(), cells.after.copy(), new_schedule(n)
    work = balls, cells, new_schedule(n), new_cluster(n)
    log = new_log(0, 0, wanted=False)
    if not alone:
        work, log = own_lines(work), own_lines(log)
    finals, durations, counts = ends
    velocity = np.empty((n, 2))
    for part in parts:
        ends_of_part = finals[part], velocity, durations[part], counts[part]
        run_many(start_layout, work, table.world, velocities[part], until, log, ends_of_part)


def laid_out(table: Table, at_rest: np.ndarray) -> tuple[np.ndarray, Cells]:
    """Return a copy of the balls, and the cells in which they lie."""
    balls = copied(at_rest)
    cells = new_cells(table.length, table.width, balls)
    fill(balls, cells)
    return balls, cells


@kernel
def run_many(start_layout, work, world, velocities, until, log, ends):
    """Play shots one after another from the same layout."""
    balls, cells, schedule, cluster = work
    finals, final_velocities, durations, counts = ends
    for shot in range(len(velocities)):
        lay_out(start_layout, balls, cells, schedule)
        log.counts[0] = 0
        most = start(balls, world, cells, schedule, velocities[shot], log)
        run(balls, world, cells, schedule, cluster, until, most, log)
        durations[shot], _ = finish(balls, world, until, most, finals[shot], final_velocities)
        counts[shot] = log.counts[0]


@inlined
def lay_out(start_layout, balls, cells, schedule):
    """Put everything back to the start."""
    balls_at_start, first_at_start, after_at_start, nothing_due = start_layout
    for i in range(len(balls)):
        balls[i] = balls_at_start[i]
        note_motion(cells.resting, balls, i)
    for k in range(len(schedule)):
        schedule[k] = nothing_due[k]
    if has_few(cells):
        return
    for i in range(len(balls)):
        cells.after[i] = after_at_start[i]
    rows, columns = cells.first.shape
    for row in range(rows):
        for column in range(columns):
            cells.first[row, column] = first_at_start[row, column]


@inlined
def start(balls, world, cells, schedule, velocities, log):
    """Give the first balls their velocities, (n or 1, 2) in m/s, and find all next events.

    Returns `most_energy`.
    """
    for i in range(len(velocities)):
        set_velocity(balls[i], velocities[i, 0], velocities[i, 1])
        note_motion(cells.resting, balls, i)
    for i in range(len(balls)):
        log_motion(balls, i, 0.0, log)
        if balls[i].speed > 0.0:
            predict(balls, world, cells, schedule, cells.near, NONE, i, 0.0)
    return most_energy(balls, world, velocities)


@inlined
def run(balls, world, cells, schedule, cluster, until, most, log):
    """Play all events up to `until`, or until a ball runs away with more than `most`.

    Returns False where the log must be enlarged first.
    """
    while True:
        now, a = schedule[1].t, schedule[1].ball
        if not now <= until or now == np.inf:
            return True
        ball = balls[a]
        if runs_away(ball.speed, ball.inverse_mass, most):
            return True
        b = np.int64(ball.partner)
        if ball.crossing < ball.contact:
            cross(balls, world, cells, schedule, a, now)
        elif b >= 0 and balls[b].changes != ball.partner_changes:
            ball.contact = np.inf
            predict(balls, world, cells, schedule, cells.near, NONE, a, now)
        elif not has_room(log, 1, 2):
            return False
        elif b == STOP:
            stop(balls, world, cells, schedule, a, now, log)
        elif not collide(balls, world, cells, schedule, cluster, a, b, now, log):
            return False


@inlined
def collide(balls, world, cells, schedule, cluster, a, b, now, log):
    """Resolve the contact of ball `a` with `b` that is due; return False where the log is full."""
    changed = cluster.members
    if not stands_alone(balls, world, cells, a, b, now):
        contacts, members = gather_crowd(balls, world, cells, cluster, a, b, now)
        if not has_room(log, contacts, members):
            return False
        hit_crowd(balls, world, cluster, contacts, members, now, log)
    elif b >= 0:
        hit_ball(balls, world, a, b, now, log)
        changed[0], changed[1], members = a, b, 2
    else:
        hit_cushion(balls, world, a, b, now, log)
        changed[0], members = a, 1
    predict_after(balls, world, cells, schedule, changed, members, now)
    return True


@inlined
def stop(balls, world, cells, schedule, a, now, log):
    """Bring a ball to rest where its motion ends."""
    ball = balls[a]
    way = 0.5 * ball.speed * ball.speed / world.deceleration
    ball.x += ball.ux * way
    ball.y += ball.uy * way
    ball.since = now
    set_velocity(ball, 0.0, 0.0)
    log_event(log, now, STOPPED, a, -1, ball.x, ball.y, 0.0, 0.0, 0.0)
    log_motion(balls, a, now, log)
    lay_down(balls, world, cells, schedule, a, now)


@inlined
def finish(balls, world, until, most, positions, velocities):
    """Fill in the state at the end, (n, 2) each; return the duration and whether all balls rest.

    The duration is NaN where a ball has run away.
    """
    duration, complete, lost = 0.0, True, False
    for i in range(len(balls)):
        ball = balls[i]
        if ball.speed > 0.0:
            complete = False
            lost |= runs_away(ball.speed, ball.inverse_mass, most)
            positions[i, 0], positions[i, 1] = position_at(ball, until, world.deceleration)
            speed = speed_at(ball, until, world.deceleration)
            velocities[i, 0], velocities[i, 1] = ball.ux * speed, ball.uy * speed
        else:
            duration = max(duration, ball.since)
            positions[i, 0], positions[i, 1] = ball.x, ball.y
            velocities[i, 0], velocities[i, 1] = 0.0, 0.0
    if lost:
        return np.nan, False
    return (duration if complete else until), complete
