"""How fast the two sides of a contact part, where they may bounce infinitely often in finite time.

What meets weakly, and again within a moment, parts a little faster each time, up to V_MIN; a ball
that meets a cushion so stays there. A ball that rattles between others parts at V_MIN after
MAX_ROUNDS contacts; after LAST_ROUND all that touches moves as one.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.contacts import restitution
from pool_sim_ros.physics.jit import Record, inlined
from pool_sim_ros.physics.tolerances import (
    COLLAPSE_GROWTH,
    LAST_ROUND,
    MAX_REPEATS,
    REPEAT_WINDOW,
    ROUND,
    V_MIN,
    V_ROUNDING,
)


@inlined
def rounds_at(balls: NDArray[np.void], a: int, b: int, now: float) -> int:
    """Return how many contacts the more stricken of two balls has had in a rattle up to now."""
    rounds = balls[a].rounds if now - balls[a].last_contact_time < ROUND else 0
    if b >= 0 and now - balls[b].last_contact_time < ROUND:
        rounds = max(rounds, balls[b].rounds)
    return rounds


@inlined
def count_round(ball: Record, now: float) -> None:
    """Count a contact of a ball at `now`, s."""
    again = now - ball.last_contact_time < ROUND
    ball.rounds = min(ball.rounds, LAST_ROUND) + 1 if again else 1
    ball.last_contact_time = now


@inlined
def separation_speed(
    balls: NDArray[np.void], table: Any, a: int, b: int, closing: float, now: float
) -> float:
    """Return the speed in m/s at which the two sides of a contact are to part.

    Parameters
    ----------
    balls : ndarray
        The repeats of weak contacts are counted in them.
    table : named tuple
    a, b : int
        A ball, and a ball or a cushion.
    closing : float
        Speed at which they meet, m/s.
    now : float
        s.
    """
    closing = max(closing, 0.0)
    if b < 0:
        again = closing <= V_MIN and now - balls[a].last_contact_time < REPEAT_WINDOW
        return 0.0 if again else table.e_ball_cushion * closing
    parting = restitution(table, balls[a].is_cue, balls[b].is_cue) * closing
    if closing > V_MIN:
        return parting
    repeats = 0
    last_contact_time = max(balls[a].last_contact_time, balls[b].last_contact_time)
    if now - last_contact_time < REPEAT_WINDOW:
        repeats = min(max(balls[a].repeats, balls[b].repeats) + 1, MAX_REPEATS)
    balls[a].repeats = repeats
    balls[b].repeats = repeats
    return max(parting, min(V_MIN, V_ROUNDING * COLLAPSE_GROWTH**repeats))
