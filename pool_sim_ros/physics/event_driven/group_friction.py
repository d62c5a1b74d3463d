"""The friction that goes with the normal impulses of an instant."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import cushion_of_partner, nose_radius
from pool_sim_ros.physics.contacts import (
    Motion,
    friction_bound,
    friction_of_balls,
    lean_of_push,
    rebound,
    reduced_mass,
    restitution,
    rigid_share,
    rub_balls,
    rub_cushion,
    rub_spheres,
    slip_at_edge,
)
from pool_sim_ros.physics.event_driven.contact_group import ContactGroup, closing_speed
from pool_sim_ros.physics.jit import Record, chosen_by, inlined, kernel, register
from pool_sim_ros.physics.motion import BallTable, DiscTable
from pool_sim_ros.physics.solid_sphere import INERTIA
from pool_sim_ros.physics.tolerances import V_ROUNDING


@chosen_by('table')
def rub_group(
    table: Any, balls: NDArray[np.void], group: ContactGroup, count: int, members: int
) -> None:
    """Apply the friction of the first `count` contacts to the members' velocities and spins."""
    raise NotImplementedError


def rub_discs(
    table: DiscTable, balls: NDArray[np.void], group: ContactGroup, count: int, members: int
) -> None:
    for c in range(count):
        if group.contacts[c].impulse > 0.0:
            rub(table, balls, group, group.contacts[c])


@kernel
def rub(table: DiscTable, balls: NDArray[np.void], group: ContactGroup, contact: Record) -> None:
    """Apply the friction that goes with a contact's normal impulse.

    `coulomb`: from the velocities that the normal impulses left, each ball's mass divided by the
    number of contacts that push it, so that no energy is gained. `report`: one contact after
    the other, as the listing does it.
    """
    a, b, nx, ny = contact.a, contact.b, contact.nx, contact.ny
    inverse_a = balls[a].inverse_mass
    tangential_a = tangential_velocity(group, a, nx, ny, table.coulomb)
    if b < 0:
        change = contact.impulse * inverse_a
        pushes = group.by_ball[a].pushes
        after = rub_cushion(tangential_a, change, table.mu_ball_cushion, pushes)
        turn(group, a, nx, ny, after - tangential_a)
        return
    tangential_b = tangential_velocity(group, b, nx, ny, table.coulomb)
    after_a, after_b = rub_balls(
        table,
        (tangential_a, tangential_b),
        contact.impulse,
        (inverse_a, balls[b].inverse_mass),
        (group.by_ball[a].pushes, group.by_ball[b].pushes),
    )
    turn(group, a, nx, ny, after_a - tangential_a)
    turn(group, b, nx, ny, after_b - tangential_b)


@kernel
def tangential_velocity(
    group: ContactGroup, ball: int, nx: float, ny: float, before: bool
) -> float:
    """Return a member's velocity along the tangent of (nx, ny), `before` friction or now, m/s."""
    member = group.by_ball[ball]
    if before:
        return member.before_y * nx - member.before_x * ny
    return member.vy * nx - member.vx * ny


@kernel
def turn(group: ContactGroup, ball: int, nx: float, ny: float, change: float) -> None:
    """Change a member's velocity by so much along the tangent of (nx, ny), m/s."""
    member = group.by_ball[ball]
    member.vx -= change * ny
    member.vy += change * nx


def rub_spheres_together(
    table: BallTable, balls: NDArray[np.void], group: ContactGroup, count: int, members: int
) -> None:
    for m in range(members):
        member = group.by_ball[group.members[m]]
        member.dvx = member.dvy = member.dwx = member.dwy = member.dwz = 0.0
    for c in range(count):
        contact = group.contacts[c]
        if contact.impulse > 0.0:
            if contact.b >= 0:
                add_friction_of_balls(table, balls, group, contact)
            else:
                add_friction_of_cushion(table, balls, group, contact)
    share = most_without_gain(table, balls, group, members)
    for m in range(members):
        i = group.members[m]
        member, ball = group.by_ball[i], balls[i]
        member.vx += share * member.dvx
        member.vy += share * member.dvy
        ball.wx += share * member.dwx
        ball.wy += share * member.dwy
        ball.wz += share * member.dwz
    for c in range(count):
        # Friction at an edge above the centre pushes into the cushion.
        one = group.contacts[c]
        closing = closing_speed(group, one.a, one.b, one.nx, one.ny)
        if one.b < 0 and one.impulse > 0.0 and closing > 0.0:
            member = group.by_ball[one.a]
            member.vx -= (closing + V_ROUNDING) * one.nx
            member.vy -= (closing + V_ROUNDING) * one.ny


@inlined
def motion_before(balls: NDArray[np.void], group: ContactGroup, i: int) -> Motion:
    """Return a member's velocity after the normal impulses, and its spin."""
    member, ball = group.by_ball[i], balls[i]
    return (member.before_x, member.before_y), (ball.wx, ball.wy, ball.wz)


@inlined
def add_change(group: ContactGroup, i: int, before: Motion, after: Motion) -> None:
    """Add what one contact's friction changes of a member's motion."""
    (vx, vy), (wx, wy, wz) = before
    (new_vx, new_vy), (new_wx, new_wy, new_wz) = after
    member = group.by_ball[i]
    member.dvx += new_vx - vx
    member.dvy += new_vy - vy
    member.dwx += new_wx - wx
    member.dwy += new_wy - wy
    member.dwz += new_wz - wz


@kernel
def add_friction_of_balls(
    table: BallTable, balls: NDArray[np.void], group: ContactGroup, contact: Record
) -> None:
    """Add the changes by the friction of two balls, from the motions after the normal impulses."""
    a, b, normal = contact.a, contact.b, (contact.nx, contact.ny)
    one, other = motion_before(balls, group, a), motion_before(balls, group, b)
    inverse_masses = balls[a].inverse_mass, balls[b].inverse_mass
    mass = reduced_mass(inverse_masses[0], inverse_masses[1])
    e = restitution(table, balls[a].is_cue, balls[b].is_cue)
    bound = friction_bound(table.rubbing, contact.impulse, e)
    radius = table.radius
    friction = friction_of_balls(table.rubbing, one, other, normal, radius, mass, bound)
    new_one, new_other = rub_spheres(one, other, normal, radius, inverse_masses, friction)
    add_change(group, a, one, new_one)
    add_change(group, b, other, new_other)


@kernel
def add_friction_of_cushion(
    table: BallTable, balls: NDArray[np.void], group: ContactGroup, contact: Record
) -> None:
    """Add the changes by the friction at a cushion's edge, as the model `impulse` has it."""
    a, nx, ny = contact.a, contact.nx, contact.ny
    radius, edge = table.radius, table.edge
    before = motion_before(balls, group, a)
    (vx, vy), (wx, wy, wz) = before
    v = vx * nx + vy * ny, vy * nx - vx * ny
    w = wx * nx + wy * ny, wy * nx - wx * ny, wz
    nose = nose_radius(table.boundary, cushion_of_partner(contact.b))
    lean = lean_of_push(radius, edge.height, nose)
    along, across = slip_at_edge(v, w, radius, lean)
    slip = np.sqrt(along * along + across * across)
    push = contact.impulse * balls[a].inverse_mass / lean[0]
    share = rigid_share(slip, push, edge.f)
    v, w = rebound(v, w, radius, lean, 0.0, (share * along, share * across))
    after = (
        (v[0] * nx - v[1] * ny, v[0] * ny + v[1] * nx),
        (w[0] * nx - w[1] * ny, w[0] * ny + w[1] * nx, w[2]),
    )
    add_change(group, a, before, after)


@kernel
def most_without_gain(
    table: BallTable, balls: NDArray[np.void], group: ContactGroup, members: int
) -> float:
    """Return the largest part of the changes, at most 1, that adds no energy.

    The energy is quadratic in that part: ``first s + second s^2`` more than before.
    """
    first, second = 0.0, 0.0
    inertia = INERTIA * table.radius * table.radius
    for m in range(members):
        i = group.members[m]
        member, ball = group.by_ball[i], balls[i]
        mass = 1.0 / ball.inverse_mass
        across = member.vx * member.dvx + member.vy * member.dvy
        turn = ball.wx * member.dwx + ball.wy * member.dwy + ball.wz * member.dwz
        first += mass * (across + inertia * turn)
        squared = member.dvx * member.dvx + member.dvy * member.dvy
        turned = member.dwx * member.dwx + member.dwy * member.dwy + member.dwz * member.dwz
        second += 0.5 * mass * (squared + inertia * turned)
    if second <= 0.0:
        return 0.0
    return min(max(-first / second, 0.0), 1.0)


register(rub_group, DiscTable, rub_discs)
register(rub_group, BallTable, rub_spheres_together)
