"""The report's integrator: its Listings 2 and 3, operation for operation.

In each slice all balls move, then each meets its cushions, then each pair is looked at, in the
order of the listing. Left out is only what cannot change a bit of the result: moving a ball
that rests, and looking at a pair that is too far apart to touch within the next slices.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.contacts import coulomb_impulse, report_friction, restitution, sign
from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.jit import kernel
from pool_sim_ros.physics.log import (
    BALL_BALL,
    CUSHION,
    N_EVENTS,
    STOP,
    Log,
    log_event,
    log_hit,
    log_segment,
    new_log,
)
from pool_sim_ros.physics.motion import DiscTable
from pool_sim_ros.physics.outcomes import (
    BAD_LAYOUT,
    PLAYED,
    RUNS_AWAY,
    TOO_MANY_EVENTS,
    Ends,
    Shot,
)
from pool_sim_ros.physics.runaway import most_energy
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import COUNTABLE_SLICES, FARTHEST_LOOK, LOOK_MARGIN
from pool_sim_ros.physics.validation import is_bad

FIRST_ROOM = 1024
"""Events for which a log has room at first."""

NEVER = np.iinfo(np.int64).max


class Slices(NamedTuple):
    """The state of the loop: what the listing has, and when each pair must be looked at next."""

    table: DiscTable
    balls: NDArray[np.void]  # (n,) of DISC: radii, inverse masses, which is the cue ball
    mass: NDArray[np.float64]  # (n,), kg
    x: NDArray[np.float64]  # (n, 2), m
    v: NDArray[np.float64]  # (n, 2), m/s
    colliding: NDArray[np.bool_]  # by pair: in contact, and resolved
    due: NDArray[np.int64]  # by pair: the slice in which it could touch at the earliest
    moving: NDArray[np.bool_]  # by ball: at the start of this slice
    changed: NDArray[np.bool_]  # by ball: whether more than the cloth changed its motion
    rest: NDArray[np.float64]  # (n, 3): when and where its last motion written down ends, s, m
    clock: NDArray[np.int64]  # the slice now, and the earliest of `due`
    step: float  # s
    loss: float  # speed that a ball loses in a slice, m/s
    most: float  # with more energy than this a ball runs away, see `most_energy`
    log: Log


def play(
    table: Table,
    layout: NDArray[np.float64] | None,
    velocities: NDArray[np.float64],
    step: float,
    limits: tuple[float, int],
) -> Shot:
    """Play one shot in slices of `step` s; see `simulate`, which checks what it is given."""
    return _play(
        table, layout, table.positions, velocities, step, limits, new_log(FIRST_ROOM, FIRST_ROOM)
    )


def play_parts(
    table: Table,
    at_rest: NDArray[np.void],
    shots: tuple[NDArray[np.float64], NDArray[np.float64]],
    step: float,
    limits: tuple[float, int],
    ends: Ends,
    parts: Iterator[slice],
    store: EventStore | None,
    tell: Callable[[int], None],
) -> None:
    """Play the shots in `parts` and fill in their ends; see `event_driven.play_parts`."""
    start = np.column_stack([at_rest['x'], at_rest['y']])
    for part in parts:
        for i in range(part.start, part.stop):
            log = new_log(0, 0) if store is None else new_log(FIRST_ROOM, FIRST_ROOM)
            shot = _play(table, shots[1][i], start, shots[0][i], step, limits, log)
            played = shot.failed == PLAYED
            ends.finals[i] = shot.final_positions if played else np.nan
            ends.durations[i] = shot.duration
            ends.event_counts[i] = shot.n_events if played else -1
            ends.first_hit[i] = shot.first_hit if played else -1
            ends.failed[i] = shot.failed
            if store is not None:
                store.put(i, i + 1, shot.events, len(shot.events) if played else 0)
            tell(1)


def _play(
    table: Table,
    layout: NDArray[np.float64] | None,
    at_rest: NDArray[np.float64],
    velocities: NDArray[np.float64],
    step: float,
    limits: tuple[float, int],
    log: Log,
) -> Shot:
    """Play one shot, and again where the log had too little room, unless it has none."""
    start = at_rest if layout is None or not len(layout) else layout
    if start is layout and is_bad(table, layout):
        nowhere = np.full(start.shape, np.nan)
        nothing = log.events[:0], log.segments[:0]
        return Shot(BAD_LAYOUT, math.nan, False, nowhere, nowhere, *nothing, 0, -1)
    until, max_events = limits
    while True:
        state = new_state(table, start, velocities, step, log)
        failed = run(state, last_slice(until, step), max_events)
        events, segments, first_hit = log.counts.tolist()
        if len(log.events) == 0 or (events <= len(log.events) and segments <= len(log.segments)):
            break
        log = new_log(2 * events, 2 * segments)
    complete = not state.v.any()
    duration = float(state.clock[0] * step) if complete else until
    if failed:
        duration = math.nan
    found = log.segments[:segments]
    return Shot(
        failed,
        duration,
        complete,
        state.x,
        state.v,
        log.events[:events],
        # A ball rests within the slice in which it stops: maybe before what is written above it.
        found[np.argsort(found['t'], kind='stable')],
        events,
        first_hit,
    )


def last_slice(until: float, step: float) -> int:
    """Return the slice nearest to `until`."""
    return round(min(until / step, 1e18))


def new_state(
    table: Table,
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64],
    step: float,
    log: Log,
) -> Slices:
    """Return the loop before its first slice, in which every ball and every pair is looked at."""
    n = len(positions)
    pairs = n * (n - 1) // 2
    v = np.zeros((n, 2))
    v[: len(velocities)] = velocities
    log.counts[:] = 0, 0, -1
    state = Slices(
        table=table.for_kernels,
        balls=table.balls_at_rest,
        mass=table.masses,
        x=np.array(positions),
        v=v,
        colliding=np.zeros(pairs, np.bool_),
        due=np.ones(pairs, np.int64),
        moving=np.ones(n, np.bool_),
        changed=np.zeros(n, np.bool_),
        rest=np.zeros((n, 3)),
        clock=np.array([0, 1], np.int64),
        step=step,
        loss=step * table.mu_ball_surface * table.gravity,
        most=most_energy(table.balls_at_rest, table.for_kernels, velocities),
        log=log,
    )
    log_start(state)
    return state


@kernel
def run(state: Slices, last: int, max_events: int) -> int:
    """Take slices until all rest or `last` is done; return how it ended, as `Outcomes.failed`."""
    n = len(state.balls)
    log = state.log
    while state.clock[0] < last and anything_moves(state):
        if log.counts[N_EVENTS] > max_events:
            return TOO_MANY_EVENTS
        state.clock[0] += 1
        now = state.clock[0] * state.step
        for i in range(n):
            if state.moving[i]:
                was_moving = state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0
                move(state, i)
                if was_moving and state.v[i, 0] == 0.0 and state.v[i, 1] == 0.0:
                    state.changed[i] = True
                    position = state.x[i, 0], state.x[i, 1]
                    log_event(log, now, STOP, (i, -1), position, (0.0, 0.0), 0.0)
        for i in range(n):
            if state.moving[i]:
                meet_cushions(state, i, now)
        if state.clock[1] <= state.clock[0]:
            meet_balls(state, now)
        lost = False
        for i in range(n):
            if state.changed[i]:
                state.changed[i] = False
                speed = math.sqrt(state.v[i, 0] * state.v[i, 0] + state.v[i, 1] * state.v[i, 1])
                lost |= speed * speed > state.most * state.balls[i].inverse_mass
                log_motion(state, i, now)
            state.moving[i] = state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0
        if lost:
            return RUNS_AWAY
    return TOO_MANY_EVENTS if log.counts[N_EVENTS] > max_events else PLAYED


@kernel
def anything_moves(state: Slices) -> bool:
    """Return whether any ball has a velocity."""
    for i in range(len(state.v)):
        if state.v[i, 0] != 0.0 or state.v[i, 1] != 0.0:
            return True
    return False


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
        log_event(state.log, now, CUSHION, (i, cushion), point, (nx, ny), into * old)


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
    log_event(state.log, now, BALL_BALL, (a, b), point, (cos, sin), a_n - b_n)
    log_hit(state.log, a, b, table.cue_ball)
    cos, sin = math.cos(-angle), math.sin(-angle)
    state.v[a, 0] = new_a_n * cos + new_a_t * sin
    state.v[a, 1] = new_a_n * -sin + new_a_t * cos
    state.v[b, 0] = new_b_n * cos + new_b_t * sin
    state.v[b, 1] = new_b_n * -sin + new_b_t * cos
    state.changed[a] = True
    state.changed[b] = True


@kernel
def log_motion(state: Slices, i: int, now: float) -> None:
    """Write down how ball `i` moves from now on, until it rests or meets something."""
    vx, vy = state.v[i, 0], state.v[i, 1]
    speed = math.sqrt(vx * vx + vy * vy)
    deceleration = state.table.deceleration
    position = state.x[i, 0], state.x[i, 1]
    rest = state.rest[i]
    if speed > 0.0:
        slowing = deceleration / speed
        log_segment(state.log, i, now, position, (vx, vy), (-slowing * vx, -slowing * vy))
        lasts = speed / deceleration if deceleration > 0.0 else np.inf
        rest[0] = now + lasts
        rest[1], rest[2] = position[0] + 0.5 * vx * lasts, position[1] + 0.5 * vy * lasts
        return
    if rest[0] < now:
        # The parabola ends within the slice: beyond its end it would turn back.
        log_segment(state.log, i, rest[0], (rest[1], rest[2]), (0.0, 0.0), (0.0, 0.0))
    log_segment(state.log, i, now, position, (0.0, 0.0), (0.0, 0.0))
    rest[0] = np.inf


@kernel
def log_start(state: Slices) -> None:
    """Write down the first motion of every ball."""
    for i in range(len(state.moving)):
        log_motion(state, i, 0.0)
