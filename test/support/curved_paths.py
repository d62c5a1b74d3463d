"""Paths of constant acceleration, and their points."""

import math

import numpy as np

from pool_sim_ros.physics.motion.curved_path import CurvedPath


def sampled(path, lasts, steps):
    t = np.linspace(0.0, lasts, steps)[:, np.newaxis]
    start, velocity, acceleration = np.reshape(path[:6], (3, 2))
    return t[:, 0], start + t * velocity + 0.5 * t * t * acceleration


def random_path(rng):
    """Return a path that bends a little, much, or turns back on itself."""
    speed, angle = rng.choice([0.0, 0.1, 1.0, 5.0]), rng.uniform(-math.pi, math.pi)
    ux, uy = math.cos(angle), math.sin(angle)
    a, bend = rng.choice([0.0, 0.1, 2.0, 30.0]), rng.choice([0.0, math.pi, rng.uniform(0.0, 6.0)])
    ax, ay = a * math.cos(angle + bend), a * math.sin(angle + bend)
    lasts = rng.choice([1e-6, 0.1, 0.5, 1.5])
    return CurvedPath(*rng.uniform(0.0, 1.0, 2), speed * ux, speed * uy, ax, ay, lasts, False)
