"""The high-precision oracle for balls that spin: shots of another oracle, and cases by hand."""

import math

import oracle_spin
import pytest
from billiards import oracle, seven_foot
from mpmath import mpf

SHOTS = oracle()['shots']
POOL = dict(
    length=1.9812,
    width=0.9906,
    R=0.028575,
    g=9.81,
    u_s=0.2,
    u_r=0.01,
    u_sp=0.0127,
    e_b=0.95,
    e_c=0.85,
    f_c=0.2,
    h=0.036576,
    friction=('constant', 0.05),
    cushion='han',
    impulse='physical',
)


@pytest.mark.parametrize('number', range(len(SHOTS)))
def test_shots_of_another_oracle(number):
    """All events in order, and every printed digit but the last ones."""
    shot = SHOTS[number]
    found = oracle_spin.play(shot['parameters'], shot['places'], shot['strikes'])
    assert found.counts == shot['counts']
    assert [(e.kind, e.ball, e.other) for e in found.events] == [
        tuple(event[1:]) for event in shot['events']
    ]
    # What 25 printed digits say, with what a shot may make of their rounding.
    slack = mpf('1e-22') * (1 + mpf(shot['sensitivity']))
    for place, expected in zip(found.finals, shot['finals'], strict=True):
        for one, other in zip(place, expected, strict=True):
            assert abs(one - mpf(other)) < slack
    assert abs(found.duration - mpf(shot['duration'])) < slack
    for event, (time, *_) in zip(found.events, shot['events'], strict=True):
        assert abs(event.time - mpf(time)) < slack


def test_a_slide_that_becomes_a_roll_by_hand():
    """A stunned ball at 1 m/s rolls at 5/7 m/s after 2/(7 mu g) s, and stops after v/(mu_r g)."""
    parameters = POOL | dict(length=1000.0, width=1000.0)
    found = oracle_spin.play(parameters, [(1.0, 500.0)], [(1.0, 0.0, 0.0, 0.0, 0.0)])
    slide, roll = 2 / (7 * 0.2 * 9.81), 5 / (7 * 0.01 * 9.81)
    assert [event.kind for event in found.events] == ['roll', 'stop']
    assert found.events[0].time == pytest.approx(slide)
    assert found.duration == pytest.approx(slide + roll)
    way = slide - 0.2 * 9.81 * slide**2 / 2 + (5 / 7) ** 2 / (2 * 0.01 * 9.81)
    assert found.finals[0] == pytest.approx([1.0 + way, 500.0])


def test_spin_in_place_ends_alone():
    found = oracle_spin.play(POOL, [(1.0, 0.5)], [(0.0, 0.0, 0.0, 0.0, -100.0)])
    assert found.counts == {'spin_end': 1}
    assert found.duration == pytest.approx(100.0 * 2 * 0.028575 / (5 * 0.0127 * 9.81))
    assert found.finals[0] == [1.0, 0.5]


def test_pockets_catch_and_noses_turn():
    data = seven_foot()
    table = (data['segments'], data['noses'], data['pockets'])
    # Into the first corner along the diagonal; a ball on the way is caught too.
    found = oracle_spin.play(POOL, [(0.5, 0.5), (0.2, 0.2)], [(-2.0, -2.0, 0.0, 0.0, 0.0)], *table)
    assert found.pocketed[1] == 0 and found.counts['pocketed'] >= 1
    assert found.finals[1] == [mpf(x) for x in data['pockets'][0][:2]]
    # At the rounded side of the nose of a side mouth.
    x, _, radius = data['noses'][2]
    found = oracle_spin.play(POOL, [(x + radius / 2, 0.3)], [(0.0, -1.0, 0.0, 0.0, 0.0)], *table)
    assert found.events[1].kind == 'cushion' and found.events[1].other == len(table[0]) + 2
    # A ball that starts in a pocket is caught already.
    found = oracle_spin.play(POOL, [data['pockets'][3][:2]], [(1.0, 0.0, 0.0, 0.0, 0.0)], *table)
    assert found.pocketed == [3] and not found.events and found.duration == 0


@pytest.mark.parametrize(
    ('places', 'strike'),
    [
        # A graze, and a ball that reaches a cushion with hardly any speed.
        ([(0.5, 0.5), (0.8, 0.5 + 2 * 0.028575)], (1.0, 0.0, 0.0, 1.0 / 0.028575, 0.0)),
        ([(0.5, 0.9906 - 0.028575 - 1e-9)], (0.0, 1e-4, -1e-4 / 0.028575, 0.0, 0.0)),
    ],
)
def test_what_depends_on_a_rounding_is_refused(places, strike):
    with pytest.raises(oracle_spin.AmbiguousShotError):
        oracle_spin.play(POOL, places, [strike])


def test_mirrored_shots_are_mirrored():
    shot = SHOTS[1]
    width = shot['parameters']['width']
    places = [(x, mpf(width) - mpf(y)) for x, y in shot['places']]
    strikes = [(vx, -vy, -wx, wy, -wz) for vx, vy, wx, wy, wz in shot['strikes']]
    found = oracle_spin.play(shot['parameters'], places, strikes)
    for place, expected in zip(found.finals, shot['finals'], strict=True):
        assert abs(place[0] - mpf(expected[0])) < mpf('1e-18')
        assert abs(place[1] - mpf(width) + mpf(expected[1])) < mpf('1e-18')
    assert math.isclose(found.duration, float(shot['duration']))
