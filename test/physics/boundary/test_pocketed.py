"""Cushions in any direction, noses and pockets: against a fine search along the path."""

import functools
import math

import numpy as np
import pytest
from numba import njit

from pool_sim_ros.physics.boundary import (
    FIRST_CUSHION,
    PHASE_END,
    cushion_gap,
    cushion_normal,
    distance_to_mouths,
    from_cushion_axes,
    is_outside,
    is_pocket,
    n_cushions,
    nose_radius,
    pocket_at,
    pocket_centre,
    pocket_of_partner,
    pocketed_boundary,
    put_on_cushion,
    time_to_cushions,
    to_cushion_axes,
    touches_cushion,
)
from pool_sim_ros.physics.boundary.surroundings import AROUND, SIDE, STRETCH, WITHIN
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


@pytest.mark.parametrize('name', NAMES)
def test_the_tables_have_an_inner_rectangle(name):
    boundary, radius = boundary_of(name)
    assert boundary.inner == radius
    assert sorted(set(sides(boundary).tolist())) == [-1, 0, 1, 2, 3]
    assert np.sum(sides(boundary) >= 0) == 6


def looked_at_whole(boundary):
    """Return a boundary of which every part is looked at every time."""
    parts = boundary.parts.copy()
    parts[: boundary.n_segments, STRETCH : STRETCH + 4] = np.inf, -np.inf, np.inf, -np.inf
    parts[boundary.n_cushions :, WITHIN] = -1.0
    return boundary._replace(inner=np.inf, parts=parts)


def sides(boundary):
    """Return the sides on which the segments lie, -1 for a jaw."""
    return boundary.parts[: boundary.n_segments, SIDE]


def stretches(boundary):
    """Return the boxes in which a ball on a rail touches nothing else."""
    return boundary.parts[: boundary.n_segments, STRETCH : STRETCH + 4]


@pytest.mark.parametrize('name', NAMES)
def test_what_is_not_looked_at_is_never_met_first(name):
    """With the inner rectangle and the surroundings of pockets, and without: the same answers."""
    boundary, radius = boundary_of(name)
    without = looked_at_whole(boundary)
    met = np.zeros(3)
    for path in paths(np.random.default_rng(1), boundary, radius, 8000):
        seconds, partner = first_met(boundary, path, radius)
        expected, expected_partner = first_met(without, path, radius)
        assert partner == expected_partner, path
        assert seconds == pytest.approx(expected, rel=1e-9, abs=1e-12)
        number = FIRST_CUSHION - partner
        met[0 if partner == PHASE_END else 1 if number < n_cushions(boundary) else 2] += 1
    assert (met > 200).all(), met


@pytest.mark.parametrize('name', NAMES)
@pytest.mark.parametrize('count', [150, pytest.param(1500, marks=pytest.mark.soak)])
def test_what_a_path_meets_first_equals_a_fine_search(name, count):
    boundary, radius = boundary_of(name)
    k, p = len(boundary.segments), len(boundary.noses)
    met, skipped = set(), 0
    for path in paths(np.random.default_rng(2), boundary, radius, count):
        expected = search(boundary, path, radius)
        if expected is None:
            skipped += 1
            continue
        seconds, partner = first_met(boundary, path, radius)
        assert partner == expected[1], path
        assert seconds == pytest.approx(expected[0], abs=1e-9)
        if partner != PHASE_END:
            number = FIRST_CUSHION - partner
            met.add('segment' if number < k else 'nose' if number < k + p else 'pocket')
    assert met == {'segment', 'nose', 'pocket'} and skipped < count / 2


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
        pocket = boundary.parts[boundary.n_cushions + q]
        listed = set(pocket[AROUND:].tolist()) - {-1}
        n = n_cushions(boundary)
        assert n + q in listed and len(listed) < 12
        angle, away = rng.uniform(0.0, 7.0, 4000), pocket[WITHIN] * rng.random(4000) ** 0.5
        points = np.column_stack([x + away * np.cos(angle), y + away * np.sin(angle)])
        gaps = all_gaps(boundary, points, radius)  # what is far behind a segment is not near it
        met = np.flatnonzero(((gaps <= 0.0) & (gaps >= -2.0 * radius)).any(axis=0))
        assert set(met.tolist()) <= listed and len(met) > 4


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
