"""Single contacts as users call them: oracle data, published figures, and bad input."""

import math
import re

import numpy as np
import pytest
from billiards import anchors, oracle_contacts

from pool_sim_ros.physics import collide_balls, collide_cushion

POOL = dict(R=0.028575, h=0.036576, e=0.85, f=0.2)
BALLS = dict(m1=0.17, m2=0.17, R=0.028575, e=0.95, friction=0.05)
PRECISION = 2e-14  # of the largest speed; 3 x 1e-15 x sensitivity + 1e-12 is asked for
REST = (0.0, 0.0, 0.0)


def assert_as_the_oracle(found, expected, radius):
    """Velocities in m/s and spins as speeds of the surface."""
    expected = [np.array(vector, dtype=float) for vector in expected]
    largest = max(
        np.abs(vector).max() * (radius if k % 2 else 1.0) for k, vector in enumerate(expected)
    )
    for k, (one, other) in enumerate(zip(found, expected, strict=True)):
        scale = radius if k % 2 else 1.0
        np.testing.assert_allclose(one * scale, other * scale, rtol=0, atol=PRECISION * largest)


@pytest.mark.parametrize('kind', ['ball_ball_constant', 'ball_ball_alciatore'])
def test_oracle_s_contacts_of_balls(kind):
    for given, parameters, expected in oracle_contacts(kind):
        law, *numbers = parameters['friction']
        found = collide_balls(
            given['v1'],
            given['w1'],
            given['v2'],
            given['w2'],
            np.subtract(given['r2'], given['r1']),
            m1=0.17,
            m2=0.17,
            R=parameters['R'],
            e=parameters['e_b'],
            friction='alciatore' if law == 'alciatore' else numbers[0],
            friction_bound={'pooltool': 'restitution', 'physical': 'impulse'}[
                parameters['impulse']
            ],
        )
        named = [expected[name] for name in ('v1', 'w1', 'v2', 'w2')]
        assert_as_the_oracle(found, named, parameters['R'])


@pytest.mark.parametrize('kind', ['cushion_han', 'cushion_impulse', 'nose_impulse'])
def test_oracle_s_contacts_with_a_cushion(kind):
    for given, parameters, expected in oracle_contacts(kind):
        nose = given['nose']
        normal = (nose['dx'], nose['dy'], 0.0) if nose else given['into_cushion']
        found = collide_cushion(
            given['v'],
            given['w'],
            normal,
            R=parameters['R'],
            h=parameters['h'],
            e=parameters['e_c'],
            f=parameters['f_c'],
            model=parameters['cushion'],
            nose_radius=nose['radius'] if nose else 0.0,
        )
        assert_as_the_oracle(found, [expected['v'], expected['w']], parameters['R'])


def test_the_oracle_has_as_many_contacts_as_it_says():
    kinds = ('ball_ball_constant', 'ball_ball_alciatore', 'cushion_han', 'cushion_impulse')
    assert len(list(oracle_contacts(*kinds, 'nose_impulse'))) + 8 == 48


def numbers_in(text):
    return [float(number) for number in re.findall(r'\d+(?:\.\d+)?', text)]


@pytest.mark.parametrize('row', [0, 1, 2])
def test_throw_of_a_stunned_ball(row):
    """Alciatore, TP A.14: by how much friction turns the object ball from the line of centres."""
    given, expected = anchors()['throw_stun'][row]
    speed = float(re.search(r'([\d.]+) m/s', given).group(1))
    for cut, throw in zip((15, 30, 45, 60), numbers_in(expected), strict=True):
        angle = math.radians(cut)
        heading = (speed * math.cos(angle), speed * math.sin(angle), 0.0)
        options = BALLS | dict(e=1.0, friction='alciatore')
        _, _, v2, _ = collide_balls(heading, REST, REST, REST, (1.0, 0.0, 0.0), **options)
        assert math.degrees(math.atan2(v2[1], v2[0])) == pytest.approx(throw, abs=1e-3)


def rolling_again(v, w, radius):
    """The velocity once slip has ended: v - 2/7 of the slip."""
    slip = np.array([v[0] - radius * w[1], v[1] + radius * w[0]])
    return v[:2] - slip * 2 / 7


@pytest.mark.parametrize('number', [1, 2, 3, 4, 5])
def test_measured_ball_ball_contacts(number):
    """Mathavan et al. 2014, tables 1 and 2: a ball with topspin meets one at rest, at a cut."""
    ((given, expected),) = anchors()[f'ball_ball_{number}']
    speed, spin, cut = numbers_in(given.partition('v ')[2])
    radius, angle = 0.02625, math.radians(cut)
    normal = (math.cos(angle), math.sin(angle), 0.0)
    found = collide_balls(
        (speed, 0.0, 0.0),
        (0.0, spin, 0.0),
        REST,
        REST,
        normal,
        m1=0.1406,
        m2=0.1406,
        R=radius,
        e=0.89,
        friction=0.05,
    )
    cue, other = rolling_again(*found[:2], radius), rolling_again(*found[2:], radius)
    measured = [
        math.hypot(*cue),
        math.hypot(*other),
        abs(math.degrees(math.atan2(cue[1], cue[0]))),
        abs(math.degrees(math.atan2(other[1], other[0]))),
    ]
    assert measured == pytest.approx(numbers_in(expected)[-4:], rel=0.02)


def test_unequal_masses_share_the_push():
    """Head-on without friction: momentum and restitution, by hand."""
    options = BALLS | dict(m1=0.2, m2=0.1, e=0.5, friction=0.0)
    v1, _, v2, _ = collide_balls((3.0, 0.0, 0.0), REST, REST, REST, (2.0, 0.0), **options)
    assert v1 == pytest.approx((1.5, 0.0, 0.0), abs=1e-15)
    assert v2 == pytest.approx((3.0, 0.0, 0.0), abs=1e-15)


def test_unequal_masses_with_friction_enough_stop_the_slip():
    options = BALLS | dict(m1=0.3, m2=0.1, friction=1e3)
    sidespin = (0.0, 0.0, 7.0 / 0.028575)
    v1, w1, v2, w2 = collide_balls((1.0, 0.0, 0.0), sidespin, REST, REST, (1.0, 0.0), **options)
    slip = v1[1] - v2[1] + 0.028575 * (w1[2] + w2[2])
    assert slip == pytest.approx(0.0, abs=1e-14)
    # J = (2/7) m_r |c|: 2/7 of 0.075 kg and 7 m/s.
    assert v1[1] == pytest.approx(-0.15 / 0.3) and v2[1] == pytest.approx(0.15 / 0.1)


def test_what_parts_keeps_its_motion():
    v, w = np.array([-1.0, 0.5, 0.0]), np.array([1.0, 2.0, 3.0])
    for speed in (v, np.zeros(3)):
        found = collide_balls(speed, w, REST, REST, (1.0, 0.0), **BALLS)
        np.testing.assert_array_equal(found, [speed, w, REST, REST])
        for model in ('han', 'impulse', 'stronge', 'mathavan'):
            after = collide_cushion(speed, w, (1.0, 0.0), **POOL, model=model, mu_slide=0.2)
            np.testing.assert_array_equal(after, [speed, w])


def test_a_ball_does_not_go_on_into_the_cushion():
    options = POOL | dict(e=0.1)
    v, _ = collide_cushion((1.0, 0.0, 0.0), (0.0, -1400.0, 0.0), (1.0, 0.0), **options, model='han')
    assert v[0] == 0.0


def test_the_length_of_the_normal_does_not_matter():
    v, w = (1.0, 0.5, 0.0), (3.0, 4.0, 5.0)
    one = collide_cushion(v, w, (0.6, 0.8), **POOL, model='impulse', nose_radius=0.02)
    for size in (1e-200, 1e-3, 1e200):
        normal = (0.6 * size, 0.8 * size, 0.0)
        other = collide_cushion(v, w, normal, **POOL, model='impulse', nose_radius=0.02)
        np.testing.assert_allclose(other, one, rtol=1e-14)


def test_mathavan_needs_and_others_take_the_friction_of_the_cloth():
    with pytest.raises(ValueError, match="^mu_slide: None; .*'mathavan'"):
        collide_cushion((1.0, 0.0, 0.0), REST, (1.0, 0.0), **POOL, model='mathavan')
    one = collide_cushion((1.0, 0.0, 0.0), REST, (1.0, 0.0), **POOL, model='han')
    other = collide_cushion((1.0, 0.0, 0.0), REST, (1.0, 0.0), **POOL, model='han', mu_slide=0.2)
    np.testing.assert_array_equal(one, other)


GOOD_BALLS = dict(v1=(1.0, 0.0, 0.0), w1=REST, v2=REST, w2=REST, normal=(1.0, 0.0, 0.0)) | BALLS
GOOD_CUSHION = (
    dict(v=(1.0, 0.0, 0.0), w=REST, normal=(1.0, 0.0, 0.0), model='mathavan', mu_slide=0.2) | POOL
)

BAD_VECTORS = [(math.nan, 0.0, 0.0), (0.0, math.inf, 0.0), (1.0,), 'abc', None, ('a', 0, 0), 1.0]


def assert_refused(function, good, name, value, shown=None):
    with pytest.raises(ValueError) as caught:
        function(**{**good, name: value})
    message = str(caught.value)
    assert message.startswith(f'{name}: ') and '\n' not in message
    assert shown is None or shown in message


@pytest.mark.parametrize('value', BAD_VECTORS)
def test_vectors_that_are_none(value):
    for name in ('v1', 'w1', 'v2', 'w2', 'normal'):
        assert_refused(collide_balls, GOOD_BALLS, name, value)
    for name in ('v', 'w', 'normal'):
        assert_refused(collide_cushion, GOOD_CUSHION, name, value)


@pytest.mark.parametrize(
    ('name', 'value', 'shown'),
    [
        ('v1', (0.0, 0.0, 0.5), '0.5'),
        ('v2', (1e7, 0.0, 0.0), '1e+06'),
        ('w1', (1e10, 0.0, 0.0), '1e+09'),
        ('normal', (0.0, 0.0, 0.0), 'no direction'),
        ('normal', (1.0, 0.0, 0.1), '0.1'),
        ('m1', 0.0, '0'),
        ('m2', -1.0, '-1'),
        ('m1', math.nan, 'nan'),
        ('R', 0.0, '0'),
        ('R', math.inf, 'inf'),
        ('e', -0.1, '-0.1'),
        ('e', 1.1, 'at most 1'),
        ('e', math.nan, 'nan'),
        ('friction', -0.1, '-0.1'),
        ('friction', math.nan, 'nan'),
        ('friction', 'coulomb', "'alciatore'"),
        ('friction', None, 'None'),
        ('friction_bound', 'pooltool', "'restitution'"),
        ('friction_bound', None, "'impulse'"),
    ],
)
def test_bad_input_for_balls(name, value, shown):
    assert_refused(collide_balls, GOOD_BALLS, name, value, shown)


@pytest.mark.parametrize(
    ('name', 'value', 'shown'),
    [
        ('v', (0.0, 0.0, -0.5), '-0.5'),
        ('normal', (0.0, 0.0), 'no direction'),
        ('R', -0.03, '-0.03'),
        ('h', 0.5 * 0.028575, '0.5 R'),
        ('h', 2.0 * 0.028575, '2 R'),
        ('h', -0.03, '-0.03'),
        ('h', math.nan, 'nan'),
        ('e', -0.1, '-0.1'),
        ('e', 1.0000001, 'at most 1'),
        ('f', -0.2, '-0.2'),
        ('f', math.nan, 'nan'),
        ('model', 'han2005', "'stronge'"),
        ('model', None, "'mathavan'"),
        ('mu_slide', -0.2, '-0.2'),
        ('mu_slide', math.nan, 'nan'),
        ('nose_radius', -0.01, '-0.01'),
        ('nose_radius', math.inf, 'inf'),
    ],
)
def test_bad_input_for_a_cushion(name, value, shown):
    assert_refused(collide_cushion, GOOD_CUSHION, name, value, shown)
