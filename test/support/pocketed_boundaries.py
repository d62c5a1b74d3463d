"""Boundaries with pockets, plain twins of what is asked of them, and paths of balls there."""

import functools
import math

import numpy as np
from numba import njit

from pool_sim_ros.physics.boundary import (
    FIRST_CUSHION,
    PHASE_END,
    cushion_gap,
    cushion_normal,
    distance_to_mouths,
    from_cushion_axes,
    is_outside,
    pocket_at,
    pocketed_boundary,
    put_on_cushion,
    time_to_cushions,
    to_cushion_axes,
    touches_cushion,
)
from pool_sim_ros.physics.boundary.surroundings import STRETCH, WITHIN
from pool_sim_ros.physics.motion.curved_path import CurvedPath
from pool_sim_ros.physics.pool_tables import pool_table_dimensions

NAMES = ('7ft', '9ft')
"""The noses of the first are round, those of the second are points."""


@functools.cache
def boundary_of(name):
    given = pool_table_dimensions(name)
    size = given.length, given.width
    cushions = given.cushions
    return (
        pocketed_boundary(
            size,
            np.array(cushions.segments),
            np.array(cushions.noses),
            np.array(given.pockets),
            given.ball_radius,
        ),
        given.ball_radius,
    )


@njit
def first_met(boundary, path, radius):
    return time_to_cushions(boundary, path, radius)


@njit
def asked(boundary, x, y, radius, reach, but):
    """Return what a boundary says of a place."""
    return (
        is_outside(boundary, x, y, radius, 1e-9),
        touches_cushion(boundary, x, y, reach, but),
        pocket_at(boundary, x, y),
        distance_to_mouths(boundary, x, y),
    )


@njit
def gap_and_normal(boundary, cushion, x, y, radius):
    return (
        cushion_gap(boundary, cushion, x, y, radius),
        cushion_normal(boundary, cushion, x, y),
        put_on_cushion(boundary, cushion, x, y, radius),
    )


@njit
def there_and_back(boundary, cushion, normal, v):
    parts = to_cushion_axes(boundary, cushion, normal, v)
    return parts, from_cushion_axes(boundary, cushion, normal, parts)


def heights(boundary, points):
    """Return how far points (k, 2) are before each segment, and whether they face it, (k, s)."""
    starts, ends = boundary.segments[:, :2], boundary.segments[:, 2:4]
    relative = points[:, np.newaxis] - starts
    along = np.sum(relative * (ends - starts), axis=-1)
    facing = (along >= 0.0) & (along <= np.sum((ends - starts) ** 2, axis=-1))
    return np.sum(relative * boundary.segments[:, 4:], axis=-1), facing


def distances(circles, points):
    """Return how far points (k, 2) are from the edges of circles, (k, c)."""
    between = points[:, np.newaxis] - circles[:, :2]
    return np.hypot(between[..., 0], between[..., 1]) - circles[:, 2]


def all_gaps(boundary, points, radius):
    """Return the gaps to all cushions and pockets, (k, c), inf where a segment is not faced."""
    height, facing = heights(boundary, points)
    return np.hstack(
        [
            np.where(facing, height - radius, np.inf),
            distances(boundary.noses, points) - radius,
            distances(boundary.pockets, points),
        ]
    )


def places(path, times):
    t = np.atleast_1d(times)[:, np.newaxis]
    start, velocity, acceleration = np.reshape(path[:6], (3, 2))
    return start + t * velocity + 0.5 * t * t * acceleration


def search(boundary, path, radius, steps=4000):
    """Return the first time at which a gap closes, from a fine search, and its partner.

    None where a step is too coarse to tell.
    """
    times = np.linspace(0.0, path.lasts, steps)
    points = places(path, times)
    gaps = all_gaps(boundary, points, radius)
    # A nose that is not faced any more: the segment beside it ends where it begins.
    height, _ = heights(boundary, points)
    line = np.hstack([height - radius, gaps[:, height.shape[1] :]])
    closes = (line[:-1] >= 0.0) & (line[1:] < 0.0) & (gaps[1:] < 0.0)
    step = np.argmax(closes.any(axis=1))
    # How far it goes in two steps: a graze of so little may fall between them.
    stride = 2.0 * np.hypot(*np.diff(points, axis=0).T).max()
    before = slice(0, step + 1) if closes.any() else slice(None)
    near = (np.abs(gaps[before]) < stride**2 / radius + 1e-9).any()
    if not closes.any():
        return None if near else (math.inf, PHASE_END)
    partner = int(np.argmax(closes[step]))
    others = np.delete(np.abs(gaps[before]), partner, axis=1)
    if closes[step].sum() > 1 or (others < 2.0 * stride).any():
        return None
    low, high = times[step], times[step + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        if all_gaps(boundary, places(path, middle), radius)[0, partner] < 0.0:
            high = middle
        else:
            low = middle
    return high, FIRST_CUSHION - partner


def starts(rng, boundary, radius, count):
    """Yield places where a ball may be: anywhere, in a mouth, and frozen on a rail."""
    size = np.array([boundary.length, boundary.width])
    while count > 0:
        kind = rng.integers(3)
        spot = rng.uniform(radius, size - radius)
        if kind == 1:
            x, y, reach = boundary.pockets[rng.integers(len(boundary.pockets))]
            angle = rng.uniform(-math.pi, math.pi)
            spot = (x, y) + reach * rng.uniform(1.0, 2.0) * np.array(
                [math.cos(angle), math.sin(angle)]
            )
        elif kind == 2:
            axis = rng.integers(2)
            spot[axis] = rng.choice([radius, size[axis] - radius])
        gaps = all_gaps(boundary, spot[np.newaxis], radius)[0]
        if gaps.min() >= -1e-12 and (0.0 <= spot).all() and (spot <= size).all():
            count -= 1
            yield spot


def paths(rng, boundary, radius, count):
    """Yield paths of balls that slide or roll, from such places."""
    for spot in starts(rng, boundary, radius, count):
        speed, angle = rng.choice([0.05, 0.5, 3.0]), rng.uniform(-math.pi, math.pi)
        if rng.random() < 0.3:  # towards a pocket
            x, y = boundary.pockets[rng.integers(len(boundary.pockets)), :2] - spot
            angle = math.atan2(y, x) + rng.normal(0.0, 0.05)
        velocity = speed * np.array([math.cos(angle), math.sin(angle)])
        if rng.random() < 0.5:
            slowing, lasts = -0.0980665 * velocity / speed, speed / 0.0980665
        else:
            angle = rng.uniform(-math.pi, math.pi)
            slowing = 1.96133 * np.array([math.cos(angle), math.sin(angle)])
            lasts = rng.uniform(0.05, 1.5)
        yield CurvedPath(*spot, *velocity, *slowing, lasts, bool(lasts > 1.5))


def looked_at_whole(boundary):
    """Return a boundary of which every part is looked at every time."""
    rows = boundary.rows.copy()
    rows[: boundary.n_segments, STRETCH : STRETCH + 4] = np.inf, -np.inf, np.inf, -np.inf
    rows[boundary.n_cushions : boundary.n_parts, WITHIN] = -1.0
    return boundary._replace(inner=np.inf, rows=rows)


def sides(boundary):
    """Return the sides on which the segments lie, -1 for a jaw."""
    found = np.full(boundary.n_segments, -1)
    for side, rails in enumerate(boundary.rows[boundary.n_parts :]):
        found[rails[: list(rails).index(-1.0)].astype(int)] = side
    return found


def stretches(boundary):
    """Return the boxes in which a ball on a rail touches nothing else."""
    return boundary.rows[: boundary.n_segments, STRETCH : STRETCH + 4]
