"""Which contacts belong to one instant: a rack being broken, a ball driven into a corner."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary import (
    cushion_gap,
    cushion_normal,
    n_cushions,
    partner_of_cushion,
)
from pool_sim_ros.physics.contacts import contact_normal
from pool_sim_ros.physics.event_driven.cell_grid import neighbours
from pool_sim_ros.physics.event_driven.linear_complementarity import Problem, new_problem
from pool_sim_ros.physics.jit import NONE, kernel
from pool_sim_ros.physics.motion import position_at, velocity_at
from pool_sim_ros.physics.tolerances import CLOSING_ROUNDING, V_MIN

if TYPE_CHECKING:
    from pool_sim_ros.physics.event_driven.state import State

CONTACT = np.dtype(
    [
        ('a', 'i8'),
        ('b', 'i8'),  # a ball, or a cushion as in `boundary`
        ('nx', 'f8'),
        ('ny', 'f8'),
        ('closing', 'f8'),  # m/s, before
        ('separation', 'f8'),  # m/s, wanted at least
        ('repeats', 'i8'),  # as `separation_speed` has them
        ('presses', 'i8'),
        ('impulse', 'f8'),  # N s
        ('change', 'f8'),
        ('compliance', 'f8'),  # 1/kg
    ]
)
"""One of the contacts of an instant."""

MEMBER = np.dtype(
    [
        ('index', 'i8'),  # the ball's index among the members; -1 for no member
        ('vx', 'f8'),  # velocity, m/s
        ('vy', 'f8'),
        ('before_x', 'f8'),  # velocity before friction, m/s
        ('before_y', 'f8'),
        ('pushes', 'f8'),  # how many contacts push it
        ('dvx', 'f8'),  # what friction changes of its velocity, m/s, and spin, rad/s
        ('dvy', 'f8'),
        ('dwx', 'f8'),
        ('dwy', 'f8'),
        ('dwz', 'f8'),
    ]
)
"""A ball in the group."""


class ContactGroup(NamedTuple):
    """Room for the contacts of an instant and the balls in them."""

    contacts: NDArray[np.void]  # of CONTACT
    members: NDArray[np.int64]  # (n,): numbers of the balls in the group
    by_ball: NDArray[np.void]  # (n,) of MEMBER
    problem: Problem


def new_group(n: int) -> ContactGroup:
    """Return room for any group of `n` balls.

    Circles that do not overlap have at most 3 n contacts among them, and 4 n with four cushions.
    """
    contacts, members = np.zeros(7 * n, CONTACT), np.zeros(n, np.int64)
    group = ContactGroup(contacts, members, np.zeros(n, MEMBER), new_problem())
    group.by_ball['index'] = -1
    return group


@kernel
def join(state: State, members: int, i: int, now: float) -> int:
    """Add a ball to the group unless it is in; return how many there are then."""
    group = state.group
    member = group.by_ball[i]
    if member.index >= 0:
        return members
    member.index = members
    group.members[members] = i
    member.vx, member.vy = velocity_at(state.balls[i], state.table, now)
    return members + 1


@kernel
def closing_speed(group: ContactGroup, a: int, b: int, nx: float, ny: float) -> float:
    """Return the speed in m/s at which two members, or a member and a cushion, approach."""
    one = group.by_ball[a]
    closing = one.vx * nx + one.vy * ny
    if b >= 0:
        other = group.by_ball[b]
        closing -= other.vx * nx + other.vy * ny
    return closing


@kernel
def add_contact(
    group: ContactGroup, count: int, a: int, b: int, normal: tuple[float, float]
) -> int:
    """Append a contact, of two balls the lower first; return how many there are then."""
    nx, ny = normal
    if b >= 0 and b < a:
        a, b, nx, ny = b, a, -nx, -ny
    contact = group.contacts[count]
    contact.a, contact.b = a, b
    contact.nx, contact.ny = nx, ny
    contact.closing = closing_speed(group, a, b, nx, ny)
    return count + 1


@kernel
def gather(state: State, a: int, b: int, now: float, touching: float) -> tuple[int, int]:
    """Collect all that hangs together with a contact that is due.

    What touches hangs together, whether it closes or not: one contact's push may reach the next
    one within the instant, and which is resolved with which must not depend on their order.

    Parameters
    ----------
    state : State
        Its group is filled.
    a, b : int
        The contact: a ball, and a ball or a cushion.
    now : float
        s.
    touching : float
        Gap up to which things are in contact, m.

    Returns
    -------
    contacts, members : int
        How many contacts and how many balls there are.
    """
    table, balls, group, boundary = state.table, state.balls, state.group, state.table.boundary
    members = join(state, NONE, a, now)
    if b >= 0:
        members = join(state, members, b, now)
    count = 0
    done = 0
    while done < members:
        i = group.members[done]
        x, y = position_at(balls[i], table, now)
        for cushion in range(n_cushions(boundary)):
            if cushion_gap(boundary, cushion, x, y, balls[i].radius) <= touching:
                normal = cushion_normal(boundary, cushion, x, y)
                count = add_contact(group, count, i, partner_of_cushion(cushion), normal)
        for m in range(neighbours(balls, state.grid, i)):
            k = state.grid.near[m]
            if k == i or 0 <= group.by_ball[k].index < done:
                continue
            xk, yk = position_at(balls[k], table, now)
            dx, dy = xk - x, yk - y
            near = balls[i].radius + balls[k].radius + touching
            if dx * dx + dy * dy <= near * near:
                members = join(state, members, k, now)
                count = add_contact(group, count, i, k, contact_normal(dx, dy))
        done += 1
    return count, members


@kernel
def keep_closing(group: ContactGroup, count: int) -> int:
    """Keep the contacts that close, without the weak ones where others close; return how many."""
    fastest = 0.0
    for c in range(count):
        fastest = max(fastest, group.contacts[c].closing)
    return keep_above(group, count, V_MIN if fastest > V_MIN else CLOSING_ROUNDING)


@kernel
def keep_above(group: ContactGroup, count: int, slowest: float) -> int:
    """Keep the contacts that close faster than `slowest`, m/s; return how many."""
    kept = 0
    for c in range(count):
        if group.contacts[c].closing > slowest:
            group.contacts[kept] = group.contacts[c]
            kept += 1
    return kept


@kernel
def keep_those_in_contact(group: ContactGroup, count: int, members: int) -> int:
    """Leave only those members that take part in a contact; return how many there are."""
    for m in range(members):
        member = group.by_ball[group.members[m]]
        member.pushes = 0.0
        member.index = -1
    for c in range(count):
        contact = group.contacts[c]
        group.by_ball[contact.a].pushes = 1.0
        if contact.b >= 0:
            group.by_ball[contact.b].pushes = 1.0
    kept = 0
    for m in range(members):
        if group.by_ball[group.members[m]].pushes > 0.0:
            group.members[kept] = group.members[m]
            kept += 1
    return kept
