"""The report's integrator: its Listings 2 and 3, operation for operation.

In each slice all balls move, then each meets its cushions, then each pair is looked at, in the
order of the listing. Left out is only what cannot change a bit of the result: moving a ball
that rests, and looking at a pair that is too far apart to touch within the next slices.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from pool_sim_ros.physics.contacts.discs import (
    coulomb_impulse,
    report_friction,
    restitution,
    sign,
)
from pool_sim_ros.physics.jit import kernel
from pool_sim_ros.physics.runaway import most_energy, runs_away
from pool_sim_ros.physics.state import (
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

FIRST_ROOM = 64
"""Slices with a contact that a log holds before it is first enlarged."""

NEVER = np.iinfo(np.int64).max


class Slices(NamedTuple):
    """The state of the loop: what the listing has, and when each pair must be looked at next."""

    x: np.ndarray  # (n, 2), m
    v: np.ndarray  # (n, 2), m/s
    mass: np.ndarray  # (n,), kg
    colliding: np.ndarray  # by pair: in contact, and resolved
    due: np.ndarray  # by pair: the slice in which it could touch at the earliest
    moving: np.ndarray  # by ball: at the start of this slice
    changed: np.ndarray  # by ball: whether something other than the cloth changed its motion
    clock: np.ndarray  # the slice now, and the earliest of `due`
    most: float  # with more energy than this a ball runs away, see `most_energy`


def play(
    table: Table, at_rest: np.ndarray, velocities: np.ndarray, step: float, until: float
) -> Trajectory:
    """Play one shot in slices of `step` s; see `simulate`, which checks what it is given."""
    n = len(at_rest)
    state = new_state(table, at_rest, velocities)
    loss = step * table.mu_ball_surface * table.gravity
    last = last_slice(until, step)
    log = new_log(FIRST_ROOM + most_events(n), FIRST_ROOM + 2 * n)
    log_start(state, log)
    while not run(state, at_rest, table.world, step, loss, last, log):
        log = enlarged(log)
    duration = ended(state, at_rest, step, until)
    complete = not state.v.any()
    events, segments = log.counts
    return Trajectory(
        table, state.x, state.v, duration, log.events[:events], log.segments[:segments], complete
    )


def play_many(
    table: Table,
    at_rest: np.ndarray,
    velocities: np.ndarray,
    step: float,
    until: float,
    ends: tuple[np.ndarray, np.ndarray, np.ndarray],
    parts: Iterator[slice],
) -> None:
    """Play the shots in `parts` and fill in their ends; see `simulate_many`."""
    finals, durations, counts = ends
    loss = step * table.mu_ball_surface * table.gravity
    for part in parts:
        for shot in range(*part.indices(len(velocities))):
            state = new_state(table, at_rest, velocities[shot])
            log = new_log(0, 0, wanted=False)
            run(state, at_rest, table.world, step, loss, last_slice(until, step), log)
            finals[shot] = state.x
            durations[shot] = ended(state, at_rest, step, until)
            counts[shot] = log.counts[0]


def last_slice(until: float, step: float) -> int:
    """Return the slice nearest to `until`."""
    return round(min(until / step, 1e18))


@kernel
def most_events(n):
    """Return how many events one slice of `n` balls can have."""
    return n + 4 * n + n * (n - 1) // 2


def new_state(table: Table, at_rest: np.ndarray, velocities: np.ndarray) -> Slices:
    """Return the loop before its first slice, in which every ball and every pair is looked at."""
    n = len(at_rest)
    pairs = n * (n - 1) // 2
    v = np.zeros((n, 2))
    v[: len(velocities)] = velocities
    return Slices(
        most=most_energy(at_rest, table.world, velocities),
        x=np.column_stack([at_rest['x'], at_rest['y']]),
        v=v,
        mass=table.masses,
        colliding=np.zeros(pairs, np.bool_),
        due=np.ones(pairs, np.int64),
        moving=np.ones(n, np.bool_),
        changed=np.zeros(n, np.bool_),
        clock=np.array([0, 1], np.int64),
    )


def ended(state: Slices, balls: np.ndarray, step: float, until: float) -> float:
    """Return how long the shot took, in s; NaN where a ball has run away."""
    if not state.v.any():
        return float(state.clock[0] * step)
    energies = (state.v**2).sum(axis=1) / balls['inverse_mass']
    return math.nan if (energies > state.most).any() else until


@kernel
def run(state, balls, world, step, loss, last, log):
    """Take slices until all rest, `last` is done or a ball runs away.

    Returns False where the log must be enlarged.

    `step` is the slice in s, `loss` the speed that a ball loses in it, m/s.
    """
    n = len(balls)
    while state.clock[0] < last and anything_moves(state):
        if not has_room(log, most_events(n), n):
            return False
        state.clock[0] += 1
        now = state.clock[0] * step
        for i in range(n):
            if state.moving[i]:
                was_moving = state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0
                move(state, i, step, loss)
                if was_moving and state.v[i, 0] == 0.0 and state.v[i, 1] == 0.0:
                    state.changed[i] = True
                    log_event(log, now, STOPPED, i, -1, state.x[i, 0], state.x[i, 1], 0.0, 0.0, 0.0)
        for i in range(n):
            if state.moving[i]:
                meet_cushions(state, balls, world, i, now, log)
        if state.clock[1] <= state.clock[0]:
            meet_balls(state, balls, world, step, now, log)
        lost = False
        for i in range(n):
            if state.changed[i]:
                state.changed[i] = False
                speed = math.sqrt(state.v[i, 0] * state.v[i, 0] + state.v[i, 1] * state.v[i, 1])
                lost |= runs_away(speed, balls[i].inverse_mass, state.most)
                log_motion(state, i, now, log)
            state.moving[i] = state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0
        if lost:
            return True
    return True


@kernel
def anything_moves(state):
    """Return whether any ball has a velocity."""
    for i in range(len(state.v)):
        if state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0:
            return True
    return False


@kernel
def move(state, i, step, loss):
    """Move a ball through one slice (Listing 3, lines 58 to 66)."""
    vx, vy = state.v[i, 0], state.v[i, 1]
    angle = math.atan2(vy, vx)
    old = math.sqrt(vx * vx + vy * vy)
    new = old - loss
    if new < 0.0:
        new = 0.0
    cos, sin = math.cos(angle), math.sin(angle)
    state.v[i, 0], state.v[i, 1] = cos * new, sin * new
    state.x[i, 0] = state.x[i, 0] + cos * (old + new) / 2 * step
    state.x[i, 1] = state.x[i, 1] + sin * (old + new) / 2 * step


@kernel
def meet_cushions(state, balls, world, i, now, log):
    """Put a ball back inside and turn it round, whatever its direction (lines 71 to 92)."""
    radius = balls[i].radius
    for axis in range(2):
        far = (world.length if axis == 0 else world.width) - radius
        place = state.x[i, axis]
        if not (place > far or place < radius):
            continue
        old = state.v[i, axis]
        other = state.v[i, 1 - axis]
        state.v[i, axis] = -(old * world.e_ball_cushion)
        state.x[i, axis] = min(max(place, radius), far)
        after = other - sign(other) * (world.mu_ball_cushion * abs(state.v[i, axis] - old))
        state.v[i, 1 - axis] = after if sign(after) == sign(other) else 0.0
        state.changed[i] = True
        high = place > far
        into = 1.0 if high else -1.0
        nx, ny = (into, 0.0) if axis == 0 else (0.0, into)
        x, y = state.x[i, 0] + nx * radius, state.x[i, 1] + ny * radius
        log_event(log, now, CUSHION, i, 2 * axis + (1 if high else 0), x, y, nx, ny, into * old)


@kernel
def meet_balls(state, balls, world, step, now, log):
    """Look at the pairs that are due, in the order of MATLAB's nchoosek (lines 97 to 150)."""
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
                state.due[pair] = next_look(state, a, b, distance - touch, step)
            elif state.colliding[pair]:
                state.due[pair] = next_look(state, a, b, 0.0, step)
            else:
                state.colliding[pair] = True
                collide(state, balls, world, a, b, now, log)
                look_at_next_slice(state, a)
                look_at_next_slice(state, b)
    state.clock[1] = NEVER
    for pair in range(len(state.due)):
        state.clock[1] = min(state.clock[1], state.due[pair])


@kernel
def next_look(state, a, b, gap, step):
    """Return the slice before which two balls cannot touch, if nothing speeds them up."""
    va = math.sqrt(state.v[a, 0] * state.v[a, 0] + state.v[a, 1] * state.v[a, 1])
    vb = math.sqrt(state.v[b, 0] * state.v[b, 0] + state.v[b, 1] * state.v[b, 1])
    if va == 0.0 and vb == 0.0:
        return NEVER
    slices = gap / ((va + vb) * step) * (1.0 - 1e-6) - 1.0
    if slices > 1e15:
        return state.clock[0] + 1_000_000_000
    return state.clock[0] + max(1, int(slices))


@kernel
def look_at_next_slice(state, i):
    """Make all pairs with ball `i` due, where they are not already: its speed is new."""
    n = len(state.moving)
    for k in range(n):
        if k != i:
            a, b = min(i, k), max(i, k)
            pair = a * n - a * (a + 1) // 2 + b - a - 1
            state.due[pair] = min(state.due[pair], state.clock[0] + 1)


@kernel
def collide(state, balls, world, a, b, now, log):
    """Resolve the contact of two balls (lines 114 to 142)."""
    e = restitution(world, balls[a].is_cue, balls[b].is_cue)
    mass_a, mass_b = state.mass[a], state.mass[b]
    angle = math.atan2(state.x[b, 1] - state.x[a, 1], state.x[b, 0] - state.x[a, 0])
    cos, sin = math.cos(angle), math.sin(angle)
    a_n, a_t = state.v[a, 0] * cos + state.v[a, 1] * sin, state.v[a, 0] * -sin + state.v[a, 1] * cos
    b_n, b_t = state.v[b, 0] * cos + state.v[b, 1] * sin, state.v[b, 0] * -sin + state.v[b, 1] * cos
    momentum = a_n * mass_a + b_n * mass_b
    new_a_n = (momentum + mass_b * e * (b_n - a_n)) / (mass_a + mass_b)
    new_b_n = (momentum + mass_a * e * (a_n - b_n)) / (mass_a + mass_b)
    if world.coulomb:
        normal = abs(mass_a * (a_n - new_a_n))
        mass = mass_a * mass_b / (mass_a + mass_b)
        tangential = coulomb_impulse(normal, a_t - b_t, mass, world.mu_ball_ball)
        new_a_t, new_b_t = a_t + tangential / mass_a, b_t - tangential / mass_b
    else:
        new_a_t = report_friction(a_t, b_t, a_n - new_a_n, world.mu_ball_ball)
        new_b_t = report_friction(b_t, a_t, b_n - new_b_n, world.mu_ball_ball)
    x, y = state.x[a, 0] + cos * balls[a].radius, state.x[a, 1] + sin * balls[a].radius
    log_event(log, now, BALL_BALL, a, b, x, y, cos, sin, a_n - b_n)
    cos, sin = math.cos(-angle), math.sin(-angle)
    state.v[a, 0] = new_a_n * cos + new_a_t * sin
    state.v[a, 1] = new_a_n * -sin + new_a_t * cos
    state.v[b, 0] = new_b_n * cos + new_b_t * sin
    state.v[b, 1] = new_b_n * -sin + new_b_t * cos
    state.changed[a] = True
    state.changed[b] = True


@kernel
def log_motion(state, i, now, log):
    """Write down how ball `i` moves from now on."""
    vx, vy = state.v[i, 0], state.v[i, 1]
    speed = math.sqrt(vx * vx + vy * vy)
    ux, uy = (vx / speed, vy / speed) if speed > 0.0 else (0.0, 0.0)
    log_segment(log, i, now, state.x[i, 0], state.x[i, 1], ux, uy, speed)


@kernel
def log_start(state, log):
    """Write down the first motion of every ball."""
    for i in range(len(state.moving)):
        log_motion(state, i, 0.0, log)
