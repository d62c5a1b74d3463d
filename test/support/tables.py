"""Tables and shots that the physics tests share."""

import dataclasses
import math

import numpy as np

from pool_sim_ros.physics import Ball, Table, report_table

LAWS = ('report', 'coulomb')


def table_of(positions, length=2.0, width=1.0, radius=0.05, mass=0.16, **fields):
    """Return a table with equal balls, the first of them the cue ball."""
    balls = [
        Ball(label=str(k), mass=mass, radius=radius, position=tuple(position), is_cue=k == 0)
        for k, position in enumerate(positions)
    ]
    return Table(length=length, width=width, balls=balls, **fields)


def random_table(rng, count, ball_friction='coulomb', **fields):
    """Return a table with `count` balls of unequal mass and radius at random places."""
    radii = rng.uniform(0.02, 0.06, count)
    masses = rng.uniform(0.05, 0.4, count)
    coefficients = dict(
        mu_ball_ball=rng.uniform(0.0, 0.3),
        mu_ball_surface=rng.uniform(0.02, 0.3),
        mu_ball_cushion=rng.uniform(0.0, 0.4),
        e_cue_ball=rng.uniform(0.3, 1.0),
        e_ball_ball=rng.uniform(0.3, 1.0),
        e_ball_cushion=rng.uniform(0.3, 1.0),
    )
    coefficients.update(fields)
    length, width = rng.uniform(1.0, 2.5), rng.uniform(0.6, 1.5)
    positions = random_layout(rng, radii, length, width)
    balls = [
        Ball(str(k), masses[k], radii[k], tuple(positions[k]), is_cue=k == 0) for k in range(count)
    ]
    return Table(length, width, balls, ball_friction=ball_friction, **coefficients)


def random_layout(rng, radii, length, width):
    """Return positions (n, 2) at which no ball touches another."""
    placed = []
    for radius in radii:
        for _ in range(10_000):
            spot = rng.uniform(radius, (length - radius, width - radius))
            near = (
                math.dist(spot, other) <= radius + other_radius
                for other, other_radius in zip(placed, radii, strict=False)
            )
            if not any(near):
                break
        else:
            raise RuntimeError('no room for another ball')
        placed.append(spot)
    return np.array(placed)


def random_velocity(rng, slowest=0.2, fastest=6.0):
    speed, angle = rng.uniform(slowest, fastest), rng.uniform(-math.pi, math.pi)
    return speed * np.array([math.cos(angle), math.sin(angle)])


def random_shots(seed, count, law, balls=6, fastest=3.0, **fields):
    """Yield tables with balls that all move, and their velocities."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        table = random_table(rng, balls, law, **fields)
        yield table, np.array([random_velocity(rng, 0.1, fastest) for _ in table.balls])


def report_shots():
    """Return the four cue velocities of Listing 2, lines 60 to 65."""
    cue, nearest = (np.array(ball.position) for ball in report_table().balls[:2])
    toward = math.atan2(*(nearest - cue)[::-1])
    return [
        (-math.cos(0.0) * 4, math.sin(0.0) * 4),
        (-math.cos(math.radians(15)) * 2.5, math.sin(math.radians(15)) * 2.5),
        (-math.cos(math.radians(30)) * 1.5, math.sin(math.radians(30)) * 1.5),
        (math.cos(toward) * 1.5, math.sin(toward) * 1.5),
    ]


def under(table, **fields):
    return dataclasses.replace(table, **fields)


def kinetic_energy(table, velocities):
    """Energy in J; velocities (..., n, 2)."""
    return 0.5 * np.sum(table.masses[:, None] * np.square(velocities), axis=(-2, -1))


def worst_overlap(table, positions):
    """Return how deep (m) any ball is in another or in a cushion; positions (k, n, 2)."""
    positions, radii = np.asarray(positions), table.radii
    size = np.array([table.length, table.width])
    low = np.max(radii[:, None] - positions)
    high = np.max(positions + radii[:, None] - size)
    worst = max(float(low), float(high))
    first, second = np.triu_indices(len(radii), 1)
    if len(first):
        gaps = np.linalg.norm(positions[:, first] - positions[:, second], axis=-1)
        worst = max(worst, float(np.max(radii[first] + radii[second] - gaps)))
    return worst
