"""Resolve what is due: one contact by its law, several of one instant together."""

from __future__ import annotations

from pool_sim_ros.physics.boundary import cushion_normal, cushion_of_partner, touches_cushion
from pool_sim_ros.physics.contacts import bounce, collide_pair, contact_normal
from pool_sim_ros.physics.event_driven.cell_grid import all_moving, has_few
from pool_sim_ros.physics.event_driven.contact_group import (
    ContactGroup,
    gather,
    keep_above,
    keep_closing,
    keep_those_in_contact,
)
from pool_sim_ros.physics.event_driven.few_balls import touches_resting
from pool_sim_ros.physics.event_driven.inelastic_collapse import (
    count_round,
    is_pressed,
    keep_counts,
    raise_counts,
    rounds_at,
    rounds_of,
    separation_speed,
)
from pool_sim_ros.physics.event_driven.simultaneous import move_as_one, resolve
from pool_sim_ros.physics.event_driven.state import State
from pool_sim_ros.physics.jit import inlined, kernel
from pool_sim_ros.physics.log import BALL_BALL, CUSHION, log_event, log_hit, log_segment
from pool_sim_ros.physics.motion import (
    RESTS,
    acceleration,
    advance,
    log_spin,
    position_at,
    set_off,
    shown_at,
    touched_in_rows,
    velocity_at,
)
from pool_sim_ros.physics.tolerances import (
    CLOSING_ROUNDING,
    LAST_ROUND,
    MAX_ROUNDS,
    PRESS_TOUCHING,
    PRESSED_SPEED,
    TOUCHING,
    V_MIN,
    V_ROUNDING,
)


@inlined
def collide(state: State, a: int, b: int, now: float) -> int:
    """Resolve the contact of ball `a` with `b` that is due.

    Returns how many balls have a new motion; the first members of the group are these.
    """
    changed = state.group.members
    if not stands_alone(state, a, b, now):
        contacts, members, rounds = gather_group(state, a, b, now)
        if contacts > 0:
            hit_group(state, (contacts, members), rounds, now)
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
    if rounds_at(state.balls, a, b, now) > MAX_ROUNDS or is_pressed(state.balls, a, b, now):
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
    if has_few(grid):
        told, touched = touched_in_rows(table, grid.few.rows, (x, y), near, (i, but), now)
        if told:
            return touched
        if touches_resting(grid.few, x, y, near, i, but):
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
def leave_contact(state: State, i: int, velocity: tuple[float, float], now: float) -> None:
    """Set ball `i` off after a contact."""
    ball = state.balls[i]
    count_round(ball, now)
    set_off(ball, state.table, velocity[0], velocity[1])
    log_motion(state, i, now)


@inlined
def log_motion(state: State, i: int, now: float) -> None:
    """Write down how ball `i` moves from now on, when its motion has begun."""
    table, ball, log = state.table, state.balls[i], state.log
    velocity, change = velocity_at(ball, table, now), acceleration(ball, table)
    number = log_segment(log, i, now, shown_at(ball, table), velocity, change)
    if number >= 0:
        log_spin(log.segments[number], ball, table)


@inlined
def hit_ball(state: State, a: int, b: int, now: float) -> None:
    """Resolve a contact of two balls, `a` below `b`, that nothing else touches."""
    table, balls = state.table, state.balls
    va = advance(balls[a], table, now)
    vb = advance(balls[b], table, now)
    normal = contact_normal(balls[b].x - balls[a].x, balls[b].y - balls[a].y)
    nx, ny = normal
    closing = (va[0] - vb[0]) * nx + (va[1] - vb[1]) * ny
    slower = min(va[0] * va[0] + va[1] * va[1], vb[0] * vb[0] + vb[1] * vb[1])
    parting, _, repeats, presses = separation_speed(table, balls, a, b, (closing, slower), now)
    keep_counts(balls, a, b, repeats, presses)
    # A contact that rounding has part already pushes nothing.
    if closing + parting > 0.0:
        va, vb = collide_pair(table, balls[a], balls[b], va, vb, normal, parting)
        log_contact(state, a, b, normal, closing, now)
    leave_contact(state, a, va, now)
    leave_contact(state, b, vb, now)


@inlined
def hit_cushion(state: State, a: int, partner: int, now: float) -> None:
    """Resolve a contact of a ball that touches nothing but one cushion."""
    table, balls = state.table, state.balls
    cushion = cushion_of_partner(partner)
    velocity = advance(balls[a], table, now)
    normal = cushion_normal(table.boundary, cushion, balls[a].x, balls[a].y)
    closing = velocity[0] * normal[0] + velocity[1] * normal[1]
    speeds = closing, 0.0
    parting, least, repeats, presses = separation_speed(table, balls, a, partner, speeds, now)
    keep_counts(balls, a, partner, repeats, presses)
    if closing + parting > 0.0:
        if closing > CLOSING_ROUNDING or parting > 0.0:
            log_contact(state, a, partner, normal, closing, now)
        velocity = bounce(table, balls[a], cushion, normal, velocity, (parting, least))
    leave_contact(state, a, velocity, now)


@kernel
def gather_group(state: State, a: int, b: int, now: float) -> tuple[int, int, int]:
    """Collect the contacts to be resolved together.

    The longest rattle of all that touches decides for all of it: if two neighbours were each to
    go by their own, they could take turns for ever.

    Returns
    -------
    contacts, members, rounds : int
        Their number, which may be 0, that of the balls in them, and the contacts so far in the
        longest rattle.
    """
    group = state.group
    pressed = is_pressed(state.balls, a, b, now)
    count, members = gather(state, a, b, now, PRESS_TOUCHING if pressed else TOUCHING)
    rounds = MAX_ROUNDS + 1 if pressed else 0
    for m in range(members):
        rounds = max(rounds, rounds_of(state.balls[group.members[m]], now))
    if rounds <= MAX_ROUNDS:
        count = keep_closing(group, count)
    elif rounds == MAX_ROUNDS + 1:
        # What parts fast is not pressed; to stop it here would add energy.
        count = keep_above(group, count, -PRESSED_SPEED)
    return count, keep_those_in_contact(group, count, members), rounds


@kernel
def hit_group(state: State, counts: tuple[int, int], rounds: int, now: float) -> None:
    """Resolve the contacts of a group, which `gather_group` collected and counted."""
    count, members = counts
    balls, group = state.balls, state.group
    want_separation(state, count, rounds, now)
    for m in range(members):
        advance(balls[group.members[m]], state.table, now)
    if rounds > LAST_ROUND:
        move_as_one(balls, group, count, members)
    else:
        resolve(state, count, members)
    for c in range(count):
        one = group.contacts[c]
        if one.impulse > 0.0:
            log_contact(state, one.a, one.b, (one.nx, one.ny), one.closing, now)
    for m in range(members):
        i = group.members[m]
        leave_contact(state, i, (group.by_ball[i].vx, group.by_ball[i].vy), now)


@inlined
def slower_of(group: ContactGroup, a: int, b: int) -> float:
    """Return the square of the speed of the slower of two members, m^2/s^2; 0 at a cushion."""
    if b < 0:
        return 0.0
    one, other = group.by_ball[a], group.by_ball[b]
    return min(one.vx * one.vx + one.vy * one.vy, other.vx * other.vx + other.vy * other.vy)


@inlined
def want_separation(state: State, count: int, rounds: int, now: float) -> None:
    """Set how fast the two sides of each of `count` contacts are to part."""
    table, balls, group = state.table, state.balls, state.group
    for c in range(count):
        one = group.contacts[c]
        speeds = one.closing, slower_of(group, one.a, one.b)
        speed, _, repeats, presses = separation_speed(table, balls, one.a, one.b, speeds, now)
        if rounds > MAX_ROUNDS and one.closing < -CLOSING_ROUNDING:
            # It parts; the others must not press it together again. At 0, rounding would decide
            # whether it is due again at once, and count as another round.
            speed = V_ROUNDING
        elif rounds > MAX_ROUNDS + 1 or (rounds > MAX_ROUNDS and one.b < 0):
            speed = V_MIN
        one.separation, one.repeats, one.presses = speed, repeats, presses
    # Only now, lest the next contact of the same ball should count this one too.
    for c in range(count):
        one = group.contacts[c]
        keep_counts(balls, one.a, one.b, min(one.repeats, 0), 0)
    for c in range(count):
        one = group.contacts[c]
        raise_counts(balls, one.a, one.repeats, one.presses)
        if one.b >= 0:
            raise_counts(balls, one.b, one.repeats, one.presses)


@inlined
def log_contact(
    state: State, a: int, b: int, normal: tuple[float, float], closing: float, now: float
) -> None:
    """Write a contact that pushes down."""
    closing = max(closing, 0.0)
    ball, log = state.balls[a], state.log
    point = ball.x + normal[0] * ball.radius, ball.y + normal[1] * ball.radius
    if b >= 0:
        log_event(log, now, BALL_BALL, (a, b), point, normal, closing)
        log_hit(log, a, b, state.table.cue_ball)
    else:
        log_event(log, now, CUSHION, (a, cushion_of_partner(b)), point, normal, closing)
