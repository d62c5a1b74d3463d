"""Which phase a ball begins, also where next to nothing is left of it."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from numba import njit

from pool_sim_ros.physics.motion import BALL, RESTS, ROLLS, SLIDES
from pool_sim_ros.physics.motion.ball_phases import begin_phase, begin_to_roll, spin_left
from pool_sim_ros.physics.tolerances import SHORTEST_PHASE

RADIUS = 0.03125


@njit
def begin(balls, table, roll_only):
    if roll_only:
        begin_to_roll(balls[0], table)
    else:
        begin_phase(balls[0], table)


@njit
def left(wz, table, elapsed):
    return spin_left(wz, table, elapsed)


class Cloth(NamedTuple):
    """What these kernels ask of a table."""

    radius: float = RADIUS
    slide: float = 2.0
    roll: float = 0.125
    spin: float = 10.0


def begun(v, w, since=0.0, table=None, roll_only=False):
    """Return the record of a ball after it has begun a phase."""
    balls = np.zeros(1, BALL)
    balls['since'] = since
    balls['vx'], balls['vy'] = v
    balls['wx'], balls['wy'], balls['wz'] = w
    begin(balls, table or Cloth(), roll_only)
    return balls[0]


def test_with_slip_it_slides_without_it_rolls_without_speed_it_rests():
    ball = begun((1.0, 0.0), (0.0, 0.0, 5.0), since=3.0)
    assert ball['phase'] == SLIDES and (ball['ax'], ball['ay']) == (-2.0, 0.0)
    assert ball['phase_end'] == pytest.approx(3.0 + 1.0 / 7.0, rel=1e-15)
    ball = begun((1.0, 0.0), (0.0, 32.0, 5.0), since=3.0)
    assert ball['phase'] == ROLLS and (ball['ax'], ball['ay']) == (-0.125, 0.0)
    assert ball['phase_end'] == 11.0 and ball['wz'] == 5.0
    ball = begun((0.0, 0.0), (0.0, 0.0, 5.0), since=3.0)
    assert ball['phase'] == RESTS and ball['phase_end'] == math.inf and ball['wz'] == 5.0


@pytest.mark.parametrize('since', [0.0, 1.0, 1000.0])
@pytest.mark.parametrize(('share', 'phase'), [(0.9, RESTS), (1.1, ROLLS)])
def test_a_roll_that_is_too_short_is_left_out(since, share, phase):
    speed = 0.125 * share * SHORTEST_PHASE * max(since, 1.0)
    ball = begun((0.0, -speed), (speed / RADIUS, 0.0, 0.0), since)
    assert ball['phase'] == phase
    if phase == RESTS:
        assert ball[['vx', 'vy', 'ax', 'ay', 'wx', 'wy']].tolist() == (0.0,) * 6
        assert ball['phase_end'] == math.inf


@pytest.mark.parametrize('since', [0.0, 1.0, 1000.0])
@pytest.mark.parametrize(('share', 'phase'), [(0.9, RESTS), (1.1, SLIDES)])
def test_a_slide_that_is_too_short_is_left_out(since, share, phase):
    """Of a ball that spins in place with a slip of next to nothing."""
    slip = 3.5 * 2.0 * share * SHORTEST_PHASE * max(since, 1.0)
    table = Cloth(roll=1e9)
    ball = begun((0.0, 0.0), (slip / RADIUS, 0.0, 0.0), since, table)
    assert ball['phase'] == phase
    assert ball['phase_end'] > since


@pytest.mark.parametrize(('share', 'phase'), [(1e-15, ROLLS), (-1e-15, ROLLS), (1e-12, SLIDES)])
def test_slip_that_is_rounding_is_none(share, phase):
    ball = begun((3.0, 4.0), (-4.0 / RADIUS, 3.0 * (1.0 + share) / RADIUS, 1.0))
    assert ball['phase'] == phase
    if phase == ROLLS:
        assert ball['vx'] == RADIUS * ball['wy'] and ball['vy'] == -RADIUS * ball['wx']


def test_every_phase_ends_later_than_it_began():
    """However small what is left: else the clock would stand."""
    rng = np.random.default_rng(1)
    phases = set()
    for _ in range(3000):
        since = rng.choice([0.0, 1e-9, 0.7, 30.0, 1e6])
        v = 10.0 ** rng.uniform(-18, 1) * rng.normal(size=2)
        w = 10.0 ** rng.uniform(-18, 1) * rng.normal(size=3) / RADIUS
        if rng.random() < 0.3:
            w[:2] = -v[1] / RADIUS, v[0] / RADIUS
        ball = begun(v, w, since)
        assert ball['phase_end'] > since
        phases.add(int(ball['phase']))
    assert phases == {RESTS, SLIDES, ROLLS}


def test_who_is_to_roll_does_whatever_slip_is_left():
    ball = begun((0.0, 1.0), (9.0, 9.0, 9.0), roll_only=True)
    assert ball['phase'] == ROLLS
    assert (ball['wx'], ball['wy'], ball['wz']) == (-32.0, 0.0, 9.0)


@pytest.mark.parametrize('frictionless', [Cloth(slide=0.0), Cloth(slide=0.0, roll=0.0)])
def test_without_friction_a_phase_never_ends(frictionless):
    ball = begun((1.0, 0.0), (0.0, 0.0, 0.0), table=frictionless)
    assert ball['phase'] == SLIDES and ball['phase_end'] == math.inf
    assert ball['ax'] == ball['ay'] == 0.0
    ball = begun((1.0, 0.0), (0.0, 32.0, 0.0), table=Cloth(roll=0.0))
    assert ball['phase'] == ROLLS and ball['phase_end'] == math.inf


def test_the_spin_that_is_left():
    assert left(3.0, Cloth(), 0.1) == 2.0 and left(-3.0, Cloth(), 0.1) == -2.0
    assert left(3.0, Cloth(), 0.3) == left(-3.0, Cloth(), 5.0) == left(0.0, Cloth(), 1.0) == 0.0
    assert left(3.0, Cloth(spin=0.0), 1e9) == 3.0
