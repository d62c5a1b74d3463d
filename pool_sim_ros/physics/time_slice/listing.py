"""What happens in one slice: Listing 3, line by line."""

from __future__ import annotations

import math

import numpy as np

from pool_sim_ros.physics.contacts import coulomb_impulse, report_friction, restitution, sign
from pool_sim_ros.physics.jit import kernel
from pool_sim_ros.physics.log import (
    BALL_BALL,
    CUSHION,
    log_event,
    log_hit,
)
from pool_sim_ros.physics.time_slice.slices import Slices
from pool_sim_ros.physics.tolerances import COUNTABLE_SLICES, FARTHEST_LOOK, LOOK_MARGIN

NEVER = np.iinfo(np.int64).max


@kernel
def move(state: Slices, i: int) -> None:
    """Move a ball through one slice (Listing 3, lines 58 to 66)."""
    vx, vy = state.v[i, 0], state.v[i, 1]
    angle = math.atan2(vy, vx)
    old = math.sqrt(vx * vx + vy * vy)
    new = old - state.loss
    if new < 0.0:
        new = 0.0
    cos, sin = math.cos(angle), math.sin(angle)
    state.v[i, 0], state.v[i, 1] = cos * new, sin * new
    state.x[i, 0] = state.x[i, 0] + cos * (old + new) / 2 * state.step
    state.x[i, 1] = state.x[i, 1] + sin * (old + new) / 2 * state.step


@kernel
def meet_cushions(state: Slices, i: int, now: float) -> None:
    """Put a ball back inside and turn it round, whatever its direction (lines 71 to 92)."""
    table, radius = state.table, state.balls[i].radius
    boundary = table.boundary
    for axis in range(2):
        far = (boundary.length if axis == 0 else boundary.width) - radius
        coordinate = state.x[i, axis]
        if not (coordinate > far or coordinate < radius):
            continue
        old = state.v[i, axis]
        other = state.v[i, 1 - axis]
        state.v[i, axis] = -(old * table.e_ball_cushion)
        state.x[i, axis] = min(max(coordinate, radius), far)
        after = other - sign(other) * (table.mu_ball_cushion * abs(state.v[i, axis] - old))
        state.v[i, 1 - axis] = after if sign(after) == sign(other) else 0.0
        state.changed[i] = True
        high = coordinate > far
        into = 1.0 if high else -1.0
        nx, ny = (into, 0.0) if axis == 0 else (0.0, into)
        point = state.x[i, 0] + nx * radius, state.x[i, 1] + ny * radius
        cushion = 2 * axis + (1 if high else 0)
        log_event(state.log, now, CUSHION, (i, cushion), point, (nx, ny), max(into * old, 0.0))


@kernel
def meet_balls(state: Slices, now: float) -> None:
    """Look at the pairs that are due, in the order of MATLAB's nchoosek (lines 97 to 150)."""
    balls = state.balls
    n = len(balls)
    pair = -1
    for a in range(n):
        for b in range(a + 1, n):
            pair += 1
            if state.due[pair] > state.clock[0]:
                continue
            dx = state.x[a, 0] - state.x[b, 0]
            dy = state.x[a, 1] - state.x[b, 1]
            distance = math.sqrt(dx * dx + dy * dy)
            touch = balls[a].radius + balls[b].radius
            if not distance < touch:
                state.colliding[pair] = False
                state.due[pair] = next_look(state, a, b, distance - touch)
            elif state.colliding[pair]:
                state.due[pair] = next_look(state, a, b, 0.0)
            else:
                state.colliding[pair] = True
                collide(state, a, b, now)
                look_at_next_slice(state, a)
                look_at_next_slice(state, b)
    state.clock[1] = NEVER
    for pair in range(len(state.due)):
        state.clock[1] = min(state.clock[1], state.due[pair])


@kernel
def next_look(state: Slices, a: int, b: int, gap: float) -> int:
    """Return the slice before which two balls cannot touch, if nothing speeds them up."""
    va = math.sqrt(state.v[a, 0] * state.v[a, 0] + state.v[a, 1] * state.v[a, 1])
    vb = math.sqrt(state.v[b, 0] * state.v[b, 0] + state.v[b, 1] * state.v[b, 1])
    if va == 0.0 and vb == 0.0:
        return NEVER
    slices = gap / ((va + vb) * state.step) * (1.0 - LOOK_MARGIN) - 1.0
    if slices > COUNTABLE_SLICES:
        return state.clock[0] + FARTHEST_LOOK
    return state.clock[0] + max(1, int(slices))


@kernel
def look_at_next_slice(state: Slices, i: int) -> None:
    """Make all pairs with ball `i` due, where they are not already: its speed is new."""
    n = len(state.moving)
    for k in range(n):
        if k != i:
            a, b = min(i, k), max(i, k)
            pair = a * n - a * (a + 1) // 2 + b - a - 1
            state.due[pair] = min(state.due[pair], state.clock[0] + 1)


@kernel
def collide(state: Slices, a: int, b: int, now: float) -> None:
    """Resolve the contact of two balls (lines 114 to 142)."""
    table, balls = state.table, state.balls
    e = restitution(table, balls[a].is_cue, balls[b].is_cue)
    mass_a, mass_b = state.mass[a], state.mass[b]
    angle = math.atan2(state.x[b, 1] - state.x[a, 1], state.x[b, 0] - state.x[a, 0])
    cos, sin = math.cos(angle), math.sin(angle)
    a_n, a_t = state.v[a, 0] * cos + state.v[a, 1] * sin, state.v[a, 0] * -sin + state.v[a, 1] * cos
    b_n, b_t = state.v[b, 0] * cos + state.v[b, 1] * sin, state.v[b, 0] * -sin + state.v[b, 1] * cos
    momentum = a_n * mass_a + b_n * mass_b
    new_a_n = (momentum + mass_b * e * (b_n - a_n)) / (mass_a + mass_b)
    new_b_n = (momentum + mass_a * e * (a_n - b_n)) / (mass_a + mass_b)
    if table.coulomb:
        normal = abs(mass_a * (a_n - new_a_n))
        mass = mass_a * mass_b / (mass_a + mass_b)
        tangential = coulomb_impulse(normal, a_t - b_t, mass, table.mu_ball_ball)
        new_a_t, new_b_t = a_t + tangential / mass_a, b_t - tangential / mass_b
    else:
        new_a_t = report_friction(a_t, b_t, a_n - new_a_n, table.mu_ball_ball)
        new_b_t = report_friction(b_t, a_t, b_n - new_b_n, table.mu_ball_ball)
    point = state.x[a, 0] + cos * balls[a].radius, state.x[a, 1] + sin * balls[a].radius
    # The listing does not ask whether they approach: a contact of balls that part pulls them.
    log_event(state.log, now, BALL_BALL, (a, b), point, (cos, sin), max(a_n - b_n, 0.0))
    log_hit(state.log, a, b, table.cue_ball)
    cos, sin = math.cos(-angle), math.sin(-angle)
    state.v[a, 0] = new_a_n * cos + new_a_t * sin
    state.v[a, 1] = new_a_n * -sin + new_a_t * cos
    state.v[b, 0] = new_b_n * cos + new_b_t * sin
    state.v[b, 1] = new_b_n * -sin + new_b_t * cos
    state.changed[a] = True
    state.changed[b] = True
