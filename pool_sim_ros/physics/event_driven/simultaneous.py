"""What several contacts of one instant do to the balls.

Their normal impulses are found together, as a linear complementarity problem, so that the
result does not depend on the order of the balls; then comes friction.
"""

from pool_sim_ros.physics.contacts.discs import rub_balls, rub_cushion
from pool_sim_ros.physics.event_driven.contact_group import closing_speed
from pool_sim_ros.physics.jit import kernel

MAX_ITERATIONS = 20_000
IMPULSE_PRECISION = 1e-14
"""Change of the separation speeds, beside the speeds, at which the impulses are found."""


@kernel
def resolve(balls, world, cluster, count, members):
    """Give the members their velocities after all contacts, whose `separation` is set."""
    if count == 1:
        one = cluster.contacts[0]
        needed = one.closing + one.separation
        one.impulse = max(needed / total_compliance(balls, cluster, 1, 0), 0.0)
        push(balls, cluster, one, one.impulse)
    else:
        find_normal_impulses(balls, cluster, count, members)
    for m in range(members):
        ball = cluster.members[m]
        cluster.pushes[ball] = 0.0
        cluster.before_x[ball] = cluster.vx[ball]
        cluster.before_y[ball] = cluster.vy[ball]
    for c in range(count):
        contact = cluster.contacts[c]
        if contact.impulse > 0.0:
            cluster.pushes[contact.a] += 1.0
            if contact.b >= 0:
                cluster.pushes[contact.b] += 1.0
    for c in range(count):
        if cluster.contacts[c].impulse > 0.0:
            rub(balls, world, cluster, cluster.contacts[c])


@kernel
def find_normal_impulses(balls, cluster, count, members):
    """Apply the least normal impulses after which every contact parts as fast as it must.

    Solves ``0 <= L``, ``u(L) >= s``, ``L (u(L) - s) = 0`` for the separation speeds u and those
    wanted, s, by projected Jacobi from zero with a step of 1 / sum |G_kl|: all contacts at once,
    and safe where contacts outnumber the freedoms.
    """
    scale = 0.0
    for c in range(count):
        contact = cluster.contacts[c]
        contact.impulse = 0.0
        contact.compliance = total_compliance(balls, cluster, count, c)
        scale = max(scale, abs(contact.closing) + contact.separation)
    for m in range(members):
        ball = cluster.members[m]
        scale = max(scale, abs(cluster.vx[ball]) + abs(cluster.vy[ball]))
    for _ in range(MAX_ITERATIONS):
        largest = 0.0
        for c in range(count):
            contact = cluster.contacts[c]
            closing = closing_speed(cluster, contact.a, contact.b, contact.nx, contact.ny)
            wanted = (closing + contact.separation) / contact.compliance
            contact.change = max(wanted, -contact.impulse)
            largest = max(largest, abs(contact.change) * contact.compliance)
        for c in range(count):
            contact = cluster.contacts[c]
            contact.impulse += contact.change
            push(balls, cluster, contact, contact.change)
        if largest <= IMPULSE_PRECISION * scale:
            break


@kernel
def total_compliance(balls, cluster, count, c):
    """Return ``sum_l |G_cl|``: what all impulses together can do to contact `c`, 1/kg."""
    one = cluster.contacts[c]
    total = 0.0
    for k in range(count):
        other = cluster.contacts[k]
        along = abs(one.nx * other.nx + one.ny * other.ny)
        if other.a == one.a or other.b == one.a:
            total += along * balls[one.a].inverse_mass
        if one.b >= 0 and (other.a == one.b or other.b == one.b):
            total += along * balls[one.b].inverse_mass
    return total


@kernel
def push(balls, cluster, contact, impulse):
    """Apply a normal impulse in N s to both sides of a contact."""
    a, b = contact.a, contact.b
    cluster.vx[a] -= impulse * contact.nx * balls[a].inverse_mass
    cluster.vy[a] -= impulse * contact.ny * balls[a].inverse_mass
    if b >= 0:
        cluster.vx[b] += impulse * contact.nx * balls[b].inverse_mass
        cluster.vy[b] += impulse * contact.ny * balls[b].inverse_mass


@kernel
def rub(balls, world, cluster, contact):
    """Apply the friction that goes with a contact's normal impulse.

    `coulomb`: from the velocities that the normal impulses left, each ball's mass divided by the
    number of contacts that push it, so that no energy is gained. `report`: one contact after
    the other, as the listing does it.
    """
    a, b, nx, ny = contact.a, contact.b, contact.nx, contact.ny
    inverse_a = balls[a].inverse_mass
    if world.coulomb:
        ta = cluster.before_y[a] * nx - cluster.before_x[a] * ny
    else:
        ta = cluster.vy[a] * nx - cluster.vx[a] * ny
    if b < 0:
        change = contact.impulse * inverse_a
        after = rub_cushion(ta, change, world.mu_ball_cushion, cluster.pushes[a])
        turn(cluster, a, nx, ny, after - ta)
        return
    if world.coulomb:
        tb = cluster.before_y[b] * nx - cluster.before_x[b] * ny
    else:
        tb = cluster.vy[b] * nx - cluster.vx[b] * ny
    after_a, after_b = rub_balls(
        world,
        ta,
        tb,
        contact.impulse,
        inverse_a,
        balls[b].inverse_mass,
        cluster.pushes[a],
        cluster.pushes[b],
    )
    turn(cluster, a, nx, ny, after_a - ta)
    turn(cluster, b, nx, ny, after_b - tb)


@kernel
def turn(cluster, ball, nx, ny, change):
    """Change a member's velocity by so much along the tangent of (nx, ny), m/s."""
    cluster.vx[ball] -= change * ny
    cluster.vy[ball] += change * nx


@kernel
def move_as_one(balls, cluster, count, members):
    """Give all members their common velocity, less what goes into a cushion they touch."""
    mass, px, py = 0.0, 0.0, 0.0
    for m in range(members):
        ball = cluster.members[m]
        mass += 1.0 / balls[ball].inverse_mass
        px += cluster.vx[ball] / balls[ball].inverse_mass
        py += cluster.vy[ball] / balls[ball].inverse_mass
    vx, vy = px / mass, py / mass
    for c in range(count):
        contact = cluster.contacts[c]
        if contact.b < 0 and vx * contact.nx + vy * contact.ny > 0.0:
            vx *= abs(contact.ny)
            vy *= abs(contact.nx)
    for m in range(members):
        cluster.vx[cluster.members[m]] = vx
        cluster.vy[cluster.members[m]] = vy
