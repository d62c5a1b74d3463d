"""What the benchmarks play."""

import math

import numpy as np

from pool_sim_ros.me212.shots import SHOT_NUMBERS, cue_velocity
from pool_sim_ros.physics import Ball, Table, report_table

RADIUS = 0.02
"""Of the balls on the dense table, m."""

AREA_FRACTION = 0.3
"""The part of the dense table that its balls cover."""


def report_velocities() -> np.ndarray:
    """Return the cue velocities of the report's four shots, (4, 2) m/s."""
    table = report_table()
    return np.array([cue_velocity(number, table) for number in SHOT_NUMBERS])


def random_velocities(shots: int, seed: int = 1) -> np.ndarray:
    """Return cue velocities, (shots, 2): 0.5 to 4 m/s, every direction, both uniform."""
    rng = np.random.default_rng(seed)
    speed = rng.uniform(0.5, 4.0, shots)
    angle = rng.uniform(0.0, 2.0 * math.pi, shots)
    return np.stack([speed * np.cos(angle), speed * np.sin(angle)], axis=1)


def dense_table(count: int, decelerating: bool, seed: int = 1) -> Table:
    """Return a square table with so many equal balls, each at random in a square of its own.

    Without `decelerating` nothing takes energy; with it: mu_ball_surface 0.1, mu_ball_ball 0.05,
    mu_ball_cushion 0.2, every restitution 0.95, the law `coulomb`.
    """
    rng = np.random.default_rng(seed)
    side = math.ceil(math.sqrt(count))
    apart = RADIUS * math.sqrt(math.pi / AREA_FRACTION)
    corners = np.array([(i, j) for i in range(side) for j in range(side)][:count], dtype=float)
    room = apart / 2 - RADIUS
    places = (corners + 0.5) * apart + rng.uniform(-0.95 * room, 0.95 * room, (count, 2))
    balls = [Ball(str(k), 0.1, RADIUS, tuple(place)) for k, place in enumerate(places)]
    friction, e = (0.1, 0.05, 0.2), 0.95
    if not decelerating:
        friction, e = (0.0, 0.0, 0.0), 1.0
    return Table(
        length=side * apart,
        width=side * apart,
        balls=balls,
        mu_ball_surface=friction[0],
        mu_ball_ball=friction[1],
        mu_ball_cushion=friction[2],
        e_cue_ball=e,
        e_ball_ball=e,
        e_ball_cushion=e,
        ball_friction='coulomb',
    )


def dense_velocities(count: int, shots: int, seed: int = 2) -> np.ndarray:
    """Return velocities of all balls, (shots, count, 2): each component normal, 1 m/s."""
    return np.random.default_rng(seed).normal(size=(shots, count, 2))
