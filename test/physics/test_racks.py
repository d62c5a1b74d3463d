"""Racks: what lies where, the gaps between neighbours, and what does not fit."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import table_of

from pool_sim_ros.physics import Ball, rack
from pool_sim_ros.physics.racks import RACKS, rack_places

RADIUS = 0.028575
SIZE = (2.54, 1.27)
PACKED = {'triangle': 15, 'eight_ball': 15, 'nine_ball': 9, 'ten_ball': 10, 'snooker': 15}


def places(kind, spacing=1e-4, seed=None, size=SIZE, radius=RADIUS):
    return rack_places(kind, *size, radius, spacing, seed)


def packed(kind, **options):
    """The places of the balls that lie together, (n, 2), by label."""
    found = places(kind, **options)
    names = [place.label for place in found]
    loose = {'C', 'yellow', 'green', 'brown', 'blue', 'pink', 'black'}
    together = [k for k, name in enumerate(names) if name not in loose]
    return np.array([found[k].position for k in together]), [names[k] for k in together]


def gaps(spots, spacing, radius=RADIUS):
    """Gaps of neighbours: pairs that are nearer than one and a half pitches."""
    pairs = itertools.combinations(spots, 2)
    distances = np.array([math.dist(one, other) for one, other in pairs])
    return distances[distances < 1.4 * (2 * radius + spacing)] - 2 * radius


NEIGHBOURS = {15: 30, 10: 18, 9: 16}


@pytest.mark.parametrize('kind', PACKED)
@pytest.mark.parametrize('seed', [None, 0, 1, 2, 3])
@pytest.mark.parametrize('spacing', [0.0, 1e-6, 1e-4, 2e-3])
def test_the_mean_gap_is_the_spacing_and_none_is_negative(kind, spacing, seed):
    spots, _ = packed(kind, spacing=spacing, seed=seed)
    assert len(spots) == PACKED[kind]
    found = gaps(spots, spacing)
    assert len(found) == NEIGHBOURS[len(spots)]
    assert found.min() >= -1e-15
    assert found.mean() == pytest.approx(spacing, abs=1e-14)
    if seed is None or spacing == 0.0:
        np.testing.assert_allclose(found, spacing, rtol=0, atol=1e-15)
    else:
        assert found.std() > 0.1 * spacing


@given(
    st.sampled_from(RACKS),
    st.one_of(st.just(0.0), st.floats(1e-9, 5e-3)),
    st.one_of(st.none(), st.integers(0, 2**32)),
)
def test_nothing_overlaps_and_all_lie_on_the_table(kind, spacing, seed):
    spots = [place.position for place in places(kind, spacing, seed)]
    for one, other in itertools.combinations(spots, 2):
        assert math.dist(one, other) >= 2 * RADIUS - 1e-15
    assert (np.array(spots) >= RADIUS).all()
    assert (np.array(spots) <= np.array(SIZE) - RADIUS).all()


@pytest.mark.parametrize('kind', RACKS)
def test_labels_are_unique_and_the_cue_ball_is_the_first(kind):
    labels = [place.label for place in places(kind)]
    assert labels[0] == 'C' and len(set(labels)) == len(labels)
    expected = {'nine_ball': 10, 'ten_ball': 11, 'snooker': 22, 'carom': 3}.get(kind, 16)
    assert len(labels) == expected


@pytest.mark.parametrize('kind', ['triangle', 'eight_ball', 'nine_ball', 'ten_ball'])
def test_pool_balls_have_their_numbers_in_order(kind):
    labels = [place.label for place in places(kind)]
    assert labels[1:] == [str(k) for k in range(1, len(labels))]


@pytest.mark.parametrize('kind', PACKED)
def test_without_jitter_a_rack_is_its_own_mirror_image(kind):
    spots, _ = packed(kind)
    mirrored = spots * (1, -1) + (0, SIZE[1])
    for spot in mirrored:
        assert np.hypot(*(spots - spot).T).min() < 1e-15


def test_same_seed_same_rack_and_others_differ():
    for kind in PACKED:
        assert places(kind, seed=3) == places(kind, seed=3)
        assert places(kind, seed=3) != places(kind, seed=4) != places(kind)
    assert places('carom', seed=3) == places('carom')


def test_spots_of_pool():
    """The cue ball on the head spot, the first ball on the foot spot, the rest behind it."""
    for kind in ('eight_ball', 'nine_ball', 'ten_ball'):
        found = {place.label: place.position for place in places(kind)}
        assert found['C'] == (0.75 * SIZE[0], SIZE[1] / 2)
        assert found['1'] == pytest.approx((0.25 * SIZE[0], SIZE[1] / 2), abs=1e-15)
        assert all(x <= found['1'][0] for label, (x, _) in found.items() if label != 'C')


def test_who_lies_in_the_middle():
    """WPA: the 8 in the middle of the third row, the 9 and the 10 in the middle; the triangle's
    far corners have one solid and one stripe."""
    row = math.sqrt(3) / 2 * (2 * RADIUS + 1e-4)
    foot = np.array([0.25 * SIZE[0], SIZE[1] / 2])
    for kind, middle in (('eight_ball', '8'), ('nine_ball', '9'), ('ten_ball', '10')):
        found = {place.label: np.array(place.position) for place in places(kind)}
        np.testing.assert_allclose(found[middle], foot - (2 * row, 0.0), atol=1e-15)
    found = {place.label: place.position for place in places('eight_ball')}
    last = sorted((y, label) for label, (x, y) in found.items() if x < foot[0] - 3.9 * row)
    corners = sorted(int(label) for _, label in (last[0], last[-1]))
    assert len(last) == 5 and corners[0] < 8 < corners[1]


def test_spots_of_snooker():
    """WPBSA: on 3569 x 1778 mm the baulk line is 737 mm, the black spot 324 mm from the cushions;
    the D has a radius of 292 mm; yellow on the right as seen from baulk; reds behind the pink."""
    size, radius = (3.569, 1.778), 0.02619375
    found = {p.label: np.array(p.position) for p in places('snooker', size=size, radius=radius)}
    middle = size[1] / 2
    assert found['brown'] == pytest.approx((3.569 - 0.737, middle), abs=1e-3)
    assert found['black'] == pytest.approx((0.324, middle), abs=1e-3)
    assert found['blue'] == pytest.approx((3.569 / 2, middle), abs=1e-12)
    assert found['pink'] == pytest.approx((3.569 / 4, middle), abs=1e-12)
    # Whoever stands at the end of the baulk looks to -x and has +y on the right.
    assert found['yellow'] == pytest.approx((3.569 - 0.737, middle + 0.292), abs=1e-3)
    assert found['green'] == pytest.approx((3.569 - 0.737, middle - 0.292), abs=1e-3)
    cue = found['C']
    assert math.dist(cue, found['brown']) < 0.292 and cue[0] >= 3.569 - 0.738
    reds = np.array([spot for label, spot in found.items() if label.startswith('R')])
    assert reds[:, 0].max() == pytest.approx(found['pink'][0] - 2 * radius - 1e-4, abs=1e-15)
    assert reds[:, 0].min() > found['black'][0] + 2 * radius


def test_reds_do_not_touch_the_pink_even_where_they_touch_each_other():
    found = places('snooker', spacing=0.0, size=(3.569, 1.778), radius=0.02619375)
    pink = next(place.position for place in found if place.label == 'pink')
    reds = [place.position for place in found if place.label.startswith('R')]
    assert min(math.dist(pink, red) for red in reds) > 2 * 0.02619375 + 5e-5


def test_spots_of_carom():
    """UMB, on 2.84 x 1.42 m: red on the foot spot, the opponent's on the head spot, the player's
    182.5 mm beside it."""
    found = {p.label: p.position for p in places('carom', size=(2.84, 1.42), radius=0.03075)}
    assert found['red'] == pytest.approx((0.71, 0.71), abs=1e-12)
    assert found['yellow'] == pytest.approx((2.13, 0.71), abs=1e-12)
    assert found['C'] == pytest.approx((2.13, 0.71 - 0.1825), abs=1e-12)


def test_balls_have_the_radius_and_mass_of_the_table_s_first():
    table = table_of([(1.0, 0.5)], length=2.0, width=1.0, radius=0.03, mass=0.16)
    balls = rack(table, 'nine_ball', spacing=1e-4, seed=3)
    assert all(
        isinstance(ball, Ball) and (ball.radius, ball.mass) == (0.03, 0.16) for ball in balls
    )
    assert [ball.is_cue for ball in balls] == [True] + [False] * 9
    spots = [place.position for place in rack_places('nine_ball', 2.0, 1.0, 0.03, 1e-4, 3)]
    assert [ball.position for ball in balls] == spots


@pytest.mark.parametrize(
    ('options', 'start'),
    [
        (dict(kind='pyramid'), "kind: 'pyramid' is no rack; there are 'triangle'"),
        (dict(kind=None), 'kind: None'),
        (dict(kind='triangle', spacing=-1e-4), 'spacing: -0.0001'),
        (dict(kind='triangle', spacing=math.nan), 'spacing: nan'),
        (dict(kind='triangle', spacing='wide'), "spacing: 'wide'"),
        (dict(kind='triangle', seed=-1), 'seed: -1'),
        (dict(kind='triangle', seed=1.5), 'seed: 1.5'),
        (dict(kind='triangle', spacing=0.5), "kind: a rack 'triangle' of balls of radius"),
        (dict(kind='triangle', size=(0.4, 0.3)), "kind: a rack 'triangle' of balls of radius"),
        (dict(kind='snooker', size=(1.0, 0.5)), "kind: a rack 'snooker' of balls of radius"),
        (dict(kind='carom', size=(0.2, 0.05)), "kind: a rack 'carom' of balls of radius"),
        (dict(kind='carom', size=(0.1, 0.1)), "kind: a rack 'carom' of balls of radius"),
    ],
)
def test_what_is_refused(options, start):
    with pytest.raises(ValueError) as caught:
        places(**options)
    assert str(caught.value).startswith(start) and '\n' not in str(caught.value)
