"""One contact of balls that spin, as functions of numbers: for planners, tests and teaching."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics.balls import MASSES, RADII
from pool_sim_ros.physics.contacts.edge import EdgeLaw, collide_with_edge
from pool_sim_ros.physics.contacts.spheres import BallLaw, collide_spheres
from pool_sim_ros.physics.law_names import (
    CUSHION_MODELS,
    FRICTION_BOUNDS,
    CushionModel,
    FrictionBound,
    number_of,
)
from pool_sim_ros.physics.tolerances import MAX_FRICTION, MAX_SPEED, MAX_SPIN
from pool_sim_ros.physics.validation import number, numbers

Vector = NDArray[np.float64]

HEIGHTS = (0.5, 2.0)
"""Heights of the edge of a cushion, in radii of the ball: an edge below or above passes it by."""


def collide_balls(
    v1: ArrayLike,
    w1: ArrayLike,
    v2: ArrayLike,
    w2: ArrayLike,
    normal: ArrayLike,
    *,
    m1: float,
    m2: float,
    R: float,  # noqa: N803 (the field's name)
    e: float,
    friction: float | Literal['alciatore'],
    friction_bound: FrictionBound = 'impulse',
) -> tuple[Vector, Vector, Vector, Vector]:
    """Return the motion of two balls that spin after they have hit each other.

    Balls that do not approach each other keep their motion.

    Parameters
    ----------
    v1, v2 : array_like of shape (3,)
        Velocities in the axes of the table, m/s; z is 0.
    w1, w2 : array_like of shape (3,)
        Spins, rad/s, z up.
    normal : array_like of shape (2,) or (3,)
        From ball 1 to ball 2, of any length; z is 0.
    m1, m2 : float
        Masses, kg.
    R : float
        Radius of both, m.
    e : float
        Coefficient of restitution, 0 to 1.
    friction : float or 'alciatore'
        Coefficient of friction; or Alciatore's, which falls with the slip.
    friction_bound : {'impulse', 'restitution'}, optional
        What bounds friction: the normal impulse, or e times the closing speed instead of (1 + e)/2
        times, as in pooltool 0.6.0.

    Returns
    -------
    v1, w1, v2, w2 : ndarray of shape (3,)
        m/s and rad/s.

    Raises
    ------
    ValueError
        Where a value is not finite or out of its range; names it.
    """
    motion1, motion2 = _motion('1', v1, w1), _motion('2', v2, w2)
    direction = _direction(normal)
    m1, m2 = number('m1', m1, *MASSES), number('m2', m2, *MASSES)
    radius = number('R', R, *RADII)
    e = number('e', e, 0.0, 1.0)
    alciatore = isinstance(friction, str) and friction == 'alciatore'
    if isinstance(friction, str) and not alciatore:
        raise ValueError(f"friction: {friction!r} must be a number or 'alciatore'")
    mu = 0.0 if alciatore else number('friction', friction, 0.0, MAX_FRICTION)
    by_restitution = number_of('friction_bound', friction_bound, FRICTION_BOUNDS) == 1
    law = BallLaw(mu, alciatore, by_restitution)
    closing = sum((a - b) * n for a, b, n in zip(motion1[0], motion2[0], direction, strict=True))
    if closing > 0.0:
        inverses = 1.0 / m1, 1.0 / m2
        motion1, motion2 = collide_spheres(
            law, motion1, motion2, direction, radius, inverses, (e, e * closing)
        )
    return *_arrays(motion1), *_arrays(motion2)


def collide_cushion(
    v: ArrayLike,
    w: ArrayLike,
    normal: ArrayLike,
    *,
    R: float,  # noqa: N803 (the field's name)
    h: float,
    e: float,
    f: float,
    model: CushionModel,
    mu_slide: float | None = None,
    nose_radius: float = 0.0,
) -> tuple[Vector, Vector]:
    """Return the motion of a ball that spins after it has hit a cushion.

    A ball that does not approach the cushion keeps its motion. One that friction would send on into
    the cushion stays at it.

    Parameters
    ----------
    v : array_like of shape (3,)
        Velocity in the axes of the table, m/s; z is 0.
    w : array_like of shape (3,)
        Spin, rad/s, z up.
    normal : array_like of shape (2,) or (3,)
        From the ball into the cushion, at a nose towards its centre, of any length; z is 0.
    R : float
        Radius of the ball, m.
    h : float
        Height of the cushion's edge, m; more than half a radius and less than two.
    e : float
        Coefficient of restitution, 0 to 1.
    f : float
        Coefficient of friction of ball and cushion.
    model : {'han', 'impulse', 'stronge', 'mathavan'}
        See docs/physics.md.
    mu_slide : float, optional
        Coefficient of friction of ball and cloth, which 'mathavan' needs.
    nose_radius : float, optional
        Radius of a round nose, m; 0 for a straight cushion.

    Returns
    -------
    v, w : ndarray of shape (3,)
        m/s and rad/s.

    Raises
    ------
    ValueError
        Where a value is not finite or out of its range; names it.
    """
    motion = _motion('', v, w)
    direction = _direction(normal)
    radius = number('R', R, *RADII)
    height = number('h', h)
    least, most = (share * radius for share in HEIGHTS)
    if not least < height < most:
        raise ValueError(f'h: {height} must be above {least:g} and below {most:g}, 0.5 R and 2 R')
    e, f = number('e', e, 0.0, 1.0), number('f', f, 0.0, MAX_FRICTION)
    nose = number('nose_radius', nose_radius, 0.0, RADII[1])
    index = number_of('model', model, CUSHION_MODELS)
    if model == 'mathavan' and mu_slide is None:
        raise ValueError("mu_slide: None; the model 'mathavan' needs the friction of the cloth")
    on_cloth = 0.0 if mu_slide is None else number('mu_slide', mu_slide, 0.0, MAX_FRICTION)
    if sum(a * n for a, n in zip(motion[0], direction, strict=True)) > 0.0:
        law = EdgeLaw(index, e, f, height, on_cloth)
        motion = collide_with_edge(law, *motion, direction, (radius, nose), 0.0)
    return _arrays(motion)


_Motion = tuple[tuple[float, float], tuple[float, float, float]]


def _motion(number_of_ball: str, v: ArrayLike, w: ArrayLike) -> _Motion:
    vx, vy, vz = numbers(f'v{number_of_ball}', v, 3, -MAX_SPEED, MAX_SPEED)
    if vz != 0.0:
        raise ValueError(f'v{number_of_ball}: {vz} m/s along z must be 0: balls stay on the cloth')
    wx, wy, wz = numbers(f'w{number_of_ball}', w, 3, -MAX_SPIN, MAX_SPIN)
    return (vx, vy), (wx, wy, wz)


def _direction(normal: ArrayLike) -> tuple[float, float]:
    """Return the unit vector along `normal`."""
    given = np.asarray(normal, dtype=object)
    count = 2 if given.shape == (2,) else 3
    x, y, *z = numbers('normal', normal, count)
    if any(z):
        raise ValueError(f'normal: {z[0]} along z must be 0')
    # By its largest part first, so that no square over- or underflows.
    largest = max(abs(x), abs(y))
    if largest == 0.0:
        raise ValueError('normal: (0, 0) has no direction')
    x, y = x / largest, y / largest
    length = math.hypot(x, y)
    return x / length, y / length


def _arrays(motion: _Motion) -> tuple[Vector, Vector]:
    (vx, vy), w = motion
    return np.array([vx, vy, 0.0]), np.array(w)
