"""The exact integrator: from event to event, each found in closed form.

Every moving ball keeps its own next event; there is no table of pairs. When a ball's motion
changes, its next event is found anew, and that of every ball that was about to meet it.
"""

import numpy as np

from pool_sim_ros.physics.cluster import gather, move_as_one, new_cluster, resolve
from pool_sim_ros.physics.contact import collide_balls, collide_cushion, restitution
from pool_sim_ros.physics.contact_time import (
    time_to_cover,
    time_to_moving_ball,
    way_to_resting_ball,
)
from pool_sim_ros.physics.kernel import kernel
from pool_sim_ros.physics.motion import (
    CUSHION_X0,
    CUSHION_X1,
    CUSHION_Y0,
    CUSHION_Y1,
    STOP,
    position_at,
    set_velocity,
    speed_at,
    stop_time,
)
from pool_sim_ros.physics.record import (
    BALL_BALL,
    CUSHION,
    STOPPED,
    enlarged,
    has_room,
    log_event,
    log_segment,
    new_log,
)
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.trajectory import Trajectory

V_MIN = 1e-4
"""Contacts that close slower, in m/s, are weak: they take no part in another's instant, and may
belong to a collapse, bouncing ever faster."""

V_ROUNDING = 1e-11
"""Speed in m/s at which a weak contact parts at the least, so that rounding cannot close it."""

COLLAPSE_GROWTH = 4.0
"""What that speed is multiplied by at each repeat, up to V_MIN: this ends a collapse."""

REPEAT_WINDOW = 1e-3
"""Time in s within which a weak contact repeats an earlier one."""

FIRST_ROOM = 64
"""Events that a log holds before it is first enlarged; most shots have fewer."""

MAX_ROUNDS = 200
"""Contacts of one ball at one instant after which its cluster is pulled apart at V_MIN."""

LAST_ROUND = 250
"""The same, after which the cluster moves as one: it is wedged and cannot part."""


@kernel
def start(balls, world, log):
    """Set up the first motions and events of balls whose places and velocities are given."""
    for i in range(len(balls)):
        ball = balls[i]
        ball.next = np.inf
        log_segment(log, i, 0.0, ball.x, ball.y, ball.ux, ball.uy, ball.speed)
    for i in range(len(balls)):
        if balls[i].speed > 0.0:
            predict(balls, world, i, 0.0)


@kernel
def run(balls, world, until, cluster, log):
    """Play all events up to `until`; return False where the log must be enlarged first."""
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
        count, members = touching(balls, world, cluster, a, b, now)
        if not has_room(log, count, members):
            return False
        collide(balls, world, cluster, count, members, now)
        log_contacts(balls, cluster, count, now, log)
        for m in range(members):
            log_motion(balls, cluster.members[m], now, log)
        predict_after(balls, world, cluster, members, now)


@kernel
def earliest(balls):
    """Return the ball whose next event is due first."""
    first, t = 0, balls[0].next
    for i in range(1, len(balls)):
        if balls[i].next < t:
            first, t = i, balls[i].next
    return first


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
    for i in range(len(balls)):
        if balls[i].speed > 0.0:
            aim_at_resting(balls, world, i, a, now)


@kernel
def touching(balls, world, cluster, a, b, now):
    """Collect the contacts that are to be resolved together; return their and the balls' number."""
    if rounds_at(balls, a, b, now) > MAX_ROUNDS:
        return gather(balls, world, cluster, a, b, now, -np.inf)
    count, members = gather(balls, world, cluster, a, b, now, V_MIN)
    if count > 1 and weakest(cluster, count) <= V_MIN:
        return gather(balls, world, cluster, a, b, now, 0.0)
    return count, members


@kernel
def rounds_at(balls, a, b, now):
    """Return how many contacts at this very instant the more stricken of two balls has had."""
    rounds = balls[a].rounds if balls[a].touched == now else 0
    if b >= 0 and balls[b].touched == now:
        rounds = max(rounds, balls[b].rounds)
    return rounds


@kernel
def weakest(cluster, count):
    """Return the smallest closing speed in the cluster, m/s."""
    slowest = np.inf
    for c in range(count):
        slowest = min(slowest, cluster.contacts[c].closing)
    return slowest


@kernel
def collide(balls, world, cluster, count, members, now):
    """Resolve the contacts and set the balls off with their new velocities."""
    rounds = 0
    for c in range(count):
        contact = cluster.contacts[c]
        rounds = max(rounds, rounds_at(balls, contact.a, contact.b, now))
        contact.separation = separation_speed(balls, world, contact, now)
    if rounds > LAST_ROUND:
        move_as_one(balls, cluster, count, members)
    elif count == 1:
        collide_alone(balls, world, cluster)
    else:
        if rounds > MAX_ROUNDS:
            for c in range(count):
                contact = cluster.contacts[c]
                contact.separation = V_MIN if contact.closing > 0.0 else 0.0
        resolve(balls, world, cluster, count, members)
    for m in range(members):
        ball = balls[cluster.members[m]]
        ball.x, ball.y = position_at(ball, now, world.deceleration)
        ball.since = now
        ball.rounds = ball.rounds + 1 if ball.touched == now else 1
        ball.touched = now
        set_velocity(ball, cluster.vx[cluster.members[m]], cluster.vy[cluster.members[m]])


@kernel
def separation_speed(balls, world, contact, now):
    """Return the speed in m/s at which the two sides of a contact are to part.

    Restitution times the closing speed; but balls that meet weakly, and again within a moment,
    part a little faster each time, up to V_MIN. This ends the infinitely many bounces in finite
    time (inelastic collapse) that decelerating balls can fall into.
    """
    closing = max(contact.closing, 0.0)
    if contact.b < 0:
        return world.e_ball_cushion * closing
    a, b = balls[contact.a], balls[contact.b]
    parting = restitution(world, a.is_cue, b.is_cue) * closing
    if closing > V_MIN:
        return parting
    repeated = now - max(a.touched, b.touched) < REPEAT_WINDOW
    repeats = max(a.repeats, b.repeats) + 1 if repeated else 0
    a.repeats = repeats
    b.repeats = repeats
    return max(parting, min(V_MIN, V_ROUNDING * COLLAPSE_GROWTH ** min(repeats, 20)))


@kernel
def collide_alone(balls, world, cluster):
    """Resolve a single contact in closed form."""
    contact = cluster.contacts[0]
    a, b = contact.a, contact.b
    va = (cluster.vx[a], cluster.vy[a])
    if b >= 0:
        vb = (cluster.vx[b], cluster.vy[b])
        normal = (contact.nx, contact.ny)
        va, vb = collide_balls(
            world, va, vb, normal, balls[a].mass, balls[b].mass, contact.separation
        )
        cluster.vx[a], cluster.vy[a] = va
        cluster.vx[b], cluster.vy[b] = vb
    elif b >= CUSHION_X1:
        cluster.vx[a], cluster.vy[a] = collide_cushion(world, va[0], va[1])
    else:
        cluster.vy[a], cluster.vx[a] = collide_cushion(world, va[1], va[0])


@kernel
def log_contacts(balls, cluster, count, now, log):
    """Write the contacts of an instant down."""
    for c in range(count):
        contact = cluster.contacts[c]
        a, b, nx, ny = contact.a, contact.b, contact.nx, contact.ny
        kind = BALL_BALL
        if b < 0:
            kind, b = CUSHION, CUSHION_X0 - b
        ball = balls[a]
        x, y = ball.x + nx * ball.radius, ball.y + ny * ball.radius
        log_event(log, now, kind, a, b, x, y, nx, ny, contact.closing)


@kernel
def log_motion(balls, i, now, log):
    """Write down how ball `i` moves from now on."""
    ball = balls[i]
    log_segment(log, i, now, ball.x, ball.y, ball.ux, ball.uy, ball.speed)


@kernel
def predict_after(balls, world, cluster, members, now):
    """Find anew the next events of the balls in a collision and of those that were to meet them."""
    for m in range(members):
        cluster.is_member[cluster.members[m]] = True
    stale = members
    for i in range(len(balls)):
        partner = balls[i].partner
        bereft = partner >= 0 and balls[i].next < np.inf and cluster.is_member[partner]
        if bereft and not cluster.is_member[i]:
            cluster.members[stale] = i
            stale += 1
    for m in range(members):
        cluster.is_member[cluster.members[m]] = False
    for m in range(stale):
        balls[cluster.members[m]].next = np.inf
    for m in range(stale):
        if balls[cluster.members[m]].speed > 0.0:
            predict(balls, world, cluster.members[m], now)


@kernel
def predict(balls, world, i, now):
    """Find the next event of moving ball `i`, and tell those that it will meet before theirs.

    What rests is compared by the way to it, so that only one time has to be computed.
    """
    ball = balls[i]
    a = world.deceleration
    x, y = position_at(ball, now, a)
    ux, uy = ball.ux, ball.uy
    speed = speed_at(ball, now, a)
    way, partner = way_to_cushions(world, x, y, ux, uy, ball.radius)
    for j in range(len(balls)):
        other = balls[j]
        if other.speed == 0.0 and j != i:
            touch = ball.radius + other.radius
            to_ball = way_to_resting_ball(other.x - x, other.y - y, ux, uy, touch, way)
            if to_ball < way:
                way, partner = to_ball, j
    stopping = max(stop_time(ball, a), now)
    if 2.0 * a * way < speed * speed:
        ball.next = min(now + time_to_cover(way, speed, a), stopping)
        ball.partner = partner
    else:
        ball.next = stopping
        ball.partner = STOP
    for j in range(len(balls)):
        if balls[j].speed > 0.0 and j != i:
            aim_at_moving(balls, world, i, j, x, y, speed, now, stopping)


@kernel
def way_to_cushions(world, x, y, ux, uy, radius):
    """Return the way in m along (ux, uy) to the first cushion, and which that is."""
    way, partner = np.inf, STOP
    if ux > 0.0:
        way, partner = (world.length - radius - x) / ux, CUSHION_X1
    elif ux < 0.0:
        way, partner = (radius - x) / ux, CUSHION_X0
    if uy > 0.0:
        to_y = (world.width - radius - y) / uy
        if to_y < way:
            way, partner = to_y, CUSHION_Y1
    elif uy < 0.0:
        to_y = (radius - y) / uy
        if to_y < way:
            way, partner = to_y, CUSHION_Y0
    return max(way, 0.0), partner


@kernel
def aim_at_resting(balls, world, i, j, now):
    """Let moving ball `i` meet ball `j`, which has just come to rest, if it gets there in time."""
    ball, other = balls[i], balls[j]
    a = world.deceleration
    x, y = position_at(ball, now, a)
    speed = speed_at(ball, now, a)
    reach = np.inf if a == 0.0 else 0.5 * speed * speed / a
    touch = ball.radius + other.radius
    way = way_to_resting_ball(other.x - x, other.y - y, ball.ux, ball.uy, touch, reach)
    if way < reach:
        t = now + time_to_cover(way, speed, a)
        if t < ball.next:
            ball.next = t
            ball.partner = j


@kernel
def aim_at_moving(balls, world, i, j, x, y, speed, now, stopping):
    """Let balls `i` and `j`, both moving, meet if that comes before what either has next.

    (x, y) and `speed` are those of `i` at `now`, `stopping` is when it comes to rest.
    """
    ball, other = balls[i], balls[j]
    a = world.deceleration
    xj, yj = position_at(other, now, a)
    speed_j = speed_at(other, now, a)
    horizon = min(ball.next, other.next, stopping, stop_time(other, a)) - now
    t = now + time_to_moving_ball(
        xj - x,
        yj - y,
        other.ux * speed_j - ball.ux * speed,
        other.uy * speed_j - ball.uy * speed,
        a * (ball.ux - other.ux),
        a * (ball.uy - other.uy),
        ball.radius + other.radius,
        horizon,
    )
    if t < ball.next:
        ball.next = t
        ball.partner = j
        other.next = t
        other.partner = i


@kernel
def set_off(balls, velocities):
    """Give the first balls their velocities, (n or 1, 2) in m/s, at time 0."""
    for i in range(len(velocities)):
        set_velocity(balls[i], velocities[i, 0], velocities[i, 1])


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


def play(table: Table, at_rest: np.ndarray, velocities: np.ndarray, until: float) -> Trajectory:
    """Play one shot; see `simulate`, which checks what it is given."""
    balls = at_rest.copy()
    n = len(balls)
    log = new_log(FIRST_ROOM, FIRST_ROOM + n)
    cluster = new_cluster(n)
    set_off(balls, velocities)
    start(balls, table.world, log)
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
        set_off(balls, velocities[shot])
        start(balls, world, log)
        run(balls, world, until, cluster, log)
        durations[shot], _ = finish(balls, world, until, finals[shot], unused)
        counts[shot] = log.counts[0]
