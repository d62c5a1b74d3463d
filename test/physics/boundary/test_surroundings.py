"""What is near rails and pockets: nothing else is ever touched there."""

import math

import numpy as np
import pytest
from pocketed_boundaries import (
    NAMES,
    all_gaps,
    asked,
    boundary_of,
    looked_at_whole,
    sides,
    stretches,
)

from pool_sim_ros.physics.boundary import (
    n_cushions,
    pocketed_boundary,
)
from pool_sim_ros.physics.boundary.surroundings import AROUND, WITHIN
from pool_sim_ros.physics.pool_tables import pool_table_dimensions


@pytest.mark.parametrize('name', NAMES)
def test_the_tables_have_an_inner_rectangle(name):
    boundary, radius = boundary_of(name)
    assert boundary.inner == radius
    assert sorted(set(sides(boundary).tolist())) == [-1, 0, 1, 2, 3]
    assert np.sum(sides(boundary) >= 0) == 6


@pytest.mark.parametrize('name', NAMES)
def test_a_ball_on_a_rail_is_touched_by_the_same_things(name):
    """All along each rail, and hairs beside the places where something else begins to touch."""
    boundary, radius = boundary_of(name)
    plain, reach = looked_at_whole(boundary), radius + 1e-9
    rng = np.random.default_rng(8)
    alone = told = 0
    for k in np.flatnonzero(sides(boundary) >= 0).tolist():
        start, end, normal = np.split(boundary.segments[k], [2, 4])
        shares = np.concatenate([rng.uniform(-0.1, 1.1, 300), [0.0, 1.0] * 50])
        shares[300:] += rng.choice([0.0, 1e-9, 1e-6, 1e-3], 100) * rng.choice([-1.0, 1.0], 100)
        for share in shares.tolist():
            gap = rng.choice([-9e-10, 0.0, 9e-10])
            spot = start + share * (end - start) + (radius + gap) * normal
            found = asked(boundary, *spot, radius, reach, k)[1]
            assert found == asked(plain, *spot, radius, reach, k)[1], (k, share)
            told += found
            box = stretches(boundary)[k]
            alone += bool(box[0] <= spot[0] <= box[1] and box[2] <= spot[1] <= box[3])
    assert told > 50 and alone > 1000


def test_a_rail_beside_which_something_stands_has_no_stretch_of_its_own():
    given = pool_table_dimensions('7ft')
    cushions, size = given.cushions, (given.length, given.width)
    segments, pockets = np.array(cushions.segments), np.array(given.pockets)
    boundary, radius = boundary_of('7ft')
    rails = np.flatnonzero(sides(boundary) >= 0)
    assert np.isfinite(stretches(boundary)[rails]).all()
    assert np.isinf(stretches(boundary)[sides(boundary) < 0]).all()
    k = rails[0]
    middle = 0.5 * (segments[k, :2] + segments[k, 2:4])
    post = np.append(middle, 0.0)  # flush with the rail: a ball there touches both
    for more in (dict(noses=[post]), dict(segments=[segments[k]])):
        changed = pocketed_boundary(
            size,
            np.vstack([segments, *more.get('segments', [])]),
            np.vstack([cushions.noses, *more.get('noses', [])]),
            pockets,
            radius,
        )
        assert changed.inner == radius and np.isinf(stretches(changed)[k]).all()
        spot = middle + radius * segments[k, 4:]
        assert asked(changed, *spot, radius, radius + 1e-9, k)[1]


@pytest.mark.parametrize('name', NAMES)
def test_around_a_pocket_is_all_that_is_near(name):
    boundary, radius = boundary_of(name)
    rng = np.random.default_rng(9)
    for q, (x, y, _) in enumerate(boundary.pockets):
        pocket = boundary.rows[boundary.n_cushions + q]
        listed = set(pocket[AROUND:].tolist()) - {-1}
        n = n_cushions(boundary)
        assert n + q in listed and len(listed) < 12
        angle, away = rng.uniform(0.0, 7.0, 4000), pocket[WITHIN] * rng.random(4000) ** 0.5
        points = np.column_stack([x + away * np.cos(angle), y + away * np.sin(angle)])
        gaps = all_gaps(boundary, points, radius)  # what is far behind a segment is not near it
        met = np.flatnonzero(((gaps <= 0.0) & (gaps >= -2.0 * radius)).any(axis=0))
        assert set(met.tolist()) <= listed and len(met) > 4


@pytest.mark.parametrize(
    'change',
    [
        lambda s, n, p: (s, np.vstack([n, [0.9, 0.5, 0.01]]), p),
        lambda s, n, p: (s, n, np.vstack([p, [0.9, 0.5, 0.01]])),
        lambda s, n, p: (np.vstack([s, [0.9, 0.4, 0.9, 0.6, 1.0, 0.0]]), n, p),
        lambda s, n, p: (np.vstack([s, [-0.5, 0.5, 3.0, 0.5, 0.0, 1.0]]), n, p),
    ],
)
def test_what_stands_in_the_inner_rectangle_switches_it_off(change):
    boundary, radius = boundary_of('7ft')
    size = boundary.length, boundary.width
    changed = change(boundary.segments, boundary.noses, boundary.pockets)
    assert pocketed_boundary(size, *changed, radius).inner == math.inf
