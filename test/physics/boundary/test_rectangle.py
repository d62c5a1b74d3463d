"""The report's rectangle against the obvious."""

import itertools
import math

import naive
import numpy as np
import pytest
from numba import njit
from seams import chosen_functions

from pool_sim_ros.physics import boundary
from pool_sim_ros.physics.boundary import (
    FIRST_CUSHION,
    PHASE_END,
    Rectangle,
    cushion_gap,
    cushion_normal,
    cushion_of_partner,
    distance_to_cushions,
    from_cushion_axes,
    is_outside,
    n_cushions,
    partner_of_cushion,
    to_cushion_axes,
    touches_cushion,
)

LENGTH, WIDTH = 2.0, 1.0
TABLE = Rectangle(LENGTH, WIDTH)
NORMALS = [(-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)]
NASTY = (-1e300, -1.0, -1e-300, 0.0, 1e-12, 0.05, 0.5, 0.95, 1.0, 1.95, 2.0, math.inf, math.nan)


@njit
def first_cushion(boundary, x, y, ux, uy, radius):
    return distance_to_cushions(boundary, x, y, ux, uy, radius)


@njit
def there_and_back(boundary, cushion, v):
    normal = cushion_normal(boundary, cushion, 0.5, 0.5)
    parts = to_cushion_axes(boundary, cushion, normal, v)
    return parts, from_cushion_axes(boundary, cushion, normal, parts)


def points(rng, count):
    return rng.uniform((-0.2, -0.2), (LENGTH + 0.2, WIDTH + 0.2), (count, 2))


def gap_of(cushion, x, y, radius):
    """How far the edge of a ball is from the line of a cushion, by its outward normal."""
    nx, ny = NORMALS[cushion]
    wall = max(0.0, nx * LENGTH + ny * WIDTH)
    return wall - (nx * x + ny * y) - radius


def test_there_is_one_implementation_of_each_function():
    declared = chosen_functions(boundary)
    assert len(declared) == 16
    for function in declared.values():
        assert list(function.implementations).count(Rectangle) == 1


def test_partners_and_cushions_are_each_other_s_inverse():
    partners = [partner_of_cushion(cushion) for cushion in range(50)]
    assert partners[0] == FIRST_CUSHION
    assert [cushion_of_partner(partner) for partner in partners] == list(range(50))
    assert PHASE_END not in partners and max(partners) < 0 and len(set(partners)) == 50


def test_four_cushions_and_their_normals():
    assert n_cushions(TABLE) == 4
    for cushion in range(4):
        assert cushion_normal(TABLE, cushion, 0.3, 0.4) == NORMALS[cushion]


def test_gaps():
    for x, y in points(np.random.default_rng(1), 300):
        for cushion in range(4):
            found = cushion_gap(TABLE, cushion, x, y, 0.05)
            assert found == pytest.approx(gap_of(cushion, x, y, 0.05), abs=1e-15)


def test_the_first_cushion_on_a_path():
    rng = np.random.default_rng(2)
    met = set()
    for x, y in rng.uniform(0.05, (LENGTH - 0.05, WIDTH - 0.05), (500, 2)):
        angle = rng.choice([rng.uniform(-math.pi, math.pi), 0.0])
        ux, uy = math.cos(angle), math.sin(angle)
        distances = [
            naive.time_to_cushion((x, y), (ux, uy), 0.05, cushion, LENGTH, WIDTH, 0.0)
            for cushion in range(4)
        ]
        distance, partner = first_cushion(TABLE, x, y, ux, uy, 0.05)
        assert distance == pytest.approx(min(distances), abs=1e-12)
        assert cushion_of_partner(partner) == int(np.argmin(distances))
        met.add(cushion_of_partner(partner))
    assert met == {0, 1, 2, 3}


@pytest.mark.parametrize('direction', [(1, 0), (-1, 0), (0, 1), (0, -1)])
def test_along_an_axis_only_one_cushion_counts(direction):
    ux, uy = map(float, direction)
    distance, partner = first_cushion(TABLE, 0.5, 0.5, ux, uy, 0.05)
    expected = {(1, 0): (1.45, 1), (-1, 0): (0.45, 0), (0, 1): (0.45, 3), (0, -1): (0.45, 2)}
    assert (distance, cushion_of_partner(partner)) == pytest.approx(expected[direction])


def test_a_ball_that_does_not_move_meets_nothing():
    assert first_cushion(TABLE, 0.5, 0.5, 0.0, 0.0, 0.05) == (math.inf, PHASE_END)


def test_a_ball_that_is_in_a_cushion_by_rounding_meets_it_now():
    for depth in (0.0, 1e-16, 1e-12, 9e-10):
        assert first_cushion(TABLE, 0.05 - depth, 0.5, -1.0, 0.0, 0.05) == (0.0, FIRST_CUSHION)
        distance, partner = first_cushion(TABLE, 0.05 - depth, 0.5, 1.0, 0.0, 0.05)
        assert distance > 1.0 and cushion_of_partner(partner) == 1


@pytest.mark.parametrize('cushion', range(4))
def test_cushion_axes_there_and_back(cushion):
    rng = np.random.default_rng(3)
    nasty = itertools.product((0.0, -0.0, 1e-300, 1.0, -3.0), repeat=2)
    for v in [*map(tuple, rng.normal(size=(50, 2))), *nasty]:
        parts, back = there_and_back(TABLE, cushion, v)
        assert back == v and np.signbit(back).tolist() == np.signbit(v).tolist()
        assert abs(parts[0]) == abs(np.dot(v, NORMALS[cushion]))
        assert sorted(map(abs, parts)) == sorted(map(abs, v))


@pytest.mark.parametrize('but', [-7, -1, 0, 1, 2, 3])
def test_what_touches(but):
    rng = np.random.default_rng(4)
    found = 0
    for x, y in points(rng, 400):
        reach = rng.choice([0.0, 0.06, 0.3])
        expected = any(gap_of(k, x, y, reach) <= 0.0 for k in range(4) if k != but)
        assert touches_cushion(TABLE, x, y, reach, but) == expected
        found += expected
    assert 0 < found < 400


def test_what_is_outside():
    outside = 0
    for x, y in [*points(np.random.default_rng(5), 400), *itertools.product(NASTY, repeat=2)]:
        least = min(gap_of(k, x, y, 0.05) for k in range(4))
        finite = math.isfinite(x) and math.isfinite(y)
        expected = not finite or least < -1e-9
        assert bool(is_outside(TABLE, x, y, 0.05, 1e-9)) == expected, (x, y)
        outside += expected
    assert 0 < outside < 400


@pytest.mark.parametrize('cushion', range(4))
@pytest.mark.parametrize(('depth', 'expected'), [(0.0, False), (9e-10, False), (1.1e-9, True)])
def test_what_is_outside_by_a_hair(cushion, depth, expected):
    nx, ny = NORMALS[cushion]
    x = 0.5 if nx == 0.0 else (LENGTH - 0.05 + depth if nx > 0.0 else 0.05 - depth)
    y = 0.5 if ny == 0.0 else (WIDTH - 0.05 + depth if ny > 0.0 else 0.05 - depth)
    assert bool(is_outside(TABLE, x, y, 0.05, 1e-9)) == expected
