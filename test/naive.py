"""Plain twins of the compiled kernels: slow, obvious, pure Python and numpy.

Every function says where its formula comes from.  "Listing" means Listing 2 and 3 of the ME 212
report.  SI units throughout.  `table` is a `pool_sim_ros.physics.Table` or anything like it.
Several contacts at one instant and the event loop are in `naive_events.py`.
"""

import itertools
import math
from collections import namedtuple

import numpy as np

SliceResult = namedtuple('SliceResult', 'positions velocities slices contacts')


def sign(x):
    return int(x > 0) - int(x < 0)


def pair_restitution(table, a, b):
    """The cue ball has a restitution of its own (Listing 3, line 114)."""
    involves_cue = table.balls[a].is_cue or table.balls[b].is_cue
    return table.e_cue_ball if involves_cue else table.e_ball_ball


def start_state(table, velocities, positions=None):
    """Positions and velocities (n, 2) at t = 0; a velocity (2,) is the cue ball's."""
    if positions is None:
        positions = [ball.position for ball in table.balls]
    x = np.array(positions, dtype=float)
    v = np.zeros_like(x)
    velocities = np.asarray(velocities, dtype=float)
    if velocities.ndim == 1:
        v[0] = velocities
    else:
        v[:] = velocities
    return x, v


# --- Time slicing: Listing 2 (the loop) and Listing 3 (the three kinds of motion) ---


def time_slice(table, velocities, positions=None, time_slice=1e-6, until=None, watch=None):
    """Listing 2, lines 87 to 98, until nothing moves or for round(until / time_slice) slices.

    `contacts` lists (slice number, kind, a, b) with the kinds of Trajectory.events.
    `watch(slices, positions)`, if given, is called after every slice.
    """
    x, v = start_state(table, velocities, positions)
    x, v = x.tolist(), v.tolist()
    n = len(x)
    last = math.inf if until is None else round(until / time_slice)
    colliding, contacts, slices = set(), [], 0
    while slices < last and any(vx != 0 or vy != 0 for vx, vy in v):
        slices += 1
        for i in range(n):
            x[i], v[i] = move(x[i], v[i], time_slice, table.mu_ball_surface, table.gravity)
        for i in range(n):
            x[i], v[i], cushions = wall_collisions(x[i], v[i], table.balls[i].radius, table)
            contacts += [(slices, 1, i, cushion) for cushion in cushions]
        for a, b in itertools.combinations(range(n), 2):
            reach = table.balls[a].radius + table.balls[b].radius
            dx, dy = x[a][0] - x[b][0], x[a][1] - x[b][1]
            if not math.sqrt(dx * dx + dy * dy) < reach:
                colliding.discard((a, b))
            elif (a, b) not in colliding:
                colliding.add((a, b))
                v[a], v[b] = ball_collision(table, a, b, x[a], x[b], v[a], v[b])
                contacts.append((slices, 0, a, b))
        if watch is not None:
            watch(slices, x)
    return SliceResult(np.array(x), np.array(v), slices, contacts)


def move(x, v, time_slice, mu, gravity):
    """Listing 3, lines 58 to 66."""
    angle = math.atan2(v[1], v[0])
    old = math.sqrt(v[0] * v[0] + v[1] * v[1])
    new = old - (time_slice * mu * gravity)
    if new < 0:
        new = 0.0
    effective = math.cos(angle) * (old + new) / 2, math.sin(angle) * (old + new) / 2
    moved = [x[0] + effective[0] * time_slice, x[1] + effective[1] * time_slice]
    return moved, [math.cos(angle) * new, math.sin(angle) * new]


def wall_collisions(x, v, radius, table):
    """Listing 3, lines 74 to 92: the x cushions, then the y cushions, whatever the direction."""
    x, v, cushions = list(x), list(v), []
    for axis, size in ((0, table.length), (1, table.width)):
        other = 1 - axis
        if x[axis] > size - radius or x[axis] < radius:
            cushions.append(2 * axis + int(x[axis] > size - radius))
            old = list(v)
            v[axis] = -(v[axis] * table.e_ball_cushion)
            x[axis] = min(max(x[axis], radius), size - radius)
            loss = table.mu_ball_cushion * abs(v[axis] - old[axis])
            v[other] = v[other] - sign(v[other]) * loss
            if sign(v[other]) != sign(old[other]):
                v[other] = 0.0
    return x, v, cushions


def rotate(v, angle):
    """`v * rotmat(angle)`, a row vector times the matrix of Listing 3, line 192."""
    c, s = math.cos(angle), math.sin(angle)
    return [v[0] * c + v[1] * s, v[0] * -s + v[1] * c]


def ball_collision(table, a, b, xa, xb, va, vb):
    """Listing 3, lines 114 to 142, with the tangential law of the table."""
    e = pair_restitution(table, a, b)
    mass_a, mass_b = table.balls[a].mass, table.balls[b].mass
    angle = math.atan2(xb[1] - xa[1], xb[0] - xa[0])
    a_n, a_t = rotate(va, angle)
    b_n, b_t = rotate(vb, angle)
    new_a_n, new_b_n = normal_velocities(a_n, b_n, mass_a, mass_b, e)
    if table.ball_friction == 'report':
        mu = table.mu_ball_ball
        new_a_t, new_b_t = report_tangential(a_t, b_t, a_n - new_a_n, b_n - new_b_n, mu)
    else:
        j_n = abs(mass_a * (a_n - new_a_n))
        new_a_t, new_b_t = coulomb_tangential(a_t, b_t, j_n, mass_a, mass_b, table.mu_ball_ball)
    return rotate([new_a_n, new_a_t], -angle), rotate([new_b_n, new_b_t], -angle)


# --- The collision laws ---


def normal_velocities(a_n, b_n, mass_a, mass_b, e):
    """Equations 1 and 2 of the report, solved for the two new normal velocities."""
    momentum = a_n * mass_a + b_n * mass_b
    new_a = (momentum + mass_b * e * (b_n - a_n)) / (mass_a + mass_b)
    new_b = (momentum + mass_a * e * (a_n - b_n)) / (mass_a + mass_b)
    return new_a, new_b


def report_tangential(a_t, b_t, loss_a, loss_b, mu):
    """Listing 3, lines 131 to 139; loss = normal velocity before minus after."""
    new_a = a_t - sign(a_t - b_t) * (mu * loss_a)
    new_b = b_t - sign(b_t - a_t) * (mu * loss_b)
    if sign(new_a) != sign(a_t) and sign(a_t) != 0:
        new_a = 0.0
    if sign(new_b) != sign(b_t) and sign(b_t) != 0:
        new_b = 0.0
    return new_a, new_b


def coulomb_tangential(a_t, b_t, j_n, mass_a, mass_b, mu):
    """Equal and opposite impulses against the slip, capped where the slip ends."""
    slip = a_t - b_t
    j_t = min(mu * j_n, abs(slip) * mass_a * mass_b / (mass_a + mass_b))
    return a_t - sign(slip) * j_t / mass_a, b_t + sign(slip) * j_t / mass_b


def collide_balls(velocity_a, velocity_b, normal, mass_a, mass_b, e, mu, ball_friction):
    """New velocities of two balls that touch; `normal` is the unit vector from a to b."""
    normal = np.asarray(normal, dtype=float)
    tangent = np.array([-normal[1], normal[0]])
    velocity_a, velocity_b = np.asarray(velocity_a, float), np.asarray(velocity_b, float)
    a_n, a_t = velocity_a @ normal, velocity_a @ tangent
    b_n, b_t = velocity_b @ normal, velocity_b @ tangent
    new_a_n, new_b_n = normal_velocities(a_n, b_n, mass_a, mass_b, e)
    if ball_friction == 'report':
        new_a_t, new_b_t = report_tangential(a_t, b_t, a_n - new_a_n, b_n - new_b_n, mu)
    else:
        j_n = mass_a * (a_n - new_a_n)
        new_a_t, new_b_t = coulomb_tangential(a_t, b_t, j_n, mass_a, mass_b, mu)
    return new_a_n * normal + new_a_t * tangent, new_b_n * normal + new_b_t * tangent


def collide_cushion(velocity, axis, e, mu):
    """Equation 9 with the stop at zero; `axis` 0 for x cushions, 1 for y cushions."""
    new = np.array(velocity, dtype=float)
    new[axis] = -e * velocity[axis]
    loss = mu * abs(new[axis] - velocity[axis])
    along = velocity[1 - axis]
    new[1 - axis] = sign(along) * max(0.0, abs(along) - loss)
    return new


# --- Contact times.  A ball that rolls straight loses speed at the constant rate `deceleration` ---


def runaway_energy(table, velocities):
    """Return the energy with which one ball runs away, J: a hundred times that of all at first."""
    energy = 0.0
    for ball, velocity in zip(table.balls, velocities, strict=False):
        energy += 0.5 * ball.mass * max(math.hypot(*velocity), 0.01) ** 2
    return math.inf if table.ball_friction == 'coulomb' else 100.0 * energy


def time_to_travel(distance, speed, deceleration):
    """Time to roll `distance`: s = v t - a t^2 / 2, first root; inf where it stops short."""
    under_root = speed * speed - 2 * deceleration * distance
    if speed == 0 or under_root < 0:
        return math.inf
    return max(0.0, 2 * distance / (speed + math.sqrt(under_root)))


def time_to_cushion(position, velocity, radius, cushion, length, width, deceleration):
    """Time until the ball touches cushion 0 (x = 0), 1 (x = length), 2 (y = 0), 3 (y = width)."""
    axis, outward = cushion // 2, 1 if cushion % 2 else -1
    closing = outward * velocity[axis]
    if closing <= 0:
        return math.inf
    wall = (length, width)[axis] if outward == 1 else 0.0
    gap = outward * (wall - position[axis]) - radius
    speed = math.hypot(velocity[0], velocity[1])
    return time_to_travel(gap * speed / closing, speed, deceleration)


def time_to_ball_at_rest(position, velocity, target, reach, deceleration):
    """Time until a ball touches one at rest, the radii adding to `reach`: line meets circle."""
    speed = math.hypot(velocity[0], velocity[1])
    if speed == 0:
        return math.inf
    ux, uy = velocity[0] / speed, velocity[1] / speed
    dx, dy = target[0] - position[0], target[1] - position[1]
    along, across = dx * ux + dy * uy, dx * uy - dy * ux
    if along <= 0 or abs(across) >= reach:
        return math.inf
    distance = along - math.sqrt(reach * reach - across * across)
    return time_to_travel(distance, speed, deceleration)


def time_to_moving_ball(position_a, velocity_a, position_b, velocity_b, reach, deceleration):
    """First time at which two moving balls touch and close, before either of them stops.

    |d + w t + c t^2|^2 = reach^2 with d, w the relative position and velocity and c half the
    relative acceleration: the real roots of a quartic at which its derivative is negative.
    """
    d = np.subtract(position_b, position_a)
    w = np.subtract(velocity_b, velocity_a)
    speed_a, speed_b = math.hypot(*velocity_a), math.hypot(*velocity_b)
    c = -0.5 * deceleration * (np.asarray(velocity_b) / speed_b - np.asarray(velocity_a) / speed_a)
    horizon = min(speed_a, speed_b) / deceleration if deceleration > 0 else math.inf
    if d @ d <= reach * reach and d @ w < 0:
        return 0.0
    quartic = np.array([c @ c, 2 * w @ c, w @ w + 2 * d @ c, 2 * d @ w, d @ d - reach * reach])
    slope, curvature = np.polyder(quartic), np.polyder(quartic, 2)
    best = math.inf
    for root in np.roots(quartic):
        if abs(root.imag) > 1e-6 * max(1.0, abs(root.real)):
            continue
        t = root.real
        for _ in range(20):  # Newton; leaves a root that is nearly double where it is
            rise = np.polyval(slope, t)
            if abs(rise) < 1e-14 * abs(np.polyval(curvature, t)):
                break
            t -= np.polyval(quartic, t) / rise
        enters = np.polyval(slope, t) < 0 and abs(np.polyval(quartic, t)) < 1e-12
        if enters and -1e-12 < t <= horizon:
            best = min(best, max(t, 0.0))
    return best


def first_in_the_way(balls, position, direction, radius, reach):
    """Return the distance to the first resting ball and its number; `reach` and -1 for none."""
    best = reach, -1
    for k, ball in enumerate(balls):
        if ball['phase'] != 0:
            continue
        dx, dy = ball['x'] - position[0], ball['y'] - position[1]
        along = dx * direction[0] + dy * direction[1]
        aside = dx * direction[1] - dy * direction[0]
        touch = radius + ball['radius']
        if along > 0.0 and abs(aside) < touch:
            distance = max(0.0, along - math.sqrt(touch**2 - aside**2))
            if distance < best[0]:
                best = distance, k
    return best


def neighbours(balls, i):
    """Return the numbers, in order, of the balls in the cell of ball `i` and in those around it."""
    return [
        k
        for k, ball in enumerate(balls)
        if abs(ball['cell_x'] - balls[i]['cell_x']) <= 1
        and abs(ball['cell_y'] - balls[i]['cell_y']) <= 1
    ]
