"""A ball as it is given. Bad values of its fields are in `test_bad_input`."""

import dataclasses

import numpy as np
import pytest

from pool_sim_ros.physics import Ball
from pool_sim_ros.physics.balls import MASSES, RADII, checked_balls

ONE = Ball('1', 0.17, 0.0286, (0.5, 0.25))


def test_numbers_become_floats_and_tuples():
    ball = Ball('1', np.float32(0.5), 1, np.array([1, 2]), [0, 0, 1], is_cue=1)
    assert (ball.mass, ball.radius, ball.position) == (0.5, 1.0, (1.0, 2.0))
    assert (ball.color, ball.is_cue) == ((0.0, 0.0, 1.0), True)
    assert type(ball.mass) is type(ball.position[0]) is float


@pytest.mark.parametrize('mass', MASSES)
@pytest.mark.parametrize('radius', RADII)
def test_the_ends_of_the_ranges_are_allowed(mass, radius):
    ball = Ball('1', mass, radius, (0.0, 0.0))
    assert (ball.mass, ball.radius) == (mass, radius)


def test_a_ball_cannot_be_changed_and_is_equal_by_value():
    with pytest.raises(dataclasses.FrozenInstanceError):
        ONE.mass = 1.0
    assert ONE == Ball('1', 0.17, 0.0286, (0.5, 0.25)) != dataclasses.replace(ONE, mass=0.2)
    assert len({ONE, dataclasses.replace(ONE)}) == 1


def test_balls_of_any_iterable():
    other = dataclasses.replace(ONE, label='2')
    assert checked_balls(iter([ONE, other])) == (ONE, other)


@pytest.mark.parametrize(
    ('balls', 'words'),
    [
        (5, 'balls: 5 is not a sequence of Ball'),
        ((), 'balls: there are none'),
        ((ONE, 'C'), r"balls\[1\]: 'C' is not a Ball"),
        ((ONE, ONE), r"balls\[1\]: label '1' is already that of balls\[0\]"),
    ],
)
def test_balls_that_are_none(balls, words):
    with pytest.raises(ValueError, match=f'^{words}') as caught:
        checked_balls(balls)
    assert '\n' not in str(caught.value)
