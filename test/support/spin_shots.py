"""Batches of random shots of balls that spin, of the kinds that break engines."""

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from spin_soundness import depth_in_balls, depth_in_cushions, pocket_of
from spinning import random_strikes, spinning_table

from pool_sim_ros.physics import Table, pool_table, rack, report_table

MODELS = ('han', 'impulse', 'stronge', 'han', 'mathavan', 'impulse', 'stronge', 'han')
"""Cushion models by batch: the last of the four is slow."""

TRIES = 60
APART = 1.0 + 2.0**-52  # of two diameters: touching, and no overlap


class Batch(NamedTuple):
    """A table, and what `simulate_many` takes of m shots on it."""

    table: Table
    velocities: np.ndarray
    spins: np.ndarray
    places: np.ndarray


def seven_foot(count, number):
    """Return a 7-foot table with so many balls; its cushion model goes by the batch's number."""
    table = pool_table('7ft')
    model = MODELS[number % len(MODELS)]
    return dataclasses.replace(table, balls=table.balls[:count], cushion_model=model)


def plain(count, number):
    """Return the same without pockets."""
    places = [(0.1 + 0.12 * k, 0.3) for k in range(count)]
    return spinning_table(places, cushion_model=MODELS[number % len(MODELS)])


def either(rng, number, least, most):
    """Return a table with pockets or without, with a number of balls within these bounds."""
    count = int(rng.integers(least, most + 1))
    return seven_foot(count, number) if number % 2 else plain(count, number // 2)


def placed(rng, table, shots, propose):
    """Return places (m, n, 2), m at most `shots`, where `propose` puts one ball after another.

    It gets those before, (k, i, 2), and returns (k, 2). Shots without room for a ball drop out.
    """
    places = np.full((shots, len(table.balls), 2), np.nan)
    for i in range(len(table.balls)):
        waiting = np.arange(len(places))
        for _ in range(TRIES):
            trial = propose(places[waiting, :i])
            with_others = np.concatenate([places[waiting, :i], trial[:, None]], axis=1)
            fits = depth_in_cushions(table, trial) <= 1e-12
            fits &= pocket_of(table, trial) < 0
            fits &= depth_in_balls(table, with_others) <= 1e-12
            places[waiting[fits], i] = trial[fits]
            waiting = waiting[~fits]
            if not len(waiting):
                break
        places = np.delete(places, waiting, axis=0)
    return places


def anywhere(rng, table, count):
    radius = table.radii[0]
    return rng.uniform(radius, np.array([table.length, table.width]) - radius, (count, 2))


def beside(rng, table, before):
    """Return places (k, 2) that touch one of the balls before, often in a lattice with it."""
    k = len(before)
    angle = np.where(
        rng.random(k) < 0.5, rng.uniform(0.0, math.tau, k), rng.integers(6, size=k) * math.pi / 3
    )
    way = np.column_stack([np.cos(angle), np.sin(angle)])
    chosen = before[np.arange(k), rng.integers(before.shape[1], size=k)]
    return chosen + 2.0 * table.radii[0] * APART * way


def at_rail(rng, table, places):
    """Return places with one coordinate on a rail."""
    k, radius = len(places), table.radii[0]
    moved, axis = places.copy(), rng.integers(2, size=k)
    size = np.array([table.length, table.width])[axis]
    moved[np.arange(k), axis] = np.where(rng.random(k) < 0.5, radius, size - radius)
    return moved


def in_mouth(rng, table, count):
    """Return places about the mouths of pockets, half of them touching a nose."""
    noses, pockets = table.cushions.noses, table.pockets
    angle = rng.uniform(0.0, math.tau, count)
    way = np.column_stack([np.cos(angle), np.sin(angle)])
    nose = noses[rng.integers(len(noses), size=count)]
    gap = np.where(rng.random(count) < 0.5, 0.0, rng.uniform(0.0, 0.03, count))
    at_nose = nose[:, :2] + (nose[:, 2] + table.radii[0] * APART + gap)[:, None] * way
    pocket = pockets[rng.integers(len(pockets), size=count)]
    near = pocket[:, :2] + (pocket[:, 2] + rng.uniform(0.0, 0.1, count))[:, None] * way
    return np.where((rng.random(count) < 0.6)[:, None], at_nose, near)


def some(rng, chance, one, other):
    """Return rows of `one` with this chance, else of `other`."""
    return np.where((rng.random(len(one)) < chance)[:, None], one, other)


def aimed(rng, places, velocities, chance, targets=None):
    """Turn a part of the velocities to another ball, or to one of the `targets` (q, 2)."""
    k, n = places.shape[:2]
    if n < 2 and targets is None:
        return velocities
    if targets is None:
        target = places[np.arange(k), rng.integers(1, n, size=k)]
    else:
        target = targets[rng.integers(len(targets), size=k)]
    way = target - places[:, 0] + rng.normal(0.0, 0.02, (k, 2))
    way /= np.hypot(*way.T)[:, None]
    return some(rng, chance, np.hypot(*velocities.T)[:, None] * way, velocities)


def report(rng, number, shots):
    given = report_table()
    table = spinning_table(
        given.positions, given.length, given.width, cushion_model=MODELS[number % len(MODELS)]
    )
    velocities, spins = random_strikes(rng, shots, (0.05, 12.0))
    places = np.broadcast_to(table.positions, (shots, *table.positions.shape))
    return Batch(table, aimed(rng, places, velocities, 0.3), spins, places)


def pocket_table(rng, number, shots):
    table = seven_foot(2 + number % 14, number // 14)
    places = placed(rng, table, shots, lambda before: anywhere(rng, table, len(before)))
    velocities, spins = random_strikes(rng, len(places), (0.05, 10.0))
    return Batch(table, aimed(rng, places, velocities, 0.5), spins, places)


def broken(rng, number, shots):
    """Breaks at up to 12 m/s: racks that touch, and jittered ones."""
    table = seven_foot(16, number)
    kind = ('triangle', 'nine_ball', 'eight_ball', 'ten_ball')[number // 2 % 4]
    spacing = 0.0 if number % 2 else 10.0 ** rng.uniform(-5.0, -3.3)
    racks = [
        rack(table, kind, spacing=spacing, seed=int(rng.integers(2**31)) if spacing else None)
        for _ in range(12 if spacing else 1)
    ]
    table = dataclasses.replace(table, balls=racks[0])
    layouts = np.array([[ball.position for ball in balls] for balls in racks])
    places = layouts[rng.integers(len(racks), size=shots)]
    places[:, 0] += rng.uniform(-0.1, 0.1, (shots, 2))
    speed = rng.uniform(1.0, 12.0, shots)
    way = places[:, 1] - places[:, 0] + rng.normal(0.0, 0.02, (shots, 2))
    velocities = speed[:, None] * way / np.hypot(*way.T)[:, None]
    return Batch(table, velocities, random_strikes(rng, shots)[1], places)


def touching(rng, number, shots):
    table = either(rng, number, 2, 10)

    def propose(before):
        free = anywhere(rng, table, len(before))
        free = some(rng, 0.2, at_rail(rng, table, free), free)
        return some(rng, 0.7, beside(rng, table, before), free) if before.shape[1] else free

    places = placed(rng, table, shots, propose)
    velocities, spins = random_strikes(rng, len(places), (0.0, 8.0))
    return Batch(table, aimed(rng, places, velocities, 0.5), spins, places)


def frozen(rng, number, shots):
    """Balls at rails, some of them touching another one there; the cue ball runs along or away."""
    table = either(rng, number, 1, 8)

    def propose(before):
        free = anywhere(rng, table, len(before))
        if before.shape[1]:
            free = some(rng, 0.3, beside(rng, table, before), free)
        return some(rng, 0.7, at_rail(rng, table, free), free)

    places = placed(rng, table, shots, propose)
    velocities, spins = random_strikes(rng, len(places), (0.0, 8.0))
    along = rng.integers(2, size=len(places))
    straight = velocities.copy()
    straight[np.arange(len(places)), along] = 0.0
    velocities = some(rng, 0.4, straight, aimed(rng, places, velocities, 0.5))
    return Batch(table, velocities, spins * (1.0 + 9.0 * (number % 7 == 3)), places)


def jaws(rng, number, shots):
    """Balls about the mouths of pockets, and strikes at them or at the pockets."""
    table = seven_foot(int(rng.integers(1, 9)), number)
    places = placed(
        rng,
        table,
        shots,
        lambda before: some(
            rng,
            0.8 if before.shape[1] else 0.5,
            in_mouth(rng, table, len(before)),
            anywhere(rng, table, len(before)),
        ),
    )
    velocities, spins = random_strikes(rng, len(places), (0.0, 8.0))
    velocities = aimed(rng, places, velocities, 0.4)
    return Batch(table, aimed(rng, places, velocities, 0.4, table.pockets[:, :2]), spins, places)


def masse(rng, number, shots):
    """High spins at low speeds: 300 rad/s, in some batches 3000."""
    table = either(rng, number, 1, 6)

    def propose(before):
        free = anywhere(rng, table, len(before))
        free = some(rng, 0.2, at_rail(rng, table, free), free)
        return some(rng, 0.2, beside(rng, table, before), free) if before.shape[1] else free

    places = placed(rng, table, shots, propose)
    spin = 3000.0 if number % 10 == 9 else 300.0
    velocities, spins = random_strikes(rng, len(places), (0.0, 1.0), spin)
    return Batch(table, velocities, spins, places)


KINDS = {
    'report': report,
    'seven-foot': pocket_table,
    'breaks': broken,
    'touching': touching,
    'frozen': frozen,
    'jaws': jaws,
    'masse': masse,
}
