"""The report's loop, compiled, with nothing left out: every ball and every pair in every slice.

Listing 2, lines 87 to 98, and Listing 3, lines 56 to 152, line by line. `time_slice` must equal it
bit for bit, and its speed is measured against it.
"""

import math

import numpy as np
from numba import njit

compiled = njit(cache=True, error_model='numpy', nogil=True)


def play(table, velocity, time_slice):
    """Play one shot until all balls rest.

    Parameters
    ----------
    table : Table
        With the report's law of friction between balls.
    velocity : array_like of shape (2,)
        Of the cue ball, m/s.
    time_slice : float
        s.

    Returns
    -------
    positions, velocities : ndarray of shape (n, 2)
        At the end, m and m/s.
    slices : int
        How many the shot took.

    Raises
    ------
    ValueError
        Where the table has another law of friction.
    """
    if table.ball_friction != 'report':
        raise ValueError(f"ball_friction: {table.ball_friction!r} must be 'report'")
    pos = table.positions.copy()
    vel = np.zeros_like(pos)
    vel[0] = velocity
    size = np.array([table.length, table.width])
    coefficients = (
        table.mu_ball_surface,
        table.mu_ball_cushion,
        table.mu_ball_ball,
        table.e_ball_cushion,
        table.e_cue_ball,
        table.e_ball_ball,
        table.gravity,
    )
    balls = table.radii, table.masses, table.is_cue
    slices = loop(pos, vel, size, *balls, time_slice, coefficients)
    return pos, vel, slices


@compiled
def loop(pos, vel, size, rad, mass, is_cue, time_slice, coefficients):
    """Take slices until nothing moves; return their number."""
    mu_bs, mu_bc, mu_bb, e_bc, e_cue, e_nn, gravity = coefficients
    n = len(pos)
    colliding = np.zeros((n, n), np.bool_)
    slices = 0
    while anything_moves(vel):
        slices += 1
        for i in range(n):
            move(pos, vel, i, time_slice, time_slice * mu_bs * gravity)
        for i in range(n):
            compute_wall_collisions(pos, vel, i, rad[i], size, e_bc, mu_bc)
        for a in range(n):
            for b in range(a + 1, n):
                dx, dy = pos[a, 0] - pos[b, 0], pos[a, 1] - pos[b, 1]
                if math.sqrt(dx * dx + dy * dy) < rad[a] + rad[b]:
                    if not colliding[a, b]:
                        colliding[a, b] = True
                        e = e_cue if is_cue[a] or is_cue[b] else e_nn
                        compute_ball_collision(pos, vel, mass, a, b, e, mu_bb)
                else:
                    colliding[a, b] = False
    return slices


@compiled
def anything_moves(vel):
    for i in range(len(vel)):
        if vel[i, 0] != 0.0 or vel[i, 1] != 0.0:
            return True
    return False


@compiled
def move(pos, vel, i, time_slice, loss):
    """Lines 58 to 66."""
    vel_angle = math.atan2(vel[i, 1], vel[i, 0])
    old_vel = math.sqrt(vel[i, 0] * vel[i, 0] + vel[i, 1] * vel[i, 1])
    new_vel = old_vel - loss
    if new_vel < 0.0:
        new_vel = 0.0
    cos, sin = math.cos(vel_angle), math.sin(vel_angle)
    vel[i, 0], vel[i, 1] = cos * new_vel, sin * new_vel
    pos[i, 0] += cos * (old_vel + new_vel) / 2 * time_slice
    pos[i, 1] += sin * (old_vel + new_vel) / 2 * time_slice


@compiled
def compute_wall_collisions(pos, vel, i, rad, size, e_bc, mu_bc):
    """Lines 71 to 92."""
    for axis in range(2):
        if pos[i, axis] > size[axis] - rad or pos[i, axis] < rad:
            normal, tangential = vel[i, axis], vel[i, 1 - axis]
            vel[i, axis] = -(normal * e_bc)
            pos[i, axis] = min(max(pos[i, axis], rad), size[axis] - rad)
            slower = tangential - np.sign(tangential) * (mu_bc * abs(vel[i, axis] - normal))
            vel[i, 1 - axis] = slower if np.sign(slower) == np.sign(tangential) else 0.0


@compiled
def compute_ball_collision(pos, vel, mass, a, b, e, mu_bb):
    """Lines 119 to 142, Equations 1 and 2 solved for the two normal velocities."""
    angle = math.atan2(pos[b, 1] - pos[a, 1], pos[b, 0] - pos[a, 0])
    a_n, a_t = rotated(vel[a, 0], vel[a, 1], angle)
    b_n, b_t = rotated(vel[b, 0], vel[b, 1], angle)
    momentum, total = a_n * mass[a] + b_n * mass[b], mass[a] + mass[b]
    new_a_n = (momentum + mass[b] * e * (b_n - a_n)) / total
    new_b_n = (momentum + mass[a] * e * (a_n - b_n)) / total
    new_a_t = slowed(a_t, b_t, mu_bb * (a_n - new_a_n))
    new_b_t = slowed(b_t, a_t, mu_bb * (b_n - new_b_n))
    vel[a, 0], vel[a, 1] = rotated(new_a_n, new_a_t, -angle)
    vel[b, 0], vel[b, 1] = rotated(new_b_n, new_b_t, -angle)


@compiled
def rotated(x, y, angle):
    """Return the row vector (x, y) times the matrix of line 192."""
    cos, sin = math.cos(angle), math.sin(angle)
    return x * cos + y * sin, x * -sin + y * cos


@compiled
def slowed(own, other, loss):
    """Return a tangential velocity after friction (lines 131 to 139)."""
    new = own - np.sign(own - other) * loss
    if np.sign(new) != np.sign(own) and own != 0.0:
        return 0.0
    return new
