"""Balls that touch, of very different masses, and shots that begin among them."""

import numpy as np

from pool_sim_ros.physics import Ball, Table

RADIUS = 0.03
RESTITUTIONS = (0.0, 0.1, 0.5, 0.9, 1.0)


def line(rng, n):
    """Return places of a line of touching balls, in a corner, along a cushion or in the middle."""
    start = np.array([rng.choice([RADIUS, 0.2]), rng.choice([RADIUS, 0.5])])
    angle = rng.choice([0.0, 0.3])
    return start + 2 * RADIUS * np.arange(n)[:, np.newaxis] * (np.cos(angle), np.sin(angle))


def heap(rng, n):
    """Return some of the places of a triangular grid, most of them touching."""
    i, j = np.divmod(np.arange(16), 4)
    rows = np.column_stack([2 * RADIUS * (i + j / 2), np.sqrt(3) * RADIUS * j])
    corner = (RADIUS, RADIUS) if rng.random() < 0.5 else (0.3, 0.4)
    return corner + rows[rng.permutation(16)[:n]]


def crowded_table(rng, mass_ratio, law='coulomb', most=12):
    """Return a table of 1 m x 1 m on which balls touch, with masses up to a ratio."""
    n = int(rng.integers(2, most + 1))
    places = (line if rng.random() < 0.4 else heap)(rng, n)
    masses = 0.01 * mass_ratio ** rng.random(n)
    e_cue_ball, e_ball_ball, e_ball_cushion = rng.choice(RESTITUTIONS, 3)
    balls = [
        Ball(str(i), float(m), RADIUS, tuple(map(float, p)), is_cue=i == 0)
        for i, (m, p) in enumerate(zip(masses, places, strict=True))
    ]
    return Table(
        1.0,
        1.0,
        balls,
        mu_ball_ball=float(rng.choice([0.0, 0.06])),
        mu_ball_surface=float(rng.choice([0.02, 0.1])),
        e_cue_ball=float(e_cue_ball),
        e_ball_ball=float(e_ball_ball),
        e_ball_cushion=float(e_ball_cushion),
        ball_friction=law,
    )


def strikes(rng, table, shots):
    """Return velocities for so many shots, (m, n, 2): the cue ball's, several, or all."""
    n = len(table.balls)
    velocities = rng.normal(0.0, 2.0, (shots, n, 2))
    alone = rng.random((shots, n, 1)) < rng.choice([0.0, 0.5, 1.0], (shots, 1, 1))
    alone[:, 0] = False
    return np.where(alone, 0.0, velocities)
