"""Which contacts belong to one instant: a rack being broken, a ball driven into a corner."""

from typing import NamedTuple

import numpy as np

from pool_sim_ros.physics.contacts.discs import contact_normal, cushion_gap, cushion_normal
from pool_sim_ros.physics.event_driven.cell_grid import neighbours
from pool_sim_ros.physics.jit import NONE, kernel
from pool_sim_ros.physics.motion.disc import CUSHION_X0, position_at, speed_at

TOUCHING = 1e-9
"""Gap in m up to which things are in contact at the same instant."""

CONTACT = np.dtype(
    [
        ('a', 'i8'),
        ('b', 'i8'),  # a ball, or a cushion as in `motion`
        ('nx', 'f8'),
        ('ny', 'f8'),
        ('closing', 'f8'),  # m/s, before
        ('separation', 'f8'),  # m/s, wanted at least
        ('impulse', 'f8'),  # N s
        ('change', 'f8'),
        ('compliance', 'f8'),  # 1/kg
    ]
)
"""One of the contacts of an instant."""


class Cluster(NamedTuple):
    """Room for the contacts of an instant and the balls in them."""

    contacts: np.ndarray
    members: np.ndarray
    place: np.ndarray  # by ball: where it is among the members; -1 for no member
    vx: np.ndarray
    vy: np.ndarray
    before_x: np.ndarray
    before_y: np.ndarray
    pushes: np.ndarray


def new_cluster(n: int) -> Cluster:
    """Return room for any cluster of `n` balls.

    Circles that do not overlap have at most 3 n contacts among them, and 4 n with the cushions.
    """
    return Cluster(
        np.zeros(7 * n, CONTACT),
        np.zeros(n, np.int64),
        np.full(n, -1),
        *(np.zeros(n) for _ in range(5)),
    )


@kernel
def join(balls, world, cluster, members, ball, now):
    """Add a ball to the cluster unless it is in; return how many there are then."""
    if cluster.place[ball] >= 0:
        return members
    cluster.place[ball] = members
    cluster.members[members] = ball
    speed = speed_at(balls[ball], now, world.deceleration)
    cluster.vx[ball] = balls[ball].ux * speed
    cluster.vy[ball] = balls[ball].uy * speed
    return members + 1


@kernel
def closing_speed(cluster, a, b, nx, ny):
    """Return the speed in m/s at which two members, or a member and a cushion, approach."""
    closing = cluster.vx[a] * nx + cluster.vy[a] * ny
    if b >= 0:
        closing -= cluster.vx[b] * nx + cluster.vy[b] * ny
    return closing


@kernel
def add_contact(cluster, count, a, b, nx, ny, slowest):
    """Append a contact, of two balls the lower first, if it closes faster than `slowest`, m/s.

    Returns how many there are then.
    """
    if b >= 0 and b < a:
        a, b, nx, ny = b, a, -nx, -ny
    closing = closing_speed(cluster, a, b, nx, ny)
    if not closing > slowest:
        return count
    contact = cluster.contacts[count]
    contact.a, contact.b = a, b
    contact.nx, contact.ny = nx, ny
    contact.closing = closing
    return count + 1


@kernel
def gather(balls, world, cells, cluster, a, b, now, slowest):
    """Collect the contacts of this instant among all that hangs together with a contact.

    What touches hangs together, whether it closes or not: one contact's push may reach the next
    one within the instant, and which is resolved with which must not depend on their order.

    Parameters
    ----------
    balls : ndarray of BALL
    world : World
    cells : Cells
    cluster : Cluster
        Filled.
    a, b : int
        The contact that is due: a ball, and a ball or a cushion.
    now : float
        s.
    slowest : float
        Contacts take part where they close faster than this, m/s.

    Returns
    -------
    contacts, members : int
        How many contacts take part, and how many balls are in them.
    """
    members = join(balls, world, cluster, NONE, a, now)
    if b >= 0:
        members = join(balls, world, cluster, members, b, now)
    count = 0
    done = 0
    while done < members:
        i = cluster.members[done]
        x, y = position_at(balls[i], now, world.deceleration)
        for cushion in range(4):
            if cushion_gap(world, x, y, balls[i].radius, cushion) <= TOUCHING:
                nx, ny = cushion_normal(cushion)
                count = add_contact(cluster, count, i, CUSHION_X0 - cushion, nx, ny, slowest)
        for m in range(neighbours(balls, cells, i)):
            k = cells.near[m]
            if k == i or 0 <= cluster.place[k] < done:
                continue
            xk, yk = position_at(balls[k], now, world.deceleration)
            dx, dy = xk - x, yk - y
            near = balls[i].radius + balls[k].radius + TOUCHING
            if dx * dx + dy * dy <= near * near:
                members = join(balls, world, cluster, members, k, now)
                nx, ny = contact_normal(dx, dy)
                count = add_contact(cluster, count, i, k, nx, ny, slowest)
        done += 1
    return count, keep_those_in_contact(cluster, count, members)


@kernel
def take_alone(balls, world, cluster, a, b, now):
    """Collect only the contact of ball `a` with `b`, even if rounding has it part already."""
    members = join(balls, world, cluster, NONE, a, now)
    nx, ny = cushion_normal(CUSHION_X0 - b)
    if b >= 0:
        members = join(balls, world, cluster, members, b, now)
        xa, ya = position_at(balls[a], now, world.deceleration)
        xb, yb = position_at(balls[b], now, world.deceleration)
        nx, ny = contact_normal(xb - xa, yb - ya)
    count = add_contact(cluster, NONE, a, b, nx, ny, -np.inf)
    return count, keep_those_in_contact(cluster, count, members)


@kernel
def keep_those_in_contact(cluster, count, members):
    """Leave only those members that take part in a contact; return how many there are."""
    for m in range(members):
        cluster.pushes[cluster.members[m]] = 0.0
        cluster.place[cluster.members[m]] = -1
    for c in range(count):
        cluster.pushes[cluster.contacts[c].a] = 1.0
        if cluster.contacts[c].b >= 0:
            cluster.pushes[cluster.contacts[c].b] = 1.0
    kept = 0
    for m in range(members):
        if cluster.pushes[cluster.members[m]] > 0.0:
            cluster.members[kept] = cluster.members[m]
            kept += 1
    return kept
