"""What a boundary with pockets says of a place, beside plain twins."""

import math

import numpy as np
import pytest
from pocketed_boundaries import (
    NAMES,
    asked,
    boundary_of,
    distances,
    first_met,
    gap_and_normal,
    heights,
    looked_at_whole,
    starts,
    there_and_back,
)

from pool_sim_ros.physics.boundary import (
    FIRST_CUSHION,
    PHASE_END,
    is_pocket,
    n_cushions,
    nose_radius,
    pocket_centre,
    pocket_of_partner,
    pocketed_boundary,
)
from pool_sim_ros.physics.motion.curved_path import CurvedPath


@pytest.mark.parametrize('name', NAMES)
def test_places(name):
    boundary, radius = boundary_of(name)
    rng = np.random.default_rng(3)
    size = np.array([boundary.length, boundary.width])
    counts = np.zeros(3)
    for spot in rng.uniform(-0.1, size + 0.1, (4000, 2)):
        but, reach = rng.integers(-1, n_cushions(boundary)), rng.choice([radius, 0.1])
        outside, touches, pocket, clear = asked(boundary, *spot, radius, reach, but)
        points = spot[np.newaxis]
        holes = distances(boundary.pockets, points)[0]
        assert pocket == (int(np.argmin(holes)) if holes.min() < 0.0 else -1)
        assert clear == pytest.approx(min(holes.min(), *spot, *(size - spot)), abs=1e-14)
        height, facing = heights(boundary, points)
        cut = (facing & (np.abs(height) < radius - 1e-9)).any()
        cut |= (distances(boundary.noses, points) < radius - 1e-9).any()
        inside = (0.0 <= spot).all() and (spot <= size).all()
        # Beyond the rails, in a mouth, a ball may lie: see `test_mouths`.
        if pocket >= 0 or cut or inside:
            assert outside == (pocket < 0 and bool(cut))
        near = np.hstack(
            [facing & (np.abs(height) <= reach), distances(boundary.noses, points) <= reach]
        )
        if but >= 0:
            near[0, but] = False
        assert touches == near.any()
        counts += outside, touches, pocket >= 0
    assert (counts > 40).all() and (counts < 3500).all()


@pytest.mark.parametrize('name', NAMES)
def test_the_inner_rectangle_changes_nothing_of_what_is_outside(name):
    """Places all over the table, and hairs beside the lines where a ball touches a rail."""
    boundary, radius = boundary_of(name)
    assert boundary.inner == radius
    plain = looked_at_whole(boundary)
    rng = np.random.default_rng(7)
    spots = rng.uniform(-0.05, (boundary.length + 0.05, boundary.width + 0.05), (4000, 2))
    at = np.array([radius, boundary.length - radius]), np.array([radius, boundary.width - radius])
    for axis in (0, 1):
        count = len(spots[axis::4])
        spots[axis::4, axis] = rng.choice(at[axis], count) + rng.choice([-3e-9, 0, 3e-9], count)
    told = [asked(boundary, *spot, radius, radius, -1)[0] for spot in spots]
    assert told == [asked(plain, *spot, radius, radius, -1)[0] for spot in spots]
    assert 400 < sum(told) < 2400


def test_a_place_that_is_no_number_is_outside():
    boundary, radius = boundary_of('7ft')
    for spot in ((math.nan, 0.5), (0.5, math.nan), (math.inf, 0.5), (0.5, -math.inf)):
        assert asked(boundary, *spot, radius, radius, -1)[0]


@pytest.mark.parametrize('name', NAMES)
def test_gaps_normals_and_places_on_cushions(name):
    boundary, radius = boundary_of(name)
    k = len(boundary.segments)
    rng = np.random.default_rng(4)
    faced = 0
    for spot in starts(rng, boundary, radius, 300):
        points = spot[np.newaxis]
        height, facing = heights(boundary, points)
        for cushion in range(n_cushions(boundary)):
            gap, normal, place = gap_and_normal(boundary, cushion, *spot, radius)
            assert math.hypot(*normal) == pytest.approx(1.0, abs=1e-15)
            if cushion >= k:
                nose = boundary.noses[cushion - k]
                assert gap == pytest.approx(
                    distances(boundary.noses, points)[0, cushion - k] - radius
                )
                to_centre = (gap + radius + nose[2]) * np.array(normal)
                assert spot + to_centre == pytest.approx(nose[:2], abs=1e-14)
                assert place == tuple(spot)
                assert nose_radius(boundary, cushion) == nose[2]
                continue
            assert nose_radius(boundary, cushion) == 0.0
            assert tuple(normal) == tuple(-boundary.segments[cushion, 4:])
            if not facing[0, cushion] or height[0, cushion] <= -radius:
                assert gap == math.inf
                continue
            faced += 1
            assert gap == pytest.approx(height[0, cushion] - radius, abs=1e-14)
            assert place == pytest.approx(tuple(spot + gap * np.array(normal)), abs=1e-14)
            # Along an axis exactly, so that what lies on a rail stays there.
            again = gap_and_normal(boundary, cushion, *place, radius)
            assert abs(again[0]) < 1e-15
            if 0.0 in normal:
                assert again[2] == place
    assert faced > 300


def test_what_is_far_behind_a_cushion_does_not_touch_it():
    """The two long sides of an island: who is before one is behind the other."""
    segments = np.array(
        [[0.4, 0.5, 0.6, 0.5, 0.0, 1.0], [0.4, 0.4, 0.6, 0.4, 0.0, -1.0]], dtype=float
    )
    boundary = pocketed_boundary((1.0, 1.0), segments, np.empty((0, 3)), np.empty((0, 3)), 0.03)
    assert boundary.inner == math.inf
    assert not asked(boundary, 0.5, 0.7, 0.03, 0.031, -1)[1]
    assert asked(boundary, 0.5, 0.53, 0.03, 0.031, -1)[1]
    assert gap_and_normal(boundary, 1, 0.5, 0.7, 0.03)[0] == math.inf
    path = CurvedPath(0.5, 0.7, 0.0, -1.0, 0.0, 0.0, 10.0, True)
    assert first_met(boundary, path, 0.03) == pytest.approx((0.17, FIRST_CUSHION))


def test_axes_of_a_cushion_there_and_back():
    boundary, _ = boundary_of('7ft')
    rng = np.random.default_rng(5)
    for _ in range(100):
        angle, v = rng.uniform(-math.pi, math.pi), tuple(rng.normal(size=2))
        normal = math.cos(angle), math.sin(angle)
        parts, back = there_and_back(boundary, 0, normal, v)
        assert parts[0] == pytest.approx(np.dot(v, normal), abs=1e-15)
        assert math.hypot(*parts) == pytest.approx(math.hypot(*v), rel=1e-14)
        assert back == pytest.approx(v, abs=1e-15)


def test_partners_beyond_the_cushions_are_pockets():
    boundary, _ = boundary_of('7ft')
    count = n_cushions(boundary)
    assert count == len(boundary.segments) + len(boundary.noses)
    for number in range(count):
        assert not is_pocket(boundary, FIRST_CUSHION - number)
    for number, pocket in enumerate(boundary.pockets):
        partner = FIRST_CUSHION - count - number
        assert is_pocket(boundary, partner) and pocket_of_partner(boundary, partner) == number
        assert pocket_centre(boundary, number) == tuple(pocket[:2])


def test_a_nose_without_radius_is_a_point():
    """A ball meets it when it is a radius away, and only then."""
    noses = np.array([[0.5, 0.5, 0.0]])
    boundary = pocketed_boundary((1.0, 1.0), np.empty((0, 6)), noses, np.empty((0, 3)), 0.03)
    for across, expected in ((0.0, 0.27), (0.018, 0.276), (0.0301, math.inf)):
        path = CurvedPath(0.2, 0.5 + across, 1.0, 0.0, 0.0, 0.0, 10.0, True)
        seconds, partner = first_met(boundary, path, 0.03)
        assert seconds == pytest.approx(expected, abs=1e-14)
        assert partner == (FIRST_CUSHION if expected < 1.0 else PHASE_END)
