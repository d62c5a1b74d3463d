"""What happens next: every moving ball keeps its own next event, and there is no table of pairs.

When a ball's motion changes, its next event is found anew, and that of every ball that was about
to meet it.
"""

import numpy as np

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
    speed_at,
    stop_time,
)


@kernel
def earliest(balls):
    """Return the ball whose next event is due first."""
    first, t = 0, balls[0].next
    for i in range(1, len(balls)):
        if balls[i].next < t:
            first, t = i, balls[i].next
    return first


@kernel
def predict_all(balls, world, everyone, now):
    """Find the next event of every ball; `everyone` is room for all their numbers."""
    n = len(balls)
    for i in range(n):
        everyone[i] = i
        balls[i].next = np.inf
    for m in range(n):
        if balls[m].speed > 0.0:
            predict(balls, world, everyone, m, now)


@kernel
def predict_after(balls, world, changed, count, now):
    """Find anew the next events of the balls in a collision and of those that were to meet them.

    `changed` has room for all balls; its first `count` are those of the collision.
    """
    stale = count
    for i in range(len(balls)):
        bereft = False
        for m in range(count):
            bereft |= balls[i].partner == changed[m]
        if bereft & (balls[i].next < np.inf) and not is_among(i, changed, count):
            changed[stale] = i
            stale += 1
    for m in range(stale):
        balls[changed[m]].next = np.inf
    for m in range(stale):
        if balls[changed[m]].speed > 0.0:
            predict(balls, world, changed, m, now)
        else:
            offer_resting(balls, world, changed[m], now)


@kernel
def predict(balls, world, changed, m, now):
    """Find the next event of moving ball ``changed[m]``, and tell those it meets before theirs.

    What rests is compared by the way to it, so that only one time has to be computed. The balls
    before it in `changed` have looked at this pair already.
    """
    i = changed[m]
    ball = balls[i]
    a = world.deceleration
    x, y = position_at(ball, now, a)
    ux, uy = ball.ux, ball.uy
    speed = speed_at(ball, now, a)
    way, partner = way_to_cushions(world, x, y, ux, uy, ball.radius)
    for j in range(len(balls)):
        other = balls[j]
        touch = ball.radius + other.radius
        to_ball = way_to_resting_ball(other.x - x, other.y - y, ux, uy, touch, way)
        if (to_ball < way) & (other.speed == 0.0):
            way, partner = to_ball, j
    stopping = max(stop_time(ball, a), now)
    t = stopping
    if 2.0 * a * way < speed * speed:
        t = min(now + time_to_cover(way, speed, a), stopping)
    else:
        partner = STOP
    if t < ball.next:
        ball.next = t
        ball.partner = partner
    for j in range(len(balls)):
        if balls[j].speed > 0.0 and j != i and not is_among(j, changed, m):
            aim_at_moving(balls, world, i, j, x, y, speed, now, stopping)


@kernel
def is_among(j, changed, count):
    """Return whether ball `j` is one of the first `count` of `changed`."""
    for m in range(count):
        if changed[m] == j:
            return True
    return False


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
def offer_resting(balls, world, j, now):
    """Tell the moving balls that ball `j` has come to rest."""
    for i in range(len(balls)):
        if balls[i].speed > 0.0:
            aim_at_resting(balls, world, i, j, now)


@kernel
def aim_at_resting(balls, world, i, j, now):
    """Let moving ball `i` meet ball `j`, which has come to rest, if it gets there in time."""
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
