"""Shots that never end because each contact adds energy, as the report's law of friction can.

Its second ball gains slip by friction, without a bound. Beside enough restitution and too little
other loss, the balls then meet ever faster, infinitely often in finite time.
"""

import numpy as np

from pool_sim_ros.physics.jit import inlined

GAIN = 100.0
"""A shot is given up when one ball has this many times the energy that all had at first."""

SLOWEST = 1e-2
"""Speed in m/s as which slower ones count here: weak contacts may add some energy of their own."""


@inlined
def most_energy(balls, world, velocities):
    """Return twice the kinetic energy in J with which a ball runs away.

    `velocities`, (n or 1, 2) in m/s, are those of the first balls at the start.
    """
    if world.coulomb:
        return np.inf
    total = 0.0
    for i in range(len(velocities)):
        vx, vy = velocities[i, 0], velocities[i, 1]
        total += max(vx * vx + vy * vy, SLOWEST * SLOWEST) / balls[i].inverse_mass
    return GAIN * total


@inlined
def runs_away(speed, inverse_mass, most):
    """Return whether a ball at `speed`, m/s, has more than `most`; see `most_energy`."""
    return speed * speed > most * inverse_mass
