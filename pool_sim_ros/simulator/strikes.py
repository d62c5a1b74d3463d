"""The strike that a request asks for, on the table that it is for."""

from __future__ import annotations

import math
from typing import NamedTuple

from pool_sim_ros.me212 import cue_velocity
from pool_sim_ros.physics import Table, cue_strike
from pool_sim_ros.simulator.refusals import RefusedError
from pool_sim_ros.simulator.settings import Settings
from pool_sim_ros.simulator.shot_request import Code, Request, Spin, Velocity

AT_REST = 0.0, 0.0, 0.0


class Strike(NamedTuple):
    """What sets off the cue ball.

    Attributes
    ----------
    velocity : tuple of float
        (x, y), m/s.
    spin : tuple of float or None
        (x, y, z), rad/s; None on a table of discs.
    """

    velocity: Velocity
    spin: Spin | None


def strike_of(request: Request, settings: Settings) -> Strike:
    """Return the strike of a readable request.

    Raises
    ------
    RefusedError
        Where there is no such shot, balls of this table do not spin, the cue would slip off or the
        cue ball would be too fast or not move.
    """
    strike = strike_on(settings.table, request)
    speed = math.hypot(*strike.velocity)
    if speed > settings.max_cue_speed:
        limit = f'max_cue_speed, {settings.max_cue_speed:g} m/s'
        raise RefusedError(Code.TOO_FAST, f'the speed {speed:g} m/s is above {limit}')
    return strike


def strike_on(table: Table, request: Request) -> Strike:
    """Return the strike of a readable request on a table; how fast does not matter.

    Raises
    ------
    RefusedError
        As `strike_of`.
    """
    spins = table.motion == 'ball'
    if request.shot is not None:
        try:
            velocity = cue_velocity(request.shot, table)
        except ValueError as error:
            raise RefusedError(Code.UNKNOWN_SHOT, str(error)) from None
        return Strike(velocity, AT_REST if spins else None)
    for name, value in (('spin', request.spin), ('cue', request.cue)):
        if value is not None and not spins:
            reason = f'{name}: balls do not spin on a table of motion disc; give velocity alone'
            raise RefusedError(Code.BAD_VELOCITY, reason)
    if request.cue is None:
        assert request.velocity is not None, 'a readable strike has a shot, a velocity or a cue'
        return Strike(request.velocity, (request.spin or AT_REST) if spins else None)
    try:
        linear, angular = cue_strike(table, **request.cue)
    except ValueError as error:
        raise RefusedError(Code.BAD_VELOCITY, f'cue: {error}') from None
    if not (linear.any() or angular.any()):
        raise RefusedError(Code.BAD_VELOCITY, 'cue: speed is zero; the cue ball would not move')
    (vx, vy), (wx, wy, wz) = linear.tolist(), angular.tolist()
    return Strike((vx, vy), (wx, wy, wz))
