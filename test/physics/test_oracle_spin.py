"""The high-precision oracle for balls that spin: shots of another oracle, and cases by hand."""

import math
from types import SimpleNamespace

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


def test_where_all_is_at_a_time_by_hand():
    """Half way through a slide: velocity and spin change at constant rates."""
    time = 1 / (7 * 0.2 * 9.81)
    found = oracle_spin.play(POOL, [(0.5, 0.5)], [(1.0, 0.0, 0.0, 0.0, 50.0)], until=time)
    assert found.duration == pytest.approx(time) and not found.events
    assert found.velocities[0] == pytest.approx([1 - 0.2 * 9.81 * time, 0.0])
    assert found.finals[0] == pytest.approx([0.5 + time - 0.2 * 9.81 * time**2 / 2, 0.5])
    turned = 5 / (2 * 0.028575) * 0.2 * 9.81 * time
    decayed = 5 * 0.0127 * 9.81 / (2 * 0.028575) * time
    assert found.spins[0] == pytest.approx([0.0, turned, 50.0 - decayed])


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


def test_a_table_s_shot_is_that_of_its_parameters():
    shot = SHOTS[7]
    given = shot['parameters']
    balls = [
        SimpleNamespace(position=place, radius=given['R'], mass=0.17) for place in shot['places']
    ]
    table = SimpleNamespace(
        length=given['length'],
        width=given['width'],
        balls=balls,
        gravity=given['g'],
        mu_slide=given['u_s'],
        mu_roll=given['u_r'],
        mu_spin=given['u_sp'],
        e_ball_ball=given['e_b'],
        e_cue_ball=given['e_b'],
        e_ball_cushion=given['e_c'],
        mu_ball_cushion=given['f_c'],
        nose_height=given['h'],
        ball_friction='alciatore' if given['friction'][0] == 'alciatore' else 'coulomb',
        mu_ball_ball=given['friction'][1],
        cushion_model=given['cushion'],
        friction_bound='restitution' if given['impulse'] == 'pooltool' else 'impulse',
        cushions=None,
        pockets=None,
    )
    velocities = [strike[:2] for strike in shot['strikes']]
    spins = [strike[2:] for strike in shot['strikes']]
    if len(shot['strikes']) == 1:
        velocities, spins = velocities[0], spins[0]
    found = oracle_spin.simulate(table, velocities, spins)
    assert found.counts == shot['counts']
    for place, expected in zip(found.finals, shot['finals'], strict=True):
        assert all(abs(a - mpf(b)) < mpf('1e-18') for a, b in zip(place, expected, strict=True))
    listed = oracle_spin.engine_events(found)
    assert len(listed) == len(shot['events']) - shot['counts'].get('spin_end', 0)
    kinds = {
        name: sum(kind == k for _, kind, _, _ in listed) for name, k in oracle_spin.KINDS.items()
    }
    assert {name: n for name, n in kinds.items() if n} == {
        name: n for name, n in shot['counts'].items() if name != 'spin_end'
    }


def test_masses_and_the_cue_ball_s_restitution():
    """Head-on without friction: by momentum and restitution, in the moment after the contact."""
    parameters = POOL | dict(
        masses=[0.2, 0.1, 0.1], e_cue=0.5, e_b=0.9, friction=('constant', 0.0), u_s=1e-9, u_r=1e-9
    )
    places = [(0.5, 0.5), (0.8, 0.5), (1.2, 0.5)]
    shot = oracle_spin.Play(parameters, places, [(3.0, 0, 0, 0, 0), (0,) * 5, (0,) * 5])
    for speeds in ((1.5, 3.0, 0.0), (1.5, 0.15, 2.85)):
        event = min(shot.next.values(), key=lambda each: each.time)
        shot.advance(event.time - shot.t)
        assert shot.happen(event)[0] == 'ball'
        shot.predict(event.ball)
        shot.predict(event.other)
        assert [float(ball.v[0]) for ball in shot.balls] == pytest.approx(speeds, abs=1e-6)
