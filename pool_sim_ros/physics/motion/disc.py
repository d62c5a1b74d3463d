"""How a ball moves between two contacts, and the records that the kernels work on.

A ball rolls along a straight line and loses speed at a constant rate until it
rests, so its position is a parabola in time (report, Equation 10).
"""

from typing import NamedTuple

import numpy as np

from pool_sim_ros.physics.jit import inlined

BALL = np.dtype(
    [
        ('x', 'f8'),  # position at `since`, m
        ('y', 'f8'),
        ('ux', 'f8'),  # unit direction of motion; zero at rest
        ('uy', 'f8'),
        ('speed', 'f8'),  # at `since`, m/s; zero at rest
        ('since', 'f8'),  # when this motion began, s
        ('radius', 'f8'),
        ('contact', 'f8'),  # when its next contact or stop is due, s; inf for none
        ('crossing', 'f8'),  # when it leaves its cell, s; inf for never
        ('inverse_mass', 'f8'),
        ('touched', 'f8'),  # when it last was in a contact, s
        ('partner', 'i4'),  # what it meets at `contact`: a ball, or a cushion or STOP as below
        ('partner_changes', 'i4'),  # the partner's `changes` when this was found
        ('changes', 'i4'),  # how often its motion has changed
        ('cell_x', 'i4'),
        ('cell_y', 'i4'),
        ('before', 'i4'),  # the ball before it in its cell; -1 for none
        ('repeats', 'i2'),  # weak contacts in quick succession, up to now
        ('rounds', 'i2'),  # contacts in the rattle that `touched` belongs to
        ('is_cue', 'i4'),
    ],
    align=True,
)
"""The state of one ball in the event-driven engine: two cache lines."""

STOP = -1
CUSHION_X0, CUSHION_X1, CUSHION_Y0, CUSHION_Y1 = -2, -3, -4, -5


class World(NamedTuple):
    """What the kernels know of the table."""

    length: float
    width: float
    deceleration: float
    mu_ball_ball: float
    mu_ball_cushion: float
    e_cue_ball: float
    e_ball_ball: float
    e_ball_cushion: float
    coulomb: bool


def copied(records: np.ndarray) -> np.ndarray:
    """Return a copy of records, byte by byte: numpy goes field by field, which takes longer."""
    return records.view(f'V{records.itemsize}').copy().view(records.dtype)


@inlined
def position_at(ball, t, deceleration):
    """Return (x, y) in m of a ball whose motion lasts until `t` at least.

    At rest that is exactly where it is: its direction is zero.
    """
    elapsed = t - ball.since
    way = elapsed * (ball.speed - 0.5 * deceleration * elapsed)
    return ball.x + ball.ux * way, ball.y + ball.uy * way


@inlined
def speed_at(ball, t, deceleration):
    """Return the speed in m/s at `t`, zero from the stop on."""
    return max(ball.speed - deceleration * (t - ball.since), 0.0)


@inlined
def stop_time(ball, deceleration):
    """Return when a moving ball comes to rest if nothing is in its way, s."""
    return ball.since + ball.speed / deceleration


@inlined
def set_velocity(ball, vx, vy):
    """Set off at (vx, vy) in m/s from where the ball is."""
    speed = np.sqrt(vx * vx + vy * vy)
    if speed == 0.0:
        ball.ux, ball.uy, ball.speed = 0.0, 0.0, 0.0
    else:
        inverse = 1.0 / speed
        ball.ux, ball.uy, ball.speed = vx * inverse, vy * inverse, speed
    ball.changes += 1
