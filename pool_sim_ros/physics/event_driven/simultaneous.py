"""What several contacts of one instant do to the balls.

Their normal impulses are found together, as a linear complementarity problem, so that the result
does not depend on the order of the balls. Friction comes after them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.event_driven.contact_group import ContactGroup, closing_speed
from pool_sim_ros.physics.event_driven.group_friction import rub_group
from pool_sim_ros.physics.event_driven.linear_complementarity import (
    FOUND,
    GIVEN,
    MAX_DIRECT,
    solve,
)
from pool_sim_ros.physics.event_driven.state import State
from pool_sim_ros.physics.jit import Record, inlined, kernel
from pool_sim_ros.physics.tolerances import (
    CLOSING_ROUNDING,
    EASY_ITERATIONS,
    EASY_MASS_RATIO,
    IMPULSE_PRECISION,
    MAX_ITERATIONS,
)


@kernel
def resolve(state: State, count: int, members: int) -> None:
    """Give the members their velocities after all contacts, whose `separation` is set."""
    balls, group = state.balls, state.group
    if count == 1:
        one = group.contacts[0]
        needed = one.closing + one.separation
        one.impulse = max(needed / total_compliance(balls, group, 1, 0), 0.0)
        push(balls, group, one, one.impulse)
    else:
        find_normal_impulses(balls, group, count, members)
    for m in range(members):
        member = group.by_ball[group.members[m]]
        member.pushes = 0.0
        member.before_x = member.vx
        member.before_y = member.vy
    for c in range(count):
        contact = group.contacts[c]
        if contact.impulse > 0.0:
            group.by_ball[contact.a].pushes += 1.0
            if contact.b >= 0:
                group.by_ball[contact.b].pushes += 1.0
    rub_group(state.table, balls, group, count, members)


@kernel
def find_normal_impulses(
    balls: NDArray[np.void], group: ContactGroup, count: int, members: int
) -> None:
    """Apply the least normal impulses after which every contact parts as fast as it must.

    Solves ``0 <= L``, ``u(L) >= s``, ``L (u(L) - s) = 0`` for the separation speeds u and those
    wanted, s, in m/s. Balls of like mass are soon done by iteration; where the masses differ much
    that takes forever, and a few contacts are solved directly.
    """
    few = count <= MAX_DIRECT
    for c in range(count):
        group.contacts[c].impulse = 0.0
    if few and mass_ratio(balls, group, members) > EASY_MASS_RATIO:
        solve_directly(balls, group, count)
    elif not iterate(balls, group, count, members, EASY_ITERATIONS if few else MAX_ITERATIONS):
        if few:
            solve_directly(balls, group, count)


@inlined
def mass_ratio(balls: NDArray[np.void], group: ContactGroup, members: int) -> float:
    """Return the ratio of the largest mass of the members to the smallest."""
    least, most = np.inf, 0.0
    for m in range(members):
        inverse_mass = balls[group.members[m]].inverse_mass
        least, most = min(least, inverse_mass), max(most, inverse_mass)
    return most / least


@kernel
def iterate(
    balls: NDArray[np.void], group: ContactGroup, count: int, members: int, most: int
) -> bool:
    """Apply impulses by at most so many iterations; return whether they are found then.

    The method is projected Jacobi from zero with a step of 1 / sum |G_kl|: it takes all contacts at
    once, and is safe where contacts outnumber the freedoms.
    """
    scale = 0.0
    for c in range(count):
        contact = group.contacts[c]
        contact.compliance = total_compliance(balls, group, count, c)
        scale = max(scale, abs(contact.closing) + contact.separation)
    for m in range(members):
        member = group.by_ball[group.members[m]]
        scale = max(scale, abs(member.vx) + abs(member.vy))
    for _ in range(most):
        largest = 0.0
        for c in range(count):
            contact = group.contacts[c]
            closing = closing_speed(group, contact.a, contact.b, contact.nx, contact.ny)
            wanted = (closing + contact.separation) / contact.compliance
            contact.change = max(wanted, -contact.impulse)
            largest = max(largest, abs(contact.change) * contact.compliance)
        for c in range(count):
            contact = group.contacts[c]
            contact.impulse += contact.change
            push(balls, group, contact, contact.change)
        if largest <= IMPULSE_PRECISION * scale:
            return True
    return False


@kernel
def solve_directly(balls: NDArray[np.void], group: ContactGroup, count: int) -> None:
    """Apply impulses that are found as a linear complementarity problem."""
    problem = group.problem
    for c in range(count):
        one = group.contacts[c]
        problem.vectors[GIVEN, c] = one.closing + one.separation
        for k in range(count):
            problem.matrix[c, k] = compliance_of(balls, one, group.contacts[k])
    if not solve(problem, count):
        # Wedged: what cannot part does not press on at least.
        for c in range(count):
            problem.vectors[GIVEN, c] = group.contacts[c].closing
        solve(problem, count)
    for c in range(count):
        one = group.contacts[c]
        found = problem.vectors[FOUND, c]
        push(balls, group, one, found - one.impulse)
        one.impulse = found


@inlined
def compliance_of(balls: NDArray[np.void], one: Record, other: Record) -> float:
    """Return how fast an impulse at another contact parts the sides of one, 1/kg."""
    along = one.nx * other.nx + one.ny * other.ny
    total = 0.0
    if one.a == other.a:
        total += along * balls[one.a].inverse_mass
    elif one.a == other.b:
        total -= along * balls[one.a].inverse_mass
    if one.b >= 0:
        if one.b == other.b:
            total += along * balls[one.b].inverse_mass
        elif one.b == other.a:
            total -= along * balls[one.b].inverse_mass
    return total


@kernel
def total_compliance(balls: NDArray[np.void], group: ContactGroup, count: int, c: int) -> float:
    """Return ``sum_l |G_cl|``: what all impulses together can do to contact `c`, 1/kg."""
    one = group.contacts[c]
    total = 0.0
    for k in range(count):
        other = group.contacts[k]
        along = abs(one.nx * other.nx + one.ny * other.ny)
        if other.a == one.a or other.b == one.a:
            total += along * balls[one.a].inverse_mass
        if one.b >= 0 and (other.a == one.b or other.b == one.b):
            total += along * balls[one.b].inverse_mass
    return total


@kernel
def push(balls: NDArray[np.void], group: ContactGroup, contact: Record, impulse: float) -> None:
    """Apply a normal impulse in N s to both sides of a contact."""
    a, b = contact.a, contact.b
    one = group.by_ball[a]
    one.vx -= impulse * contact.nx * balls[a].inverse_mass
    one.vy -= impulse * contact.ny * balls[a].inverse_mass
    if b >= 0:
        other = group.by_ball[b]
        other.vx += impulse * contact.nx * balls[b].inverse_mass
        other.vy += impulse * contact.ny * balls[b].inverse_mass


@kernel
def move_as_one(balls: NDArray[np.void], group: ContactGroup, count: int, members: int) -> None:
    """Give all members their common velocity, less what goes into a cushion they touch.

    No impulses are found; those that closed are given what stopped them, for the log.
    """
    mass, px, py = 0.0, 0.0, 0.0
    for m in range(members):
        ball = group.members[m]
        mass += 1.0 / balls[ball].inverse_mass
        px += group.by_ball[ball].vx / balls[ball].inverse_mass
        py += group.by_ball[ball].vy / balls[ball].inverse_mass
    vx, vy = px / mass, py / mass
    for c in range(count):
        contact = group.contacts[c]
        closes = contact.closing > CLOSING_ROUNDING
        compliance = compliance_of(balls, contact, contact)
        contact.impulse = contact.closing / compliance if closes else 0.0
        into = vx * contact.nx + vy * contact.ny
        if contact.b < 0 and into > 0.0:
            vx -= into * contact.nx
            vy -= into * contact.ny
    for m in range(members):
        member = group.by_ball[group.members[m]]
        member.vx, member.vy = vx, vy
