"""Resolve what is due: one contact in closed form, several of one instant together."""

from pool_sim_ros.physics.contacts.discs import (
    collide_balls,
    collide_cushion,
    contact_normal,
    cushion_normal,
    restitution,
)
from pool_sim_ros.physics.event_driven.cell_grid import all_moving, has_few
from pool_sim_ros.physics.event_driven.contact_group import TOUCHING, gather, take_alone
from pool_sim_ros.physics.event_driven.few_balls import touches_resting
from pool_sim_ros.physics.event_driven.simultaneous import move_as_one, resolve
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.motion.disc import (
    CUSHION_X0,
    CUSHION_X1,
    position_at,
    set_velocity,
    speed_at,
)
from pool_sim_ros.physics.state import BALL_BALL, CUSHION, log_event, log_segment

V_MIN = 1e-4
"""Contacts that close slower, in m/s, are weak: they take no part in another's instant, and may
belong to a collapse, bouncing ever faster."""

V_ROUNDING = 1e-11
"""Speed in m/s at which a weak contact parts at the least, so that rounding cannot close it."""

COLLAPSE_GROWTH = 4.0
"""What that speed is multiplied by at each repeat, up to V_MIN: this ends a collapse."""

REPEAT_WINDOW = 1e-3
"""Time in s within which a weak contact repeats an earlier one."""

ROUND = 1e-6
"""Time in s within which a contact belongs to the same rattle as the one before."""

MAX_ROUNDS = 200
"""Contacts of one ball in a rattle after which it parts from what it touches at V_MIN."""

LAST_ROUND = 250
"""The same, after which all that touches moves as one: it is wedged and cannot part."""


@inlined
def stands_alone(balls, world, cells, a, b, now):
    """Return whether the contact of moving ball `a` with `b` is the plain case.

    That is: nothing else touches either at this instant, and neither rattles.
    """
    if rounds_at(balls, a, b, now) > MAX_ROUNDS:
        return False
    if is_touched(balls, world, cells, a, b, now):
        return False
    return b < 0 or not is_touched(balls, world, cells, b, a, now)


@inlined
def is_touched(balls, world, cells, i, but, now):
    """Return whether anything but `but`, a ball or a cushion, touches ball `i` now."""
    ball = balls[i]
    moves = ball.speed > 0.0
    x, y = position_at(ball, now, world.deceleration)
    if moves and touches_cushion(world, x, y, ball.radius, CUSHION_X0 - but):
        return True
    near = ball.radius + TOUCHING
    if has_few(cells) and touches_resting(cells.resting, x, y, near, i, but):
        return True
    others, count = all_moving(balls, cells, i)
    # Ball `i` itself and `but` are as close as that every time: no branch for them in the loop.
    found = 0
    for m in range(count):
        k = others[m]
        other = balls[k]
        xk, yk = position_at(other, now, world.deceleration)
        touch = near + other.radius
        close = (xk - x) * (xk - x) + (yk - y) * (yk - y) <= touch * touch
        found |= close & (k != i) & (k != but)
    return found != 0


@inlined
def touches_cushion(world, x, y, radius, but):
    """Return whether a ball at (x, y) is in contact with a cushion other than number `but`."""
    near = radius + TOUCHING
    return (
        (x <= near and but != 0)
        or (world.length - x <= near and but != 1)
        or (y <= near and but != 2)
        or (world.width - y <= near and but != 3)
    )


@inlined
def rounds_at(balls, a, b, now):
    """Return how many contacts the more stricken of two balls has had in a rattle up to now."""
    rounds = balls[a].rounds if now - balls[a].touched < ROUND else 0
    if b >= 0 and now - balls[b].touched < ROUND:
        rounds = max(rounds, balls[b].rounds)
    return rounds


@inlined
def separation_speed(balls, world, a, b, closing, now):
    """Return the speed in m/s at which the two sides of a contact are to part.

    Restitution times the closing speed; but what meets weakly, and again within a moment, may
    bounce infinitely often in finite time (inelastic collapse). Then balls part a little faster
    each time, up to V_MIN, and a ball stays at a cushion.
    """
    closing = max(closing, 0.0)
    if b < 0:
        again = closing <= V_MIN and now - balls[a].touched < REPEAT_WINDOW
        return 0.0 if again else world.e_ball_cushion * closing
    parting = restitution(world, balls[a].is_cue, balls[b].is_cue) * closing
    if closing > V_MIN:
        return parting
    repeats = 0
    if now - max(balls[a].touched, balls[b].touched) < REPEAT_WINDOW:
        repeats = min(max(balls[a].repeats, balls[b].repeats) + 1, 20)
    balls[a].repeats = repeats
    balls[b].repeats = repeats
    return max(parting, min(V_MIN, V_ROUNDING * COLLAPSE_GROWTH**repeats))


@inlined
def bring_to(balls, world, i, now):
    """Begin the motion of ball `i` anew at `now`; return its velocity, m/s."""
    ball = balls[i]
    speed = speed_at(ball, now, world.deceleration)
    ball.x, ball.y = position_at(ball, now, world.deceleration)
    ball.since = now
    return ball.ux * speed, ball.uy * speed


@inlined
def set_off(balls, i, velocity, now, log):
    """Set ball `i` off after a contact."""
    ball = balls[i]
    ball.rounds = min(ball.rounds, LAST_ROUND) + 1 if now - ball.touched < ROUND else 1
    ball.touched = now
    set_velocity(ball, velocity[0], velocity[1])
    log_motion(balls, i, now, log)


@inlined
def log_motion(balls, i, now, log):
    """Write down how ball `i` moves from now on."""
    ball = balls[i]
    log_segment(log, i, now, ball.x, ball.y, ball.ux, ball.uy, ball.speed)


@inlined
def hit_ball(balls, world, a, b, now, log):
    """Resolve a contact of two balls that nothing else touches."""
    a, b = min(a, b), max(a, b)
    va = bring_to(balls, world, a, now)
    vb = bring_to(balls, world, b, now)
    nx, ny = contact_normal(balls[b].x - balls[a].x, balls[b].y - balls[a].y)
    closing = (va[0] - vb[0]) * nx + (va[1] - vb[1]) * ny
    parting = separation_speed(balls, world, a, b, closing, now)
    inverse_a, inverse_b = balls[a].inverse_mass, balls[b].inverse_mass
    va, vb = collide_balls(world, va, vb, (nx, ny), inverse_a, inverse_b, parting)
    log_contact(balls, a, b, nx, ny, closing, now, log)
    set_off(balls, a, va, now, log)
    set_off(balls, b, vb, now, log)


@inlined
def hit_cushion(balls, world, a, partner, now, log):
    """Resolve a contact of a ball that touches nothing but one cushion."""
    vx, vy = bring_to(balls, world, a, now)
    nx, ny = cushion_normal(CUSHION_X0 - partner)
    closing = vx * nx + vy * ny
    parting = separation_speed(balls, world, a, partner, closing, now)
    log_contact(balls, a, partner, nx, ny, closing, now, log)
    if partner >= CUSHION_X1:
        vx, vy = collide_cushion(world, vx, vy, parting)
    else:
        vy, vx = collide_cushion(world, vy, vx, parting)
    set_off(balls, a, (vx, vy), now, log)


@kernel
def gather_crowd(balls, world, cells, cluster, a, b, now):
    """Collect the contacts to be resolved together; return their and the balls' number."""
    if rounds_at(balls, a, b, now) > MAX_ROUNDS:
        return gather(balls, world, cells, cluster, a, b, now, -1e300)
    count, members = gather(balls, world, cells, cluster, a, b, now, V_MIN)
    if count == 0:
        count, members = gather(balls, world, cells, cluster, a, b, now, 0.0)
    if count == 0:
        count, members = take_alone(balls, world, cluster, a, b, now)
    return count, members


@kernel
def hit_crowd(balls, world, cluster, count, members, now, log):
    """Resolve the contacts of a cluster, which `gather_crowd` collected."""
    rounds = 0
    for c in range(count):
        one = cluster.contacts[c]
        rounds = max(rounds, rounds_at(balls, one.a, one.b, now))
    for c in range(count):
        one = cluster.contacts[c]
        if rounds > MAX_ROUNDS:
            one.separation = V_MIN if one.closing > 0.0 else 0.0
        else:
            one.separation = separation_speed(balls, world, one.a, one.b, one.closing, now)
    if rounds > LAST_ROUND:
        move_as_one(balls, cluster, count, members)
    else:
        resolve(balls, world, cluster, count, members)
    for m in range(members):
        bring_to(balls, world, cluster.members[m], now)
    for c in range(count):
        one = cluster.contacts[c]
        log_contact(balls, one.a, one.b, one.nx, one.ny, one.closing, now, log)
    for m in range(members):
        i = cluster.members[m]
        set_off(balls, i, (cluster.vx[i], cluster.vy[i]), now, log)


@inlined
def log_contact(balls, a, b, nx, ny, closing, now, log):
    """Write a contact down."""
    ball = balls[a]
    x, y = ball.x + nx * ball.radius, ball.y + ny * ball.radius
    if b >= 0:
        log_event(log, now, BALL_BALL, a, b, x, y, nx, ny, closing)
    else:
        log_event(log, now, CUSHION, a, CUSHION_X0 - b, x, y, nx, ny, closing)
