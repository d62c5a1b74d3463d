"""What bounds the cloth, and what a ball may touch there.

`seam` has what the engine asks of a boundary; `rectangle` is the report's, `pocketed` one of
straight cushions in any direction, round noses and pockets.
"""

from pool_sim_ros.physics.boundary import pocketed, rectangle, seam
from pool_sim_ros.physics.boundary.pocketed import PocketedBoundary, pocketed_boundary
from pool_sim_ros.physics.boundary.rectangle import Rectangle
from pool_sim_ros.physics.boundary.seam import (
    FIRST_CUSHION,
    PHASE_END,
    cushion_gap,
    cushion_normal,
    cushion_of_partner,
    distance_to_cushions,
    distance_to_mouths,
    from_cushion_axes,
    is_outside,
    is_pocket,
    n_cushions,
    nose_radius,
    partner_of_cushion,
    pocket_at,
    pocket_centre,
    pocket_of_partner,
    put_on_cushion,
    time_to_cushions,
    to_cushion_axes,
    touches_cushion,
)
from pool_sim_ros.physics.jit import register

__all__ = [
    'FIRST_CUSHION',
    'PHASE_END',
    'PocketedBoundary',
    'Rectangle',
    'cushion_gap',
    'cushion_normal',
    'cushion_of_partner',
    'distance_to_cushions',
    'distance_to_mouths',
    'from_cushion_axes',
    'is_outside',
    'is_pocket',
    'n_cushions',
    'nose_radius',
    'partner_of_cushion',
    'pocket_at',
    'pocket_centre',
    'pocket_of_partner',
    'pocketed_boundary',
    'put_on_cushion',
    'time_to_cushions',
    'to_cushion_axes',
    'touches_cushion',
]

CHOICES = (
    'n_cushions',
    'cushion_gap',
    'cushion_normal',
    'time_to_cushions',
    'nose_radius',
    'put_on_cushion',
    'is_pocket',
    'pocket_of_partner',
    'pocket_at',
    'pocket_centre',
    'distance_to_mouths',
    'to_cushion_axes',
    'from_cushion_axes',
    'touches_cushion',
    'is_outside',
)
"""The functions of `seam` that each kind of boundary implements."""

for _name in CHOICES:
    register(getattr(seam, _name), Rectangle, getattr(rectangle, _name))
    register(getattr(seam, _name), PocketedBoundary, getattr(pocketed, _name))
# Only discs ask for a distance, and they have no other boundary.
register(seam.distance_to_cushions, Rectangle, rectangle.distance_to_cushions)
