"""Strokes of the cue: oracle data, published figures, signs, and bad input."""

import math
import re

import numpy as np
import pytest
from billiards import anchors, oracle
from tables import table_of

from pool_sim_ros.physics import MISCUE_OFFSET, cue_strike, cue_strikes

RADIUS, MASS = 0.028575, 0.170097
TABLE = table_of([(1.0, 0.5)], radius=RADIUS, mass=MASS)


def test_oracle_s_strikes():
    """Its `a` and `b` are side and above, V0, phi and theta speed, azimuth and elevation."""
    strikes = oracle()['contacts']['stick']
    assert len(strikes) == 8
    for strike in strikes:
        given, expected = strike['input'], strike['output']
        table = table_of([(1.0, 0.5)], radius=given['R'], mass=given['m'])
        velocity, spin = cue_strike(
            table,
            given['V0'],
            given['phi'],
            given['theta'],
            given['a'],
            given['b'],
            cue_mass=given['M'],
            end_mass_ratio=given['m'] / given['end_mass'],
            max_offset=1.0,
        )
        exact_v, exact_w = (np.array(expected[name], dtype=float) for name in ('v', 'w'))
        np.testing.assert_allclose(velocity, exact_v[:2], rtol=0, atol=1e-14 * given['V0'])
        np.testing.assert_allclose(
            spin * given['R'], exact_w * given['R'], rtol=0, atol=1e-14 * given['V0']
        )
        assert exact_v[2] == 0.0


def test_published_figures():
    ((given, expected),) = anchors()['cue']
    assert given == 'centre hit; cue mass 0.567 kg; ball 0.170097 kg'
    centre, offset, follow, squirt, side, ratio = figures(expected)
    velocity, spin = cue_strike(TABLE, 1.0, 0.0)
    assert velocity == pytest.approx((centre, 0.0), abs=1e-4)
    np.testing.assert_array_equal(spin, 0.0)
    assert cue_strike(TABLE, 1.0, 0.0, above=offset)[0][0] == pytest.approx(follow, abs=1e-4)
    velocity, _ = cue_strike(TABLE, 1.0, 0.0, side=side, end_mass_ratio=ratio)
    assert math.degrees(math.atan2(-velocity[1], velocity[0])) == pytest.approx(squirt, abs=5e-4)


def figures(text):
    """v / V0, offset, v / V0 there, squirt in degrees, offset, ratio of the masses."""
    found = re.fullmatch(
        r'v / V0 ([\d.]+); at b = ([\d.]+) ([\d.]+); squirt ([\d.]+) deg at a = ([\d.]+); '
        r'end mass ratio (\d+)',
        text,
    )
    return [float(number) for number in found.groups()]


@pytest.mark.parametrize(
    ('azimuth', 'along'),
    [(0, (1, 0)), (90, (0, 1)), (180, (-1, 0)), (270, (0, -1)), (-90, (0, -1)), (720, (1, 0))],
)
def test_straight_strokes_are_exactly_straight(azimuth, along):
    velocity, spin = cue_strike(TABLE, 1.0, azimuth, above=0.3)
    speed = 2.0 / (1.0 + MASS / 0.567 + 2.5 * 0.09)
    np.testing.assert_array_equal(velocity == 0.0, np.array(along) == 0)
    assert velocity == pytest.approx(speed * np.array(along), rel=1e-15)
    assert spin[2] == 0.0 and (spin[:2] == 0.0).any()


@pytest.mark.parametrize('azimuth', [0.0, 17.0, 90.0, 200.0, -45.0])
def test_signs(azimuth):
    """Above: topspin. Left: clockwise from above, and the ball goes to the right. Elevated left
    english: the axis leans, so that the ball curves to the left (masse)."""
    angle = math.radians(azimuth)
    forward = np.array([math.cos(angle), math.sin(angle)])
    left = np.array([-forward[1], forward[0]])

    velocity, spin = cue_strike(TABLE, 2.0, azimuth, above=0.4)
    # Where 2/5 of a radius is struck a ball rolls: no slip.
    assert spin[:2] * RADIUS == pytest.approx(np.array([-velocity[1], velocity[0]]), abs=1e-14)
    assert cue_strike(TABLE, 2.0, azimuth, above=-0.4)[1] @ [*left, 0.0] < 0.0

    velocity, spin = cue_strike(TABLE, 2.0, azimuth, side=0.4)
    assert spin[2] < 0.0 and velocity @ left < 0.0
    assert abs(spin[:2] @ forward) < 1e-12

    velocity, spin = cue_strike(TABLE, 2.0, azimuth, elevation=60.0, side=0.4, end_mass_ratio=None)
    slip = velocity + RADIUS * np.array([-spin[1], spin[0]])
    assert -slip @ left > 0.1


def test_elevation_takes_speed_and_a_vertical_stroke_all():
    level = cue_strike(TABLE, 2.0, 30.0)[0]
    assert cue_strike(TABLE, 2.0, 30.0, elevation=60.0)[0] == pytest.approx(level / 2, rel=1e-14)
    np.testing.assert_allclose(cue_strike(TABLE, 2.0, 30.0, elevation=90.0)[0], 0.0, atol=1e-16)


def test_the_offset_that_still_holds():
    for side, above in ((0.5, 0.0), (0.0, -0.5), (0.3, 0.4)):
        cue_strike(TABLE, 1.0, 0.0, side=side, above=above)
    for angle in np.linspace(0.0, 6.0, 50):
        side, above = 0.5 * math.cos(angle), 0.5 * math.sin(angle)
        cue_strike(TABLE, 1.0, 0.0, side=side, above=above)
        with pytest.raises(ValueError, match=r'^side, above: .*max_offset, 0\.5, .*miscue'):
            cue_strike(TABLE, 1.0, 0.0, side=1.001 * side, above=1.001 * above)
    cue_strike(TABLE, 1.0, 0.0, side=0.8, above=0.6, max_offset=1.0)


@pytest.mark.parametrize(
    ('name', 'value', 'shown'),
    [
        ('speed', -1.0, '-1'),
        ('speed', math.nan, 'nan'),
        ('speed', 1e9, 'at most 1e+06'),
        ('azimuth', math.inf, 'inf'),
        ('azimuth', 'north', 'north'),
        ('elevation', -1.0, '-1'),
        ('elevation', 90.5, 'at most 90'),
        ('elevation', math.nan, 'nan'),
        ('side', math.nan, 'nan'),
        ('above', -math.inf, 'inf'),
        ('cue_mass', 0.0, '0'),
        ('cue_mass', math.nan, 'nan'),
        ('end_mass_ratio', 0.0, 'above 0'),
        ('end_mass_ratio', -30.0, '-30'),
        ('max_offset', 1.5, 'at most 1'),
        ('max_offset', -0.1, '-0.1'),
    ],
)
def test_bad_input(name, value, shown):
    with pytest.raises(ValueError) as caught:
        cue_strike(TABLE, **{'speed': 1.0, 'azimuth': 0.0, name: value})
    message = str(caught.value)
    assert message.startswith(f'{name}: ') and shown in message and '\n' not in message


def test_many_strokes_are_strokes_one_by_one():
    rng = np.random.default_rng(1)
    strokes = rng.uniform((0, -400, 0, -0.35, -0.35), (6, 400, 90, 0.35, 0.35), (50, 5))
    velocities, spins, holds = cue_strikes(TABLE, strokes)
    assert holds.all()
    for stroke, velocity, spin in zip(strokes, velocities, spins, strict=True):
        expected = cue_strike(TABLE, *stroke)
        np.testing.assert_allclose(velocity, expected[0], rtol=0, atol=1e-13)
        np.testing.assert_allclose(spin, expected[1], rtol=0, atol=1e-10)


def test_a_tip_that_slips_off_gives_nothing():
    strokes = np.array([[2.0, 30.0, 0.0, 0.0, MISCUE_OFFSET], [2.0, 30.0, 0.0, 0.4, 0.4]])
    velocities, spins, holds = cue_strikes(TABLE, strokes)
    assert holds.tolist() == [True, False]
    assert np.hypot(*velocities[0]) > 2.0 and not velocities[1].any() and not spins[1].any()
