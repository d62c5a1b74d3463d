"""Tables on which balls spin, and shots on them."""

import dataclasses
import math

import numpy as np

from pool_sim_ros.physics import Ball, Table

RADIUS = 0.028575
COEFFICIENTS = dict(
    mu_ball_ball=0.05,
    mu_ball_cushion=0.2,
    e_cue_ball=0.95,
    e_ball_ball=0.95,
    e_ball_cushion=0.85,
    ball_friction='coulomb',
    mu_slide=0.2,
    mu_roll=0.01,
    mu_spin=0.0127,
    nose_height=0.036576,
)


def spinning_table(places, length=1.9812, width=0.9906, masses=None, radius=RADIUS, **fields):
    """Return a plain rectangle with balls at these places, m, the first of them the cue ball."""
    masses = [0.17] * len(places) if masses is None else masses
    balls = [
        Ball(str(k), masses[k], radius, tuple(place), is_cue=k == 0)
        for k, place in enumerate(places)
    ]
    return Table(length, width, balls, motion='ball', **(COEFFICIENTS | fields))


def oracle_table(shot):
    """Return the table of a shot of oracle.json."""
    given = shot['parameters']
    law, *numbers = given['friction']
    return spinning_table(
        shot['places'],
        given['length'],
        given['width'],
        radius=given['R'],
        mu_ball_ball=numbers[0] if law == 'constant' else 0.05,
        mu_ball_cushion=given['f_c'],
        e_cue_ball=given['e_b'],
        e_ball_ball=given['e_b'],
        e_ball_cushion=given['e_c'],
        gravity=given['g'],
        ball_friction='coulomb' if law == 'constant' else 'alciatore',
        mu_slide=given['u_s'],
        mu_roll=given['u_r'],
        mu_spin=given['u_sp'],
        nose_height=given['h'],
        cushion_model=given['cushion'],
        friction_bound={'pooltool': 'restitution', 'physical': 'impulse'}[given['impulse']],
    )


def strikes_of(shot):
    """Return velocities (n, 2) and spins (n, 3) of a shot of oracle.json."""
    rows = np.zeros((len(shot['places']), 5))
    rows[: len(shot['strikes'])] = shot['strikes']
    return rows[:, :2], rows[:, 2:]


def random_strikes(rng, shots, speeds=(0.05, 8.0), spin=100.0):
    """Return velocities (shots, 2) in every direction, m/s, and spins (shots, 3), rad/s."""
    speed, angle = rng.uniform(*speeds, shots), rng.uniform(-math.pi, math.pi, shots)
    velocities = np.column_stack([speed * np.cos(angle), speed * np.sin(angle)])
    return velocities, rng.normal(0.0, spin, (shots, 3))


def scattered(rng, table, touching=0.0):
    """Return places (n, 2) of its balls; the given part of them touches another ball or a rail."""
    radius = table.balls[0].radius
    low, high = np.full(2, radius), np.array([table.length, table.width]) - radius
    places = []
    while len(places) < len(table.balls):
        place = rng.uniform(low, high)
        if places and rng.random() < touching:
            angle = rng.choice([rng.uniform(-math.pi, math.pi), rng.integers(6) * math.pi / 3])
            way = np.array([math.cos(angle), math.sin(angle)])
            place = places[rng.integers(len(places))] + 2.0 * radius * (1.0 + 2.0**-52) * way
        if rng.random() < touching / 2:
            axis = rng.integers(2)
            place[axis] = rng.choice([low[axis], high[axis]])
        trial = dataclasses.replace(table.balls[0], position=tuple(place))
        if fits(table, trial, places):
            places.append(place)
    return np.array(places)


def fits(table, ball, places):
    """Return whether a ball lies on the table and in none of the others."""
    if any(np.hypot(*(ball.position - place)) < 2.0 * ball.radius - 1e-12 for place in places):
        return False
    try:
        dataclasses.replace(table, balls=(ball,))
    except ValueError:
        return False
    return True
