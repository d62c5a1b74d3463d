"""The exact integrator: from event to event, each found without stepping past another."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import (
    PHASE_END,
    is_pocket,
    pocket_centre,
    pocket_of_partner,
)
from pool_sim_ros.physics.contacts import contact_normal
from pool_sim_ros.physics.event_driven.event_queue import first
from pool_sim_ros.physics.event_driven.prediction import (
    cross,
    lay_down,
    note_change,
    predict,
    predict_after,
    take_out,
)
from pool_sim_ros.physics.event_driven.resolve import collide, log_motion
from pool_sim_ros.physics.event_driven.state import State
from pool_sim_ros.physics.jit import NONE, inlined
from pool_sim_ros.physics.log import N_EVENTS, POCKETED, log_event
from pool_sim_ros.physics.motion import (
    RESTS,
    catch,
    end_phase,
    give_spin,
    has_phases,
    position_at,
    rest_begins,
    runs_away,
    set_off,
    shown_at,
    velocity_at,
)
from pool_sim_ros.physics.outcomes import PLAYED, RUNS_AWAY, TOO_MANY_EVENTS
from pool_sim_ros.physics.runaway import most_energy
from pool_sim_ros.physics.tolerances import LAST_ROUND


@inlined
def run(state: State, until: float, most: float, max_events: int) -> int:
    """Play a shot that `strike` began; return how it ended, as `Outcomes.failed` has it.

    Parameters
    ----------
    state : State
    until : float
        Stop the clock there, s.
    most : float
        Twice the energy in J with which a ball runs away.
    max_events : int
        A longer shot is given up.
    """
    log = state.log
    idle, most_idle = 0, longest_idleness(state)
    while log.counts[N_EVENTS] <= max_events and idle <= most_idle:
        now, a = first(state.queue)
        if not now <= until or now == np.inf:
            return PLAYED
        ball = state.balls[a]
        if runs_away(ball, state.table, most):
            return RUNS_AWAY
        b = np.int64(ball.partner)
        n_events = log.counts[N_EVENTS]
        idle += 1
        if ball.cell_exit_time < ball.next_contact_time:
            cross(state, a, now)
        elif b >= 0 and state.balls[b].changes != ball.partner_changes:
            ball.next_contact_time = np.inf
            predict(state, a, NONE, now)
        elif b == PHASE_END:
            stop(state, a, now)
        elif b < 0 and is_pocket(state.table.boundary, int(b)):
            pocket(state, a, b, now)
        else:
            predict_after(state, collide(state, a, b, now), now)
        if log.counts[N_EVENTS] > n_events:
            idle = 0
    return TOO_MANY_EVENTS


@inlined
def strike(state: State, velocities: NDArray[np.float64], spins: NDArray[np.float64]) -> float:
    """Give the first balls their velocities and find all next events; returns `most_energy`.

    `spins`, (k, 3) in rad/s, are those of the first k balls.
    """
    balls, table = state.balls, state.table
    for i in range(len(spins)):
        give_spin(balls[i], table, spins[i, 0], spins[i, 1], spins[i, 2])
    for i in range(len(velocities)):
        set_off(balls[i], table, velocities[i, 0], velocities[i, 1])
        note_change(state, i)
    for i in range(len(balls)):
        log_motion(state, i, 0.0)
        if balls[i].phase != RESTS:
            predict(state, i, NONE, 0.0)
    return most_energy(balls, table, velocities)


@inlined
def longest_idleness(state: State) -> int:
    """Return how many steps without an event are possible: a bound that no shot reaches.

    Between two events each ball crosses each row and column once, and looks again at its next
    event as often as it is told of another. A contact that pushes nothing is no event: of a ball
    that is wedged these end with its rattle.
    """
    n = len(state.balls)
    rows, columns = state.grid.first.shape
    return n * (rows + columns + n + LAST_ROUND)


@inlined
def stop(state: State, a: int, now: float) -> None:
    """End the phase of a ball, where nothing touches it."""
    ball = state.balls[a]
    kind = end_phase(ball, state.table, now)
    log_event(state.log, now, kind, (a, -1), (ball.x, ball.y), (0.0, 0.0), 0.0)
    log_motion(state, a, now)
    if has_phases(state.table) and ball.phase != RESTS:
        # The same path goes on: whoever is about to meet this ball need not know.
        ball.next_contact_time = np.inf
        note_change(state, a)
        predict(state, a, NONE, now)
        return
    lay_down(state, a, now)


@inlined
def pocket(state: State, a: int, partner: int, now: float) -> None:
    """Let a ball fall into a pocket."""
    ball, boundary = state.balls[a], state.table.boundary
    number = pocket_of_partner(boundary, partner)
    velocity = velocity_at(ball, state.table, now)
    x, y = position_at(ball, state.table, now)
    centre = pocket_centre(boundary, number)
    normal = contact_normal(centre[0] - x, centre[1] - y)
    speed = np.sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1])
    log_event(state.log, now, POCKETED, (a, number), (x, y), normal, speed)
    catch(ball, state.table, number, now)
    log_motion(state, a, now)
    take_out(state, a)


@inlined
def finish(
    state: State,
    until: float,
    most: float,
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64],
) -> tuple[float, bool, bool]:
    """Fill in the state at the end, (n, 2) each.

    Returns the duration in s, whether all balls rest, and whether one has more than `most`.
    """
    table = state.table
    duration, complete, lost = 0.0, True, False
    for i in range(len(state.balls)):
        ball = state.balls[i]
        if ball.phase != RESTS:
            complete = False
            lost |= runs_away(ball, table, most)
            positions[i, 0], positions[i, 1] = position_at(ball, table, until)
            velocities[i, 0], velocities[i, 1] = velocity_at(ball, table, until)
        else:
            rests = rest_begins(ball, table)
            duration = max(duration, rests)
            # It may spin in place still.
            complete &= rests <= until
            positions[i, 0], positions[i, 1] = shown_at(ball, table)
            velocities[i, 0], velocities[i, 1] = 0.0, 0.0
    return (duration if complete else until), complete, lost
