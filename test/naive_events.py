"""Plain twin of the event-driven integrator: every pair, every event, nothing clever.

The rules for several contacts at one instant are those of the project's design: all contacts
that touch and close take part, their normal impulses solve one linear complementarity problem,
Coulomb friction follows, and what closes too slowly is separated at V_MIN instead of bouncing,
with the friction of that push.
"""

import itertools
import math
from collections import namedtuple

import naive
import numpy as np

TOUCHING = 1e-9  # m: contacts with a gap up to this belong to one instant
V_MIN = 1e-4  # m/s: slower approaches are ended by a separation, not by a collision
ROUNDS = 200  # collisions at one instant before they are ended by a separation

# --- Several contacts at one instant ---

# a: ball; b: ball, or -1 for a cushion; normal: unit vector from a to b or into the cushion
Contact = namedtuple('Contact', 'a b normal restitution friction')


def separation_speed(contact, velocities):
    """Rate at which the gap grows (negative while it closes)."""
    against = velocities[contact.b] if contact.b >= 0 else np.zeros(2)
    return float((against - velocities[contact.a]) @ contact.normal)


def normal_directions(contacts, count):
    """J (k, 2 n): J v are the separation speeds, J^T L the momenta that impulses L give."""
    rows = np.zeros((len(contacts), count, 2))
    for row, contact in zip(rows, contacts, strict=True):
        row[contact.a] -= contact.normal
        if contact.b >= 0:
            row[contact.b] += contact.normal
    return rows.reshape(len(contacts), 2 * count)


def solve_lcp(matrix, offset):
    """L >= 0 with matrix L + offset >= 0 and L (matrix L + offset) = 0, by trying every active set.

    None where there is no solution.  For a positive semidefinite matrix the product matrix L is
    unique even where L is not (Cottle, Pang, Stone, *The Linear Complementarity Problem*).
    """
    k = len(offset)
    scale = max(1e-300, float(np.max(np.abs(offset))))
    for size in range(k + 1):
        for active in map(list, itertools.combinations(range(k), size)):
            impulses = np.zeros(k)
            block = matrix[np.ix_(active, active)]
            if size:
                impulses[active] = np.linalg.lstsq(block, -offset[active], rcond=None)[0]
            rest = matrix @ impulses + offset
            solved = np.all(np.abs(rest[active]) <= 1e-11 * scale)
            if solved and np.all(impulses >= 0) and np.all(rest >= -1e-11 * scale):
                return impulses
    return None


def cluster_impulses(contacts, velocities, masses):
    """Normal impulses L of contacts that all close: 0 <= L, G L + (1 + e) u >= 0, complementary."""
    jacobian = normal_directions(contacts, len(masses))
    delassus = jacobian @ (jacobian / np.repeat(masses, 2)).T
    closing = np.array([separation_speed(c, velocities) for c in contacts])
    restitution = np.array([c.restitution for c in contacts])
    return solve_lcp(delassus, (1 + restitution) * closing)


def separation_impulses(contacts, velocities, masses, least):
    """Impulses after which every contact opens at `least` (m/s) or faster; None if wedged."""
    jacobian = normal_directions(contacts, len(masses))
    delassus = jacobian @ (jacobian / np.repeat(masses, 2)).T
    opening = np.array([separation_speed(c, velocities) for c in contacts])
    return solve_lcp(delassus, opening - least)


def push(contacts, impulses, velocities, masses):
    """Velocities after the normal impulses."""
    jacobian = normal_directions(contacts, len(masses))
    return velocities + (jacobian.T @ impulses).reshape(-1, 2) / np.asarray(masses)[:, None]


def cluster_friction(contacts, impulses, velocities, masses):
    """Coulomb friction at every pushing contact, from the velocities after the normal impulses.

    Each ball's mass is shared equally among its pushing contacts, so that they cannot together
    take more out of a ball's slip than there is.
    """
    pushing = [(c, j) for c, j in zip(contacts, impulses, strict=True) if j > 0]
    shares = np.zeros(len(masses))
    for contact, _ in pushing:
        shares[contact.a] += 1
        if contact.b >= 0:
            shares[contact.b] += 1
    new = velocities.copy()
    for contact, j_n in pushing:
        tangent = np.array([-contact.normal[1], contact.normal[0]])
        a, b = contact.a, contact.b
        mobility = shares[a] / masses[a] + (shares[b] / masses[b] if b >= 0 else 0.0)
        against = velocities[b] if b >= 0 else np.zeros(2)
        slip = float((velocities[a] - against) @ tangent)
        j_t = naive.sign(slip) * min(contact.friction * j_n, abs(slip) / mobility)
        new[a] -= j_t / masses[a] * tangent
        if b >= 0:
            new[b] += j_t / masses[b] * tangent
    return new


def single_collision(table, contact, velocities):
    """New velocities after one contact alone, by the closed forms."""
    new = velocities.copy()
    if contact.b < 0:
        axis = 0 if contact.normal[0] != 0 else 1
        new[contact.a] = naive.collide_cushion(
            velocities[contact.a], axis, contact.restitution, contact.friction
        )
        return new
    new[contact.a], new[contact.b] = naive.collide_balls(
        velocities[contact.a],
        velocities[contact.b],
        contact.normal,
        table.balls[contact.a].mass,
        table.balls[contact.b].mass,
        contact.restitution,
        contact.friction,
        table.ball_friction,
    )
    return new


# --- The event loop ---

EventResult = namedtuple('EventResult', 'positions velocities duration events')


def event_driven(table, velocities, positions=None, until=None, most_events=10_000):
    """From event to event until nothing moves or until `until`.

    `events` lists (t, kind, a, b) with the kinds of Trajectory.events.
    """
    x, v = naive.start_state(table, velocities, positions)
    deceleration = table.mu_ball_surface * table.gravity
    end = math.inf if until is None else until
    t, events = 0.0, []
    while len(events) < most_events:
        step = min(next_contact(table, x, v, deceleration), next_stop(v, deceleration))
        if t + step > end:
            x, v = advance(x, v, end - t, deceleration)
            return EventResult(x, v, end, events)
        if math.isinf(step):
            return EventResult(x, v, events[-1][0] if events else 0.0, events)
        t += step
        moving = np.any(v != 0, axis=1)
        x, v = advance(x, v, step, deceleration)
        stopped = moving & ~np.any(v != 0, axis=1)
        events += [(t, 2, int(i), -1) for i in np.flatnonzero(stopped)]
        v, collided = resolve(table, x, v)
        events += [(t, *which) for which in collided]
    raise RuntimeError(f'more than {most_events} events')


def next_stop(v, deceleration):
    speeds = np.hypot(v[:, 0], v[:, 1])
    if deceleration == 0 or not np.any(speeds):
        return math.inf
    return float(speeds[speeds > 0].min()) / deceleration


def next_contact(table, x, v, deceleration):
    best = math.inf
    moving = np.any(v != 0, axis=1)
    for i in np.flatnonzero(moving):
        for cushion in range(4):
            time = naive.time_to_cushion(
                x[i], v[i], table.balls[i].radius, cushion, table.length, table.width, deceleration
            )
            best = min(best, time)
    for a, b in itertools.combinations(range(len(x)), 2):
        reach = table.balls[a].radius + table.balls[b].radius
        if moving[a] and moving[b]:
            time = naive.time_to_moving_ball(x[a], v[a], x[b], v[b], reach, deceleration)
        elif moving[a]:
            time = naive.time_to_ball_at_rest(x[a], v[a], x[b], reach, deceleration)
        elif moving[b]:
            time = naive.time_to_ball_at_rest(x[b], v[b], x[a], reach, deceleration)
        else:
            continue
        best = min(best, time)
    return best


def advance(x, v, step, deceleration):
    """Positions and velocities after `step`; a ball whose time is up stands still exactly."""
    x, v = x.copy(), v.copy()
    for i, velocity in enumerate(v):
        speed = math.hypot(*velocity)
        if speed == 0:
            continue
        direction = velocity / speed
        if deceleration * step >= speed:
            x[i] += direction * speed * speed / (2 * deceleration)
            v[i] = 0.0
        else:
            x[i] += velocity * step - 0.5 * deceleration * step * step * direction
            v[i] = velocity - deceleration * step * direction
    return x, v


def touching_contacts(table, x):
    """Every contact whose gap is at most TOUCHING, with the (kind, a, b) it has in an event."""
    found = []
    for i, ball in enumerate(table.balls):
        for cushion in range(4):
            axis, outward = cushion // 2, 1 if cushion % 2 else -1
            wall = (table.length, table.width)[axis] if outward == 1 else 0.0
            if outward * (wall - x[i][axis]) - ball.radius <= TOUCHING:
                normal = np.zeros(2)
                normal[axis] = outward
                contact = Contact(i, -1, normal, table.e_ball_cushion, table.mu_ball_cushion)
                found.append((contact, (1, i, cushion)))
    for a, b in itertools.combinations(range(len(x)), 2):
        d = x[b] - x[a]
        distance = math.hypot(*d)
        if distance - table.balls[a].radius - table.balls[b].radius <= TOUCHING:
            e = naive.pair_restitution(table, a, b)
            found.append((Contact(a, b, d / distance, e, table.mu_ball_ball), (0, a, b)))
    return found


def connected(some, contacts):
    """The contacts that hang together with `some` through the balls they share."""
    balls = {ball for contact in some for ball in (contact.a, contact.b) if ball >= 0}
    while True:
        group = [c for c in contacts if c.a in balls or (c.b >= 0 and c.b in balls)]
        reached = {ball for contact in group for ball in (contact.a, contact.b) if ball >= 0}
        if reached <= balls:
            return group
        balls |= reached


def resolve(table, x, v):
    """New velocities after all contacts of this instant, and which contacts took part."""
    masses = np.array([ball.mass for ball in table.balls])
    touching = touching_contacts(table, x)
    took_part = []
    for _ in range(ROUNDS):
        closing = [pair for pair in touching if separation_speed(pair[0], v) < -V_MIN]
        if not closing:
            break
        contacts = [contact for contact, _ in closing]
        took_part += [which for _, which in closing]
        if len(contacts) == 1:
            v = single_collision(table, contacts[0], v)
        else:
            impulses = cluster_impulses(contacts, v, masses)
            v = push(contacts, impulses, v, masses)
            v = cluster_friction(contacts, impulses, v, masses)
    slow = [pair for pair in touching if separation_speed(pair[0], v) < 0]
    if slow:
        contacts = connected([contact for contact, _ in slow], [c for c, _ in touching])
        impulses = separation_impulses(contacts, v, masses, V_MIN)
        if impulses is None:
            impulses = separation_impulses(contacts, v, masses, 0.0)
        v = push(contacts, impulses, v, masses)
        v = cluster_friction(contacts, impulses, v, masses)
        took_part += [which for _, which in slow]
    return v, took_part
