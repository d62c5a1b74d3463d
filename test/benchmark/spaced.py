"""Play a shot contact by contact as pooltool does where that differs: for the comparison only.

pooltool moves two balls that meet, or a ball and a cushion, until they are a micrometre apart, and
resolves the contact there. Of two balls that then go nearly the same way, the one that is faster
along the line of centres gives a tenth of that speed to the other.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table, Trajectory, collide_balls, collide_cushion, simulate
from pool_sim_ros.physics.tolerances import OVERLAP

Array = NDArray[np.float64]

SPACING = 1e-6
"""How far apart pooltool moves what touches, m."""

MOST_MOVED = 5.0 * SPACING
"""Where it would move them farther along their velocities, it moves them along the normal."""

SAME_WAY, SAME_SPEED, GIVEN = 0.9, 0.01, 0.1
"""Cosine of the angle from which on two balls go the same way; difference of their speeds along the
line of centres below which one gives to the other, m/s; and the part of its own that it gives."""

BALL_BALL, CUSHION, POCKETED = 0, 1, 3


class Contact(NamedTuple):
    """Two balls, a ball and a cushion, or a ball and a pocket; time in s."""

    t: float
    kind: int
    a: int
    b: int


class PushedInError(ValueError):
    """Two balls were moved apart, and one of them into a third."""


class Played(NamedTuple):
    """What is compared of a shot; final positions (n, 2) in m."""

    contacts: list[Contact]
    final: Array


def play(table: Table, positions: Array, velocities: Array, spins: Array) -> Played:
    """Play a shot as the engine does."""
    shot = simulate(table, velocities, spins=spins, positions=positions)
    return Played(_contacts(shot, 0.0), shot.final_positions)


def play_spaced(
    table: Table, positions: Array, velocities: Array, spins: Array, most: int = 2000
) -> Played:
    """Play a shot by the engine up to its next contact, which is resolved apart, and so on.

    Raises
    ------
    PushedInError
        Where the spacing moves a ball into a third.
    RuntimeError
        Where there are more than `most` contacts.
    """
    contacts: list[Contact] = []
    moves = positions.copy(), velocities.copy(), spins.copy()
    now = 0.0
    while True:
        shot = simulate(table, moves[1], spins=moves[2], positions=moves[0])
        coming = _contacts(shot, now)
        first = next((k for k, c in enumerate(coming) if c.kind != POCKETED), len(coming))
        contacts += coming[: first + 1]
        if first == len(coming):
            return Played(contacts, shot.final_positions)
        if len(contacts) > most:
            raise RuntimeError(f'more than {most} contacts')
        event = shot.events[np.isin(shot.events['kind'], (BALL_BALL, CUSHION, POCKETED))][first]
        moves = _before(shot, event)
        now += float(event['t'])
        if event['kind'] == BALL_BALL:
            _resolve_balls(table, moves, int(event['a']), int(event['b']))
            _check_apart(table, moves[0])
        else:
            _resolve_cushion(table, moves, event)


def _check_apart(table: Table, positions: Array) -> None:
    away = positions[:, np.newaxis] - positions
    distances = np.hypot(*np.moveaxis(away, 2, 0))[np.triu_indices(len(positions), 1)]
    # Caught balls lie in one another.
    if np.any((distances < 2.0 * table.balls[0].radius - OVERLAP) & (distances > 0.0)):
        raise PushedInError('the spacing moves a ball into a third')


def _contacts(shot: Trajectory, since: float) -> list[Contact]:
    return [
        Contact(since + float(e['t']), int(e['kind']), int(e['a']), int(e['b']))
        for e in shot.events
        if e['kind'] in (BALL_BALL, CUSHION, POCKETED)
    ]


def _before(shot: Trajectory, event: np.void) -> tuple[Array, Array, Array]:
    """Return positions, velocities and spins just before an event."""
    t = float(event['t'])
    positions, velocities, spins = shot.positions(t), shot.velocities(t), shot.spins(t)
    for ball in (event['a'], event['b']) if event['kind'] == BALL_BALL else (event['a'],):
        earlier = shot.segments[(shot.segments['ball'] == ball) & (shot.segments['t'] < t)]
        if not len(earlier):
            continue
        last = earlier[-1]
        gone = t - last['t']
        velocities[ball] = (last['vx'] + last['ax'] * gone, last['vy'] + last['ay'] * gone)
        slowed = max(abs(last['wz']) - shot.table.for_kernels.spin * gone, 0.0)
        spins[ball] = (
            last['wx'] + last['turn_x'] * gone,
            last['wy'] + last['turn_y'] * gone,
            math.copysign(slowed, last['wz']),
        )
    return positions, velocities, spins


def _resolve_balls(table: Table, moves: tuple[Array, Array, Array], a: int, b: int) -> None:
    x, v, w = moves
    radius = table.balls[a].radius
    apart, closing = x[b] - x[a], v[b] - v[a]
    wanted = 2.0 * radius + SPACING
    gone = _earlier(closing @ closing, apart @ closing, apart @ apart - wanted**2)
    if gone is not None and np.hypot(*(gone * (v[a] + v[b]) / 2.0)) <= MOST_MOVED:
        x[a] += gone * v[a]
        x[b] += gone * v[b]
    else:
        distance = np.hypot(*apart)
        x[a] -= (wanted - distance) / 2.0 * apart / distance
        x[b] += (wanted - distance) / 2.0 * apart / distance
    v1, w1, v2, w2 = collide_balls(
        (*v[a], 0.0),
        w[a],
        (*v[b], 0.0),
        w[b],
        x[b] - x[a],
        m1=table.masses[a],
        m2=table.masses[b],
        R=radius,
        e=table.e_ball_ball,
        friction='alciatore' if table.ball_friction == 'alciatore' else table.mu_ball_ball,
        friction_bound=table.friction_bound,
    )
    v[a], w[a], v[b], w[b] = v1[:2], w1, v2[:2], w2
    _give(v, a, b, (x[b] - x[a]) / np.hypot(*(x[b] - x[a])))


def _give(velocities: Array, a: int, b: int, normal: Array) -> None:
    one, other = velocities[a], velocities[b]
    speeds = np.hypot(*one) * np.hypot(*other)
    along, other_along = one @ normal, other @ normal
    if abs(along - other_along) < SAME_SPEED and speeds and one @ other > SAME_WAY * speeds:
        given = GIVEN * (along if along > other_along else -other_along) * normal
        velocities[a] = one - given
        velocities[b] = other + given


def _resolve_cushion(table: Table, moves: tuple[Array, Array, Array], event: np.void) -> None:
    x, v, w = moves
    ball, row = int(event['a']), int(event['b'])
    normal = np.array([event['nx'], event['ny']])
    radius = table.balls[ball].radius
    # From the centre to where the cushion's edge is.
    near = np.array([event['x'], event['y']]) - x[ball]
    nose = 0.0
    if table.cushions is not None and row >= len(table.cushions.segments):
        *centre, nose = table.cushions.noses[row - len(table.cushions.segments)]
        near = np.array(centre) - x[ball]
    wanted = radius + nose + SPACING
    if nose:
        gone = _earlier(v[ball] @ v[ball], -near @ v[ball], near @ near - wanted**2)
    else:
        closing = v[ball] @ normal
        gone = (near @ normal - wanted) / closing if closing else None
    if gone is not None and abs(gone) * np.hypot(*v[ball]) <= MOST_MOVED:
        x[ball] += gone * v[ball]
    else:
        x[ball] -= (wanted - near @ normal) * normal
    if nose:
        normal = np.array(centre) - x[ball]
    velocity, w[ball] = collide_cushion(
        (*v[ball], 0.0),
        w[ball],
        normal,
        R=radius,
        h=table.nose_height,
        e=table.e_ball_cushion,
        f=table.mu_ball_cushion,
        model=table.cushion_model,
        mu_slide=table.mu_slide,
        # In some models the edge pushes from where it is, now a little farther from the centre.
        nose_radius=nose + SPACING,
    )
    v[ball] = velocity[:2]


def _earlier(square: float, half_linear: float, constant: float) -> float | None:
    """Return the root nearest to 0 of square t^2 + 2 half_linear t + constant, None for none."""
    under = half_linear**2 - square * constant
    if square == 0.0 or under < 0.0:
        return None
    far = -half_linear - math.copysign(math.sqrt(under), half_linear)
    return constant / far if far else 0.0
