"""The laws of one contact, and how the two sides of it rub.

`discs` has those of the report, for balls without spin; `two_ball` is the report's Part 1.
"""

from pool_sim_ros.physics.contacts.discs import (
    collide_balls,
    collide_cushion,
    contact_normal,
    coulomb_impulse,
    report_friction,
    restitution,
    rub_balls,
    rub_cushion,
    sign,
)
from pool_sim_ros.physics.contacts.two_ball import TwoBallCollision, two_ball_collision

__all__ = [
    'TwoBallCollision',
    'collide_balls',
    'collide_cushion',
    'contact_normal',
    'coulomb_impulse',
    'report_friction',
    'restitution',
    'rub_balls',
    'rub_cushion',
    'sign',
    'two_ball_collision',
]
