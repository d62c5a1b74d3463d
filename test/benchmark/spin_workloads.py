"""What the benchmarks play with balls that spin."""

from __future__ import annotations

import dataclasses
import functools
import math

import numpy as np
from benchmark.ask_pooltool import Shots
from benchmark.workloads import random_velocities
from numpy.typing import NDArray

from pool_sim_ros.physics import Table, pool_table, rack, report_table

Array = NDArray[np.float64]

REPORT = "the report's table"
TEN, TEN_WITH_POCKETS = 'ten balls on 7 feet, no pockets', 'ten balls on 7 feet, with pockets'
NINE, FIFTEEN = 'break of 9', 'break of 15'
NAMES = (REPORT, TEN, TEN_WITH_POCKETS, NINE, FIFTEEN)

MOST_OFFSET = 0.5
"""How far from the middle the tip meets the ball at most, in radii: farther out it slips."""

BREAK_SPEEDS = (5.0, 10.0)
"""m/s."""

AIM = math.radians(0.2)
"""Standard deviation of the direction of a break."""


@functools.cache
def table_of(name: str) -> Table:
    """Return the table of a workload, with coefficients and laws that pooltool has too."""
    if name == REPORT:
        return _report()
    table = dataclasses.replace(pool_table('7ft'), friction_bound='restitution')
    if name in (TEN, TEN_WITH_POCKETS):
        table = dataclasses.replace(table, balls=table.balls[:10])
    if name == TEN:
        table = dataclasses.replace(table, cushions=None, pockets=())
    if name == NINE:
        table = dataclasses.replace(table, balls=rack(table, 'nine_ball'))
    return table


def _report() -> Table:
    """Return the report's size and places, its balls of one mass and with a pool ball's laws."""
    given, pool = report_table(), pool_table('7ft')
    radius = given.balls[0].radius
    laws = ('e_cue_ball', 'e_ball_ball', 'e_ball_cushion', 'mu_slide', 'mu_roll', 'ball_friction')
    share = radius / pool.balls[0].radius
    return dataclasses.replace(
        given,
        motion='ball',
        balls=[dataclasses.replace(ball, mass=0.16) for ball in given.balls],
        mu_spin=share * pool.mu_spin,
        nose_height=share * pool.nose_height,
        friction_bound='restitution',
        **{law: getattr(pool, law) for law in laws},
    )


def shots_of(name: str, count: int, seed: int = 1) -> Shots:
    """Return so many shots of a workload."""
    rng = np.random.default_rng(seed)
    table = table_of(name)
    if name in (NINE, FIFTEEN):
        places = np.array([_racked(name, seed + k) for k in range(count)])
        way = places[:, 1] - places[:, 0]
        angles = np.arctan2(way[:, 1], way[:, 0]) + rng.normal(0.0, AIM, count)
        velocities = along(angles, rng.uniform(*BREAK_SPEEDS, count))
    else:
        velocities = random_velocities(count, seed)
        places = np.tile(table.positions, (count, 1, 1))
        if name != REPORT:
            places = np.array([_anywhere(table, rng) for _ in range(count)])
    every_velocity = np.zeros((count, len(table.balls), 2))
    every_spin = np.zeros((count, len(table.balls), 3))
    every_velocity[:, 0] = velocities
    every_spin[:, 0] = spins_for(velocities, table, rng)
    return Shots(places, every_velocity, every_spin)


def strikes(shots: Shots) -> dict[str, Array]:
    """Return what `simulate_many` is given: velocities and spins of the cue balls, and layouts."""
    return dict(
        velocities=shots.velocities[:, 0].copy(),
        spins=shots.spins[:, 0].copy(),
        positions=shots.positions,
    )


def _racked(name: str, seed: int) -> list[tuple[float, float]]:
    """Return places of a rack with a mean gap of 0.1 mm, each its own."""
    kind = 'nine_ball' if name == NINE else 'eight_ball'
    return [ball.position for ball in rack(table_of(name), kind, seed=seed)]


def _anywhere(table: Table, rng: np.random.Generator) -> Array:
    """Return places of all balls within the rails, evenly, none in another."""
    radius = table.balls[0].radius
    places: list[Array] = []
    while len(places) < len(table.balls):
        place = rng.uniform(radius, (table.length - radius, table.width - radius))
        if all(math.dist(place, other) > 2.0 * radius for other in places) and _fits(table, place):
            places.append(place)
    return np.array(places)


def _fits(table: Table, place: Array) -> bool:
    """Return whether a ball lies clear of noses and pockets."""
    if table.cushions is None:
        return True
    radius = table.balls[0].radius
    noses, pockets = table.cushions.noses, table.pockets
    clear = np.hypot(*(noses[:, :2] - place).T) > noses[:, 2] + radius
    out = np.hypot(*(pockets[:, :2] - place).T) > pockets[:, 2]
    return bool(clear.all() and out.all())


def along(angles: Array, speeds: Array) -> Array:
    return np.stack([speeds * np.cos(angles), speeds * np.sin(angles)], axis=1)


def spins_for(velocities: Array, table: Table, rng: np.random.Generator) -> Array:
    """Return the spins that a level cue gives, its tip anywhere within `MOST_OFFSET`, evenly."""
    count = len(velocities)
    away = MOST_OFFSET * np.sqrt(rng.uniform(0.0, 1.0, count))
    turn = rng.uniform(0.0, 2.0 * math.pi, count)
    side, above = away * np.cos(turn), away * np.sin(turn)
    per_radius = 2.5 / table.balls[0].radius
    vx, vy = velocities.T
    return per_radius * np.stack([-vy * above, vx * above, -np.hypot(vx, vy) * side], axis=1)
