"""The law of one contact, as the engine asks for it: the type of the table chooses it."""

from __future__ import annotations

from typing import Any

from pool_sim_ros.physics.boundary import (
    from_cushion_axes,
    nose_radius,
    put_on_cushion,
    to_cushion_axes,
)
from pool_sim_ros.physics.contacts.discs import (
    collide_disc_with_cushion,
    collide_discs,
    restitution,
)
from pool_sim_ros.physics.contacts.edge import collide_with_edge
from pool_sim_ros.physics.contacts.spheres import collide_spheres
from pool_sim_ros.physics.jit import Record, chosen_by, register
from pool_sim_ros.physics.motion import BallTable, DiscTable

Velocity = tuple[float, float]


@chosen_by('table')
def collide_pair(
    table: Any,
    one: Record,
    other: Record,
    va: Velocity,
    vb: Velocity,
    normal: Velocity,
    parting: float,
) -> tuple[Velocity, Velocity]:
    """Return both velocities after a contact of two balls that nothing else touches.

    Spins change in the records.

    Parameters
    ----------
    table : named tuple
    one, other : Record
        The balls, whose motion begins at the contact.
    va, vb : tuple of float
        Their velocities before, m/s.
    normal : tuple of float
        Unit vector from one to the other.
    parting : float
        Speed at which they part along it, m/s.
    """
    raise NotImplementedError


@chosen_by('table')
def bounce(
    table: Any,
    ball: Record,
    cushion: int,
    normal: Velocity,
    velocity: Velocity,
    speeds: tuple[float, float],
) -> Velocity:
    """Return a ball's velocity after a contact with a cushion that nothing else touches.

    Arguments are as those of `collide_pair`, but for `speeds`: that at which they part by the
    restitution, which a disc does, and the least, where the law makes less of it, m/s.
    """
    raise NotImplementedError


def _collide_discs(
    table: DiscTable,
    one: Record,
    other: Record,
    va: Velocity,
    vb: Velocity,
    normal: Velocity,
    parting: float,
) -> tuple[Velocity, Velocity]:
    inverse_masses = one.inverse_mass, other.inverse_mass
    return collide_discs(table, va, vb, normal, inverse_masses, parting)


def _bounce_disc(
    table: DiscTable,
    ball: Record,
    cushion: int,
    normal: Velocity,
    velocity: Velocity,
    speeds: tuple[float, float],
) -> Velocity:
    boundary = table.boundary
    along, across = to_cushion_axes(boundary, cushion, normal, velocity)
    along, across = collide_disc_with_cushion(table, along, across, speeds[0])
    return from_cushion_axes(boundary, cushion, normal, (along, across))


def _collide_spheres(
    table: BallTable,
    one: Record,
    other: Record,
    va: Velocity,
    vb: Velocity,
    normal: Velocity,
    parting: float,
) -> tuple[Velocity, Velocity]:
    inverse_masses = one.inverse_mass, other.inverse_mass
    e = restitution(table, one.is_cue, other.is_cue)
    (va, wa), (vb, wb) = collide_spheres(
        table.rubbing,
        (va, (one.wx, one.wy, one.wz)),
        (vb, (other.wx, other.wy, other.wz)),
        normal,
        table.radius,
        inverse_masses,
        (e, parting),
    )
    one.wx, one.wy, one.wz = wa
    other.wx, other.wy, other.wz = wb
    return va, vb


def _bounce_sphere(
    table: BallTable,
    ball: Record,
    cushion: int,
    normal: Velocity,
    velocity: Velocity,
    speeds: tuple[float, float],
) -> Velocity:
    boundary, radius = table.boundary, table.radius
    # Exactly there: rounding would press a ball that goes on along the rail.
    ball.x, ball.y = put_on_cushion(boundary, cushion, ball.x, ball.y, radius)
    radii = radius, nose_radius(boundary, cushion)
    spin = ball.wx, ball.wy, ball.wz
    velocity, (ball.wx, ball.wy, ball.wz) = collide_with_edge(
        table.edge, velocity, spin, normal, radii, speeds[1]
    )
    return velocity


register(collide_pair, DiscTable, _collide_discs)
register(collide_pair, BallTable, _collide_spheres)
register(bounce, DiscTable, _bounce_disc)
register(bounce, BallTable, _bounce_sphere)
