"""The laws of one contact, and how the two sides of it rub.

`discs` has those of the report, for balls without spin; `two_ball` is the report's Part 1. Of balls
that spin, `spheres` has two, `edge` one and a cushion, `single` both as functions of numbers.
"""

from pool_sim_ros.physics.contacts.discs import (
    collide_disc_with_cushion,
    collide_discs,
    contact_normal,
    coulomb_impulse,
    reduced_mass,
    report_friction,
    restitution,
    rub_balls,
    rub_cushion,
    sign,
)
from pool_sim_ros.physics.contacts.edge import (
    EdgeLaw,
    collide_with_edge,
    friction_of_edge,
    from_contact_axes,
    lean_of,
    meet_edge,
    parting_of_push,
    to_contact_axes,
)
from pool_sim_ros.physics.contacts.laws import bounce, collide_pair
from pool_sim_ros.physics.contacts.rigid_edge import (
    lean_of_push,
    rebound,
    rigid_share,
    slip_at_edge,
)
from pool_sim_ros.physics.contacts.single import collide_balls, collide_cushion
from pool_sim_ros.physics.contacts.spheres import (
    BallLaw,
    Motion,
    collide_spheres,
    friction_bound,
    friction_of_balls,
    rub_spheres,
)
from pool_sim_ros.physics.contacts.two_ball import TwoBallCollision, two_ball_collision

__all__ = [
    'BallLaw',
    'EdgeLaw',
    'Motion',
    'TwoBallCollision',
    'bounce',
    'collide_balls',
    'collide_cushion',
    'collide_disc_with_cushion',
    'collide_discs',
    'collide_pair',
    'collide_spheres',
    'collide_with_edge',
    'contact_normal',
    'coulomb_impulse',
    'friction_bound',
    'friction_of_balls',
    'friction_of_edge',
    'from_contact_axes',
    'lean_of',
    'lean_of_push',
    'meet_edge',
    'parting_of_push',
    'rebound',
    'reduced_mass',
    'report_friction',
    'restitution',
    'rigid_share',
    'rub_balls',
    'rub_cushion',
    'rub_spheres',
    'sign',
    'slip_at_edge',
    'to_contact_axes',
    'two_ball_collision',
]
