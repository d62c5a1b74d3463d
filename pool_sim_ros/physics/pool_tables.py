"""The dimensions and coefficients of pool, snooker and carom tables, with their sources.

- '7ft': a Showood table, as pooltool 0.6.0 has it.
- '8ft', '9ft': *WPA Tables & Equipment Specifications*, the middle of each range: a corner mouth
  of 4 9/16 in and a side mouth of 5 1/16 in between pointed lips, cut at 142 and 104 degrees, with
  shelves of 1 5/8 and 3/16 in, noses at 63 1/2 % of a ball's diameter. It says nothing of how wide
  the holes are: they have the radii of the 7-foot table's.
- 'snooker': pooltool 0.6.0's generic table. The templates of the jaws that WPBSA authorises are not
  published; length and width are within WPBSA's rules, 3569 x 1778 mm, but for 25 and 32 mm.
- 'carom': UMB's rules: 2.84 x 1.42 m, no pockets, noses at 37 mm.

Coefficients and balls are those of pooltool 0.6.0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.cushions import Cushions
from pool_sim_ros.physics.pocket_geometry import Mouth, pocket_table
from pool_sim_ros.physics.racks import RackKind
from pool_sim_ros.physics.units import INCH

PoolTableName = Literal['7ft', '8ft', '9ft', 'snooker', 'carom']
"""The name of a table, as `pool_table` takes it."""
POOL_TABLES: tuple[PoolTableName, ...] = get_args(PoolTableName)
"""All of them."""

SPIN_DECAY = 4.0 / 9.0
"""mu_spin over the radius of the ball, as pooltool has it."""


@dataclass(frozen=True)
class PoolTable:
    """A table without its balls: all that its name stands for.

    Attributes
    ----------
    length, width : float
        Between the straight cushions, m.
    nose_height : float
        m.
    ball_radius, ball_mass : float
        m, kg.
    mu_slide, mu_roll, mu_ball_cushion : float
        Coefficients of friction.
    cushions : Cushions or None
        None for four straight cushions.
    pockets : ndarray of shape (q, 3)
        Rows of x, y and radius, m.
    rack : RackKind
        What is racked on it, as `rack` has it.
    """

    length: float
    width: float
    nose_height: float
    ball_radius: float
    ball_mass: float
    mu_slide: float
    mu_roll: float
    mu_ball_cushion: float
    cushions: Cushions | None
    pockets: NDArray[np.float64]
    rack: RackKind

    @property
    def mu_spin(self) -> float:
        """Coefficient, in m, by which spin in place ends: wz' = -5 mu_spin g / (2 R)."""
        return SPIN_DECAY * self.ball_radius

    def fields(self) -> dict[str, Any]:
        """Return the fields of `Table` but for its balls: what is dissipated where, and how."""
        return dict(
            length=self.length,
            width=self.width,
            motion='ball',
            mu_slide=self.mu_slide,
            mu_roll=self.mu_roll,
            mu_spin=self.mu_spin,
            mu_ball_cushion=self.mu_ball_cushion,
            e_cue_ball=E_BALL_BALL,
            e_ball_ball=E_BALL_BALL,
            e_ball_cushion=E_BALL_CUSHION,
            gravity=GRAVITY,
            ball_friction='alciatore',
            friction_bound='impulse',
            cushion_model='han',
            nose_height=self.nose_height,
            cushions=self.cushions,
            pockets=self.pockets,
        )


GRAVITY = 9.80665
"""Standard gravity, m/s^2."""

E_BALL_BALL = 0.95
E_BALL_CUSHION = 0.85
"""Coefficients of restitution of all these tables (pooltool 0.6.0)."""

POOL_RADIUS = 1.125 * INCH
POOL_BALL = dict(
    ball_radius=POOL_RADIUS, ball_mass=0.170097, mu_slide=0.2, mu_roll=0.01, mu_ball_cushion=0.2
)
SNOOKER_BALL = dict(
    ball_radius=0.02619375, ball_mass=0.140, mu_slide=0.5, mu_roll=0.01, mu_ball_cushion=0.5
)
CAROM_BALL = dict(
    ball_radius=0.03075, ball_mass=0.210, mu_slide=0.2, mu_roll=0.01, mu_ball_cushion=0.15
)

SHOWOOD = (
    Mouth(width=0.118, slope=45.0 + 5.3, depth=0.0417, hole=0.062, nose=0.02095),
    Mouth(
        width=0.137,
        slope=7.14,
        depth=0.0685,
        hole=0.0645,
        nose=0.00795,
        # The sine, where the tangent is meant: so the side jaws are 0.07 degrees from 7.14.
        slant=math.sin(math.radians(7.14)),
    ),
)
SNOOKER = (
    Mouth(width=0.083, slope=45.0, depth=0.036, hole=0.043, nose=3.6 * INCH),
    Mouth(width=0.075, slope=0.0, depth=0.95 * INCH, hole=1.68 * INCH, nose=2.5 * INCH),
)


def _wpa_mouths() -> tuple[Mouth, Mouth]:
    """Return WPA's: a shelf reaches from the line between the lips to the hole."""
    corner, side = SHOWOOD
    lips, shelf = 4.5625 * INCH, 1.625 * INCH
    side_shelf = 0.1875 * INCH
    return (
        Mouth(lips, 142.0 - 90.0, shelf - lips / 2.0 + corner.hole, corner.hole, 0.0),
        Mouth(5.0625 * INCH, 104.0 - 90.0, side_shelf + side.hole, side.hole, 0.0),
    )


WPA = _wpa_mouths()
CUSHION_WIDTH = 2.0 * INCH
SNOOKER_CUSHION_WIDTH = 1.55 * INCH
"""How far the jaws reach out from the straight cushions, m."""


def pool_table_dimensions(name: PoolTableName) -> PoolTable:
    """Return the dimensions and coefficients of a table.

    Parameters
    ----------
    name : {'7ft', '8ft', '9ft', 'snooker', 'carom'}

    Returns
    -------
    PoolTable

    Raises
    ------
    ValueError
        For another name.
    """
    if name == '7ft':
        return _pool(1.9812, 1.9812 / 2, 0.64 * 2 * POOL_RADIUS, SHOWOOD)
    if name == '8ft':
        return _pool(92 * INCH, 46 * INCH, 0.635 * 2 * POOL_RADIUS, WPA)
    if name == '9ft':
        return _pool(100 * INCH, 50 * INCH, 0.635 * 2 * POOL_RADIUS, WPA)
    if name == 'snooker':
        length, width = 3.5445, 1.7465
        cushions, pockets = pocket_table(length, width, *SNOOKER, SNOOKER_CUSHION_WIDTH)
        return PoolTable(
            length, width, 0.028, **SNOOKER_BALL, cushions=cushions, pockets=pockets, rack='snooker'
        )
    if name == 'carom':
        return PoolTable(
            2.84, 1.42, 0.037, **CAROM_BALL, cushions=None, pockets=np.empty((0, 3)), rack='carom'
        )
    known = ', '.join(repr(each) for each in POOL_TABLES)
    raise ValueError(f'name: {name!r} is no table; there are {known}')


def _pool(
    length: float, width: float, nose_height: float, mouths: tuple[Mouth, Mouth]
) -> PoolTable:
    cushions, pockets = pocket_table(length, width, *mouths, CUSHION_WIDTH)
    return PoolTable(
        length,
        width,
        nose_height,
        **POOL_BALL,
        cushions=cushions,
        pockets=pockets,
        rack='eight_ball',
    )
