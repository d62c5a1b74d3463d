"""What the engine asks of a boundary.

The type of its named tuple chooses the implementation when the kernels are compiled. Cushions have
numbers, from 0; pockets have numbers of their own, from 0.
"""

from __future__ import annotations

from typing import Any

from pool_sim_ros.physics.jit import chosen_by, inlined

PHASE_END = -1
"""As the partner in a ball's next event: none, its phase of motion ends."""

FIRST_CUSHION = -2
"""As the partner in a ball's next event: cushion number 0; the others follow downwards."""


@inlined
def partner_of_cushion(cushion: int) -> int:
    """Return how a ball's next event names a cushion, by its number."""
    return FIRST_CUSHION - cushion


@inlined
def cushion_of_partner(partner: int) -> int:
    """Return the number of a cushion that a ball's next event names."""
    return FIRST_CUSHION - partner


@chosen_by('boundary')
def n_cushions(boundary: Any) -> int:
    """Return how many cushions there are."""
    raise NotImplementedError


@chosen_by('boundary')
def cushion_gap(boundary: Any, cushion: int, x: float, y: float, radius: float) -> float:
    """Return the gap in m between a cushion and a ball at (x, y); negative where they overlap."""
    raise NotImplementedError


@chosen_by('boundary')
def cushion_normal(boundary: Any, cushion: int, x: float, y: float) -> tuple[float, float]:
    """Return the unit vector from a ball at (x, y) into a cushion."""
    raise NotImplementedError


@chosen_by('boundary')
def distance_to_cushions(
    boundary: Any, x: float, y: float, ux: float, uy: float, radius: float
) -> tuple[float, int]:
    """Return how far a ball goes straight along (ux, uy) to the first cushion, and which.

    Parameters
    ----------
    boundary : Rectangle
    x, y : float
        Where it is, m.
    ux, uy : float
        Unit direction.
    radius : float
        m.

    Returns
    -------
    distance : float
        m, not negative; inf where there is none.
    partner : int
        The cushion as `partner_of_cushion` has it; PHASE_END for none.
    """
    raise NotImplementedError


@chosen_by('boundary')
def time_to_cushions(boundary: Any, path: Any, radius: float) -> tuple[float, int]:
    """Return the seconds until a ball on a curved path touches what bounds the cloth, and what.

    Parameters
    ----------
    boundary : named tuple
    path : CurvedPath
    radius : float
        m.

    Returns
    -------
    seconds : float
        inf where it touches nothing while the path lasts.
    partner : int
        A cushion or a pocket, as `partner_of_cushion` has it; PHASE_END for none.
    """
    raise NotImplementedError


@chosen_by('boundary')
def nose_radius(boundary: Any, cushion: int) -> float:
    """Return the radius of a round nose, m; 0 for a straight cushion."""
    raise NotImplementedError


@chosen_by('boundary')
def put_on_cushion(
    boundary: Any, cushion: int, x: float, y: float, radius: float
) -> tuple[float, float]:
    """Return the place next to (x, y), m, at which a ball touches a straight cushion exactly."""
    raise NotImplementedError


@chosen_by('boundary')
def is_pocket(boundary: Any, partner: int) -> bool:
    """Return whether a partner, which is no ball, is a pocket."""
    raise NotImplementedError


@chosen_by('boundary')
def pocket_of_partner(boundary: Any, partner: int) -> int:
    """Return the number of a pocket that a ball's next event names."""
    raise NotImplementedError


@chosen_by('boundary')
def pocket_at(boundary: Any, x: float, y: float) -> int:
    """Return the number of the pocket in whose circle (x, y) in m lies, -1 for none."""
    raise NotImplementedError


@chosen_by('boundary')
def pocket_centre(boundary: Any, pocket: int) -> tuple[float, float]:
    """Return the centre of a pocket, m."""
    raise NotImplementedError


@chosen_by('boundary')
def distance_to_mouths(boundary: Any, x: float, y: float) -> float:
    """Return how far (x, y) is at least from every pocket and from beyond the rails, m."""
    raise NotImplementedError


@chosen_by('boundary')
def to_cushion_axes(
    boundary: Any, cushion: int, normal: tuple[float, float], v: tuple[float, float]
) -> tuple[float, float]:
    """Return a vector's parts along the normal of a cushion and across it, each up to its sign."""
    raise NotImplementedError


@chosen_by('boundary')
def from_cushion_axes(
    boundary: Any, cushion: int, normal: tuple[float, float], v: tuple[float, float]
) -> tuple[float, float]:
    """Return the vector, (x, y), of which `to_cushion_axes` gives these parts."""
    raise NotImplementedError


@chosen_by('boundary')
def touches_cushion(boundary: Any, x: float, y: float, reach: float, but: int) -> bool:
    """Return whether any cushion but number `but` is within `reach` m of (x, y)."""
    raise NotImplementedError


@chosen_by('boundary')
def is_outside(boundary: Any, x: float, y: float, radius: float, tolerance: float) -> bool:
    """Return whether a ball at (x, y) overlaps a cushion by more than `tolerance` m, or is NaN."""
    raise NotImplementedError
