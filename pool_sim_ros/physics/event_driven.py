"""The exact integrator: from event to event, each found in closed form."""

from __future__ import annotations

import numpy as np

from pool_sim_ros.physics.cluster import new_cluster
from pool_sim_ros.physics.collision import (
    gather_crowd,
    hit_ball,
    hit_crowd,
    hit_cushion,
    log_motion,
    stands_alone,
)
from pool_sim_ros.physics.kernel import kernel
from pool_sim_ros.physics.motion import STOP, position_at, set_velocity, speed_at
from pool_sim_ros.physics.prediction import earliest, offer_resting, predict_after, predict_all
from pool_sim_ros.physics.record import STOPPED, enlarged, has_room, log_event, new_log
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.trajectory import Trajectory

FIRST_ROOM = 64
"""Events that a log holds before it is first enlarged; most shots have fewer."""


def play(table: Table, at_rest: np.ndarray, velocities: np.ndarray, until: float) -> Trajectory:
    """Play one shot; see `simulate`, which checks what it is given."""
    balls = at_rest.copy()
    n = len(balls)
    log = new_log(FIRST_ROOM, FIRST_ROOM + n)
    cluster = new_cluster(n)
    start(balls, table.world, velocities, cluster.members, log)
    while not run(balls, table.world, until, cluster, log):
        log = enlarged(log)
    ends = np.empty((2, n, 2))
    duration, complete = finish(balls, table.world, until, ends[0], ends[1])
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
    finals: np.ndarray,
    durations: np.ndarray,
    counts: np.ndarray,
) -> None:
    """Play shots and fill in their ends; see `simulate_many`."""
    log = new_log(0, 0, wanted=False)
    cluster = new_cluster(len(at_rest))
    run_many(at_rest, table.world, velocities, until, cluster, log, finals, durations, counts)


@kernel
def run_many(at_rest, world, velocities, until, cluster, log, finals, durations, counts):
    """Play shots one after another from the same layout."""
    balls = at_rest.copy()
    unused = np.empty((len(balls), 2))
    for shot in range(len(velocities)):
        balls[:] = at_rest
        log.counts[0] = 0
        start(balls, world, velocities[shot], cluster.members, log)
        run(balls, world, until, cluster, log)
        durations[shot], _ = finish(balls, world, until, finals[shot], unused)
        counts[shot] = log.counts[0]


@kernel
def start(balls, world, velocities, everyone, log):
    """Give the first balls their velocities, (n or 1, 2) in m/s, and find all next events.

    `everyone` is room for the numbers of all balls.
    """
    for i in range(len(velocities)):
        set_velocity(balls[i], velocities[i, 0], velocities[i, 1])
    for i in range(len(balls)):
        log_motion(balls, i, 0.0, log)
    predict_all(balls, world, everyone, 0.0)


@kernel
def run(balls, world, until, cluster, log):
    """Play all events up to `until`; return False where the log must be enlarged first."""
    changed = cluster.members
    while True:
        a = earliest(balls)
        now = balls[a].next
        if not now <= until or now == np.inf:
            return True
        b = balls[a].partner
        if b == STOP:
            if not has_room(log, 1, 1):
                return False
            stop(balls, world, a, now, log)
            continue
        contacts, members = 1, 2 if b >= 0 else 1
        if not stands_alone(balls, world, a, b, now):
            contacts, members = gather_crowd(balls, world, cluster, a, b, now)
        if not has_room(log, contacts, members):
            return False
        if contacts > 1:
            hit_crowd(balls, world, cluster, contacts, members, now, log)
        elif b >= 0:
            hit_ball(balls, world, a, b, now, log)
            changed[0], changed[1] = a, b
        else:
            hit_cushion(balls, world, a, b, now, log)
            changed[0] = a
        predict_after(balls, world, changed, members, now)


@kernel
def stop(balls, world, a, now, log):
    """Bring a ball to rest where its motion ends."""
    ball = balls[a]
    way = 0.5 * ball.speed * ball.speed / world.deceleration
    ball.x += ball.ux * way
    ball.y += ball.uy * way
    ball.ux, ball.uy, ball.speed = 0.0, 0.0, 0.0
    ball.since = now
    ball.next = np.inf
    log_event(log, now, STOPPED, a, -1, ball.x, ball.y, 0.0, 0.0, 0.0)
    log_motion(balls, a, now, log)
    offer_resting(balls, world, a, now)


@kernel
def finish(balls, world, until, positions, velocities):
    """Fill in the state at the end, (n, 2) each; return the duration and whether all balls rest."""
    duration, complete = 0.0, True
    for i in range(len(balls)):
        ball = balls[i]
        if ball.speed > 0.0:
            complete = False
            positions[i, 0], positions[i, 1] = position_at(ball, until, world.deceleration)
            speed = speed_at(ball, until, world.deceleration)
            velocities[i, 0], velocities[i, 1] = ball.ux * speed, ball.uy * speed
        else:
            duration = max(duration, ball.since)
            positions[i, 0], positions[i, 1] = ball.x, ball.y
            velocities[i, 0], velocities[i, 1] = 0.0, 0.0
    return (duration if complete else until), complete
