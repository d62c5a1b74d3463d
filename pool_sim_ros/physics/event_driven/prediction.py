"""What happens next: every moving ball keeps its own next event, and there is no table of pairs.

When a ball's motion changes, its next event is found anew, and each ball that it will now meet
before anything else is told. A ball that was about to meet it learns of the change when that
contact falls due: nothing can have come before.
"""

import numpy as np

from pool_sim_ros.physics.event_driven.cell_grid import (
    all_moving,
    has_few,
    move_on,
    neighbours,
    ways_out,
)
from pool_sim_ros.physics.event_driven.contact_time import (
    time_to_cover,
    time_to_moving_ball,
    way_to_resting_ball,
)
from pool_sim_ros.physics.event_driven.event_queue import put_down
from pool_sim_ros.physics.event_driven.few_balls import first_in_the_way, note_motion
from pool_sim_ros.physics.jit import NONE, inlined, kernel
from pool_sim_ros.physics.motion.disc import (
    CUSHION_X0,
    CUSHION_X1,
    CUSHION_Y0,
    CUSHION_Y1,
    STOP,
    position_at,
    speed_at,
    stop_time,
)


@inlined
def predict_after(balls, world, cells, schedule, changed, count, now):
    """Find the next events of the `count` balls in `changed`, whose motion is new at `now`."""
    for m in range(count):
        balls[changed[m]].contact = np.inf
        note_motion(cells.resting, balls, changed[m])
    for m in range(count):
        if balls[changed[m]].speed > 0.0:
            predict(balls, world, cells, schedule, changed, m, changed[m], now)
        else:
            lay_down(balls, world, cells, schedule, changed[m], now)


@kernel
def predict(balls, world, cells, schedule, done, n_done, i, now):
    """Find the next event of moving ball `i`, and tell those that it meets before theirs.

    The first `n_done` balls of `done` have looked at their pair with this one already.
    """
    ball = balls[i]
    a = world.deceleration
    x, y = position_at(ball, now, a)
    speed = speed_at(ball, now, a)
    way, partner = way_to_cushions(world, ball, x, y)
    t = max(stop_time(ball, a), now)
    if 2.0 * a * way < speed * speed:
        t = min(now + time_to_cover(way, speed, a), t)
    else:
        partner = STOP
    if t < ball.contact:
        ball.contact = t
        ball.partner = partner
    count = neighbours(balls, cells, i)
    meet(balls, world, cells, schedule, count, done, n_done, i, x, y, speed, now)
    plan(balls, world, cells, schedule, i, x, y, speed, now)


@kernel
def cross(balls, world, cells, schedule, i, now):
    """Let ball `i` go on into the next cell, and look at what is new there."""
    ball = balls[i]
    x, y = position_at(ball, now, world.deceleration)
    speed = speed_at(ball, now, world.deceleration)
    count = move_on(balls, cells, i, x, y)
    meet(balls, world, cells, schedule, count, cells.near, NONE, i, x, y, speed, now)
    plan(balls, world, cells, schedule, i, x, y, speed, now)


@inlined
def plan(balls, world, cells, schedule, i, x, y, speed, now):
    """Find when ball `i`, at (x, y) with `speed`, leaves its cell; put down what is first."""
    ball = balls[i]
    ball.crossing = np.inf
    to_x, to_y = ways_out(cells, ball, x, y)
    way = max(min(to_x, to_y), 0.0)
    if 2.0 * world.deceleration * way < speed * speed and way < np.inf:
        ball.crossing = now + time_to_cover(way, speed, world.deceleration)
    put_down(schedule, i, min(ball.contact, ball.crossing))


@inlined
def way_to_cushions(world, ball, x, y):
    """Return the way in m of a ball, now at (x, y), to the first cushion, and which that is."""
    way, partner = np.inf, STOP
    if ball.ux > 0.0:
        way, partner = (world.length - ball.radius - x) / ball.ux, CUSHION_X1
    elif ball.ux < 0.0:
        way, partner = (ball.radius - x) / ball.ux, CUSHION_X0
    if ball.uy > 0.0:
        to_y = (world.width - ball.radius - y) / ball.uy
        if to_y < way:
            way, partner = to_y, CUSHION_Y1
    elif ball.uy < 0.0:
        to_y = (ball.radius - y) / ball.uy
        if to_y < way:
            way, partner = to_y, CUSHION_Y0
    return max(way, 0.0), partner


@inlined
def meet(balls, world, cells, schedule, count, done, n_done, i, x, y, speed, now):
    """Let ball `i`, at (x, y) with `speed`, meet the first of the `count` balls that are near.

    What rests is compared by the way to it, so that only one time has to be computed.
    """
    ball = balls[i]
    a = world.deceleration
    lasts = ball.contact - now
    reach = lasts * (speed - 0.5 * a * lasts) if lasts < np.inf else np.inf
    if has_few(cells):
        way, partner = first_in_the_way(cells.resting, x, y, ball.ux, ball.uy, ball.radius, reach)
        moving, n_moving = cells.resting.moving, cells.resting.count[0]
    else:
        resting, moving = cells.near, cells.moving
        n_resting, n_moving = sort_out(balls, cells, count, i)
        way, partner = first_of(balls, resting, n_resting, ball, x, y, reach)
    if partner >= 0:
        book(balls, i, partner, now + time_to_cover(way, speed, a))
    for m in range(n_moving):
        j = moving[m]
        if j != i and not is_among(j, done, n_done):
            meet_moving(balls, world, schedule, i, j, x, y, speed, now)


@inlined
def sort_out(balls, cells, count, i):
    """Divide the `count` balls that are near into those that rest, in `near`, and those that move.

    Ball `i`, which moves, is left out. Returns how many rest and how many move. No branches: they
    would be guessed wrong.
    """
    n_resting = n_moving = 0
    for m in range(count):
        j = cells.near[m]
        moves = balls[j].speed > 0.0
        cells.near[n_resting] = j
        cells.moving[n_moving] = j
        n_resting += not moves
        n_moving += moves & (j != i)
    return n_resting, n_moving


@inlined
def first_of(balls, resting, count, ball, x, y, reach):
    """Return the way in m to the first of `count` resting balls, and which that is.

    As `first_in_the_way`.
    """
    way, partner = reach, STOP
    for m in range(count):
        other = balls[resting[m]]
        touch = ball.radius + other.radius
        to_ball = way_to_resting_ball(other.x - x, other.y - y, ball.ux, ball.uy, touch, way)
        if to_ball < way:
            way, partner = to_ball, resting[m]
    return way, partner


@inlined
def is_among(j, some, count):
    """Return whether ball `j` is one of the first `count` of `some`."""
    for m in range(count):
        if some[m] == j:
            return True
    return False


@inlined
def book(balls, i, j, t):
    """Let ball `i` meet ball `j` at `t`, if it has nothing before; return whether it does."""
    ball = balls[i]
    if t < ball.contact:
        ball.contact = t
        ball.partner = j
        ball.partner_changes = balls[j].changes
        return True
    return False


@inlined
def meet_moving(balls, world, schedule, i, j, x, y, speed, now):
    """Let balls `i` and `j`, both moving, meet if that comes before what either has next.

    (x, y) and `speed` are those of `i` at `now`.
    """
    ball, other = balls[i], balls[j]
    a = world.deceleration
    xj, yj = position_at(other, now, a)
    speed_j = speed_at(other, now, a)
    ends = min(stop_time(ball, a), stop_time(other, a))
    t = now + time_to_moving_ball(
        xj - x,
        yj - y,
        other.ux * speed_j - ball.ux * speed,
        other.uy * speed_j - ball.uy * speed,
        a * (ball.ux - other.ux),
        a * (ball.uy - other.uy),
        ball.radius + other.radius,
        min(ball.contact, other.contact, ends) - now,
    )
    if t < other.contact and book(balls, i, j, t):
        book(balls, j, i, t)
        put_down(schedule, j, min(t, other.crossing))


@inlined
def lay_down(balls, world, cells, schedule, j, now):
    """Take ball `j`, which has come to rest, out of the schedule; tell the moving balls near it."""
    other = balls[j]
    a = world.deceleration
    other.contact = other.crossing = np.inf
    note_motion(cells.resting, balls, j)
    put_down(schedule, j, np.inf)
    others, count = all_moving(balls, cells, j)
    for m in range(count):
        i = others[m]
        ball = balls[i]
        if ball.speed == 0.0:
            continue
        x, y = position_at(ball, now, a)
        speed = speed_at(ball, now, a)
        reach = np.inf if a == 0.0 else 0.5 * speed * speed / a
        touch = ball.radius + other.radius
        way = way_to_resting_ball(other.x - x, other.y - y, ball.ux, ball.uy, touch, reach)
        if way < reach and book(balls, i, j, now + time_to_cover(way, speed, a)):
            put_down(schedule, i, min(ball.contact, ball.crossing))
