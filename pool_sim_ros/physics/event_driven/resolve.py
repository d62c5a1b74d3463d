"""Resolve what is due: one contact by its law, several of one instant together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import (
    cushion_normal,
    cushion_of_partner,
    from_cushion_axes,
    to_cushion_axes,
    touches_cushion,
)
from pool_sim_ros.physics.contacts import (
    collide_disc_with_cushion,
    collide_discs,
    contact_normal,
)
from pool_sim_ros.physics.event_driven.cell_grid import all_moving, has_few
from pool_sim_ros.physics.event_driven.contact_group import gather, take_alone
from pool_sim_ros.physics.event_driven.few_balls import touches_resting
from pool_sim_ros.physics.event_driven.inelastic_collapse import (
    count_round,
    rounds_at,
    separation_speed,
)
from pool_sim_ros.physics.event_driven.simultaneous import move_as_one, resolve
from pool_sim_ros.physics.event_driven.state import State
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.log import BALL_BALL, CUSHION, log_event, log_hit, log_segment
from pool_sim_ros.physics.motion import RESTS, acceleration, position_at, set_off, velocity_at
from pool_sim_ros.physics.tolerances import LAST_ROUND, MAX_ROUNDS, TOUCHING, V_MIN


@inlined
def collide(state: State, a: int, b: int, now: float) -> int:
    """Resolve the contact of ball `a` with `b` that is due.

    Returns how many balls have a new motion; the first members of the group are these.
    """
    changed = state.group.members
    if not stands_alone(state, a, b, now):
        contacts, members = gather_group(state, a, b, now)
        hit_group(state, contacts, members, now)
        return members
    if b >= 0:
        hit_ball(state, min(a, b), max(a, b), now)
        changed[0], changed[1] = a, b
        return 2
    hit_cushion(state, a, b, now)
    changed[0] = a
    return 1


@inlined
def stands_alone(state: State, a: int, b: int, now: float) -> bool:
    """Return whether the contact of moving ball `a` with `b` is the plain case.

    That is: nothing else touches either at this instant, and neither rattles.
    """
    if rounds_at(state.balls, a, b, now) > MAX_ROUNDS:
        return False
    if is_touched(state, a, b, now):
        return False
    return b < 0 or not is_touched(state, b, a, now)


@inlined
def is_touched(state: State, i: int, but: int, now: float) -> bool:
    """Return whether anything but `but`, a ball or a cushion, touches ball `i` now."""
    table, balls, grid = state.table, state.balls, state.grid
    ball = balls[i]
    x, y = position_at(ball, table, now)
    near = ball.radius + TOUCHING
    cushion = cushion_of_partner(but)
    if ball.phase != RESTS and touches_cushion(table.boundary, x, y, near, cushion):
        return True
    if has_few(grid) and touches_resting(grid.few, x, y, near, i, but):
        return True
    others, count = all_moving(balls, grid, i)
    # Ball `i` itself and `but` are as close as that every time: no branch for them in the loop.
    found = 0
    for m in range(count):
        k = others[m]
        other = balls[k]
        xk, yk = position_at(other, table, now)
        touch = near + other.radius
        close = (xk - x) * (xk - x) + (yk - y) * (yk - y) <= touch * touch
        found |= close & (k != i) & (k != but)
    return found != 0


@inlined
def bring_to(state: State, i: int, now: float) -> tuple[float, float]:
    """Begin the motion of ball `i` anew at `now`; return its velocity, m/s."""
    table, ball = state.table, state.balls[i]
    velocity = velocity_at(ball, table, now)
    ball.x, ball.y = position_at(ball, table, now)
    ball.since = now
    return velocity


@inlined
def leave_contact(state: State, i: int, velocity: tuple[float, float], now: float) -> None:
    """Set ball `i` off after a contact."""
    ball = state.balls[i]
    count_round(ball, now)
    set_off(ball, state.table, velocity[0], velocity[1])
    log_motion(state, i, now)


@inlined
def log_motion(state: State, i: int, now: float) -> None:
    """Write down how ball `i` moves from now on, when its motion has begun."""
    table, ball = state.table, state.balls[i]
    velocity, slowing = velocity_at(ball, table, now), acceleration(ball, table)
    log_segment(state.log, i, now, (ball.x, ball.y), velocity, slowing)


@inlined
def hit_ball(state: State, a: int, b: int, now: float) -> None:
    """Resolve a contact of two balls, `a` below `b`, that nothing else touches."""
    table, balls = state.table, state.balls
    va = bring_to(state, a, now)
    vb = bring_to(state, b, now)
    normal = contact_normal(balls[b].x - balls[a].x, balls[b].y - balls[a].y)
    nx, ny = normal
    closing = (va[0] - vb[0]) * nx + (va[1] - vb[1]) * ny
    parting = separation_speed(balls, table, a, b, closing, now)
    inverse_masses = balls[a].inverse_mass, balls[b].inverse_mass
    va, vb = collide_discs(table, va, vb, normal, inverse_masses, parting)
    log_contact(state, a, b, normal, closing, now)
    leave_contact(state, a, va, now)
    leave_contact(state, b, vb, now)


@inlined
def hit_cushion(state: State, a: int, partner: int, now: float) -> None:
    """Resolve a contact of a ball that touches nothing but one cushion."""
    table, balls = state.table, state.balls
    boundary, cushion = table.boundary, cushion_of_partner(partner)
    velocity = bring_to(state, a, now)
    normal = cushion_normal(boundary, cushion, balls[a].x, balls[a].y)
    closing = velocity[0] * normal[0] + velocity[1] * normal[1]
    parting = separation_speed(balls, table, a, partner, closing, now)
    log_contact(state, a, partner, normal, closing, now)
    along, across = to_cushion_axes(boundary, cushion, normal, velocity)
    along, across = collide_disc_with_cushion(table, along, across, parting)
    velocity = from_cushion_axes(boundary, cushion, normal, (along, across))
    leave_contact(state, a, velocity, now)


@kernel
def gather_group(state: State, a: int, b: int, now: float) -> tuple[int, int]:
    """Collect the contacts to be resolved together; return their and the balls' number."""
    if rounds_at(state.balls, a, b, now) > MAX_ROUNDS:
        return gather(state, a, b, now, -np.inf)
    count, members = gather(state, a, b, now, V_MIN)
    if count == 0:
        count, members = gather(state, a, b, now, 0.0)
    if count == 0:
        count, members = take_alone(state, a, b, now)
    return count, members


@kernel
def hit_group(state: State, count: int, members: int, now: float) -> None:
    """Resolve the contacts of a group, which `gather_group` collected."""
    table, balls, group = state.table, state.balls, state.group
    rounds = most_rounds(balls, group.contacts, count, now)
    for c in range(count):
        one = group.contacts[c]
        if rounds > MAX_ROUNDS:
            one.separation = V_MIN if one.closing > 0.0 else 0.0
        else:
            one.separation = separation_speed(balls, table, one.a, one.b, one.closing, now)
    if rounds > LAST_ROUND:
        move_as_one(balls, group, count, members)
    else:
        resolve(state, count, members)
    for m in range(members):
        bring_to(state, group.members[m], now)
    for c in range(count):
        one = group.contacts[c]
        log_contact(state, one.a, one.b, (one.nx, one.ny), one.closing, now)
    for m in range(members):
        i = group.members[m]
        leave_contact(state, i, (group.by_ball[i].vx, group.by_ball[i].vy), now)


@inlined
def most_rounds(balls: NDArray[np.void], contacts: NDArray[np.void], count: int, now: float) -> int:
    """Return the most that `rounds_at` has for one of the first `count` contacts."""
    rounds = 0
    for c in range(count):
        rounds = max(rounds, rounds_at(balls, contacts[c].a, contacts[c].b, now))
    return rounds


@inlined
def log_contact(
    state: State, a: int, b: int, normal: tuple[float, float], closing: float, now: float
) -> None:
    """Write a contact down."""
    ball, log = state.balls[a], state.log
    point = ball.x + normal[0] * ball.radius, ball.y + normal[1] * ball.radius
    if b >= 0:
        log_event(log, now, BALL_BALL, (a, b), point, normal, closing)
        log_hit(log, a, b, state.table.cue_ball)
    else:
        log_event(log, now, CUSHION, (a, cushion_of_partner(b)), point, normal, closing)
