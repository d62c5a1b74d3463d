"""How fast the two sides of a contact part, where they may bounce infinitely often in finite time.

What meets weakly, and again within a moment, parts a little faster each time, up to V_MIN; a ball
that meets a cushion so stays there. Where something presses two balls together for long, they part
ever faster still, so that this does not take forever. A ball that rattles between others is parted
from all of them at once after MAX_ROUNDS contacts; after LAST_ROUND all that touches moves as one.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.contacts import restitution
from pool_sim_ros.physics.jit import Record, chosen_by, inlined, register
from pool_sim_ros.physics.motion import BallTable, DiscTable
from pool_sim_ros.physics.tolerances import (
    COLLAPSE_GROWTH,
    HELD_GROWTH,
    LAST_ROUND,
    LEAST_PARTING,
    MAX_PRESSES,
    MAX_REPEATS,
    MAX_ROUNDS,
    MOST_HELD,
    PRESS_GROWTH,
    PRESS_MARGIN,
    PRESS_WINDOW,
    REPEAT_WINDOW,
    ROUND,
    SETTLE_EVERY,
    STEADY_HELD,
    STEADY_PRESSES,
    V_MIN,
    V_ROUNDING,
)


@inlined
def rounds_of(ball: Record, now: float) -> int:
    """Return how many contacts a ball has had in a rattle up to now.

    A ball that rattled long may be pressed from both sides: for a while it counts as one that has
    just done so.
    """
    if now - ball.last_contact_time < ROUND:
        return ball.rounds
    pressed = ball.rounds > MAX_ROUNDS and now - ball.last_contact_time < PRESS_WINDOW
    return MAX_ROUNDS + 1 if pressed else 0


@inlined
def rounds_at(balls: NDArray[np.void], a: int, b: int, now: float) -> int:
    """Return `rounds_of` the more stricken of a ball and its partner, a ball or a cushion."""
    rounds = rounds_of(balls[a], now)
    return max(rounds, rounds_of(balls[b], now)) if b >= 0 else rounds


@inlined
def count_round(ball: Record, now: float) -> None:
    """Count a contact of a ball at `now`, s."""
    if now - ball.last_contact_time < ROUND:
        ball.rounds = min(ball.rounds, LAST_ROUND) + 1
    else:
        ball.rounds = max(rounds_of(ball, now), 1)
    ball.last_contact_time = now


@inlined
def presses_of(ball: Record, now: float) -> int:
    """Return how many weak contacts a ball has had over a while up to now."""
    return ball.presses if now - ball.last_contact_time < PRESS_WINDOW else 0


@inlined
def is_pressed(balls: NDArray[np.void], a: int, b: int, now: float) -> bool:
    """Return whether a contact has been weak so often that something presses its two sides."""
    presses = presses_of(balls[a], now)
    if b >= 0:
        presses = max(presses, presses_of(balls[b], now))
    return presses > STEADY_PRESSES


@inlined
def least_when_pressed(presses: int) -> float:
    """Return the speed in m/s at which a weak contact parts, after so many before it."""
    return V_MIN * PRESS_GROWTH ** (presses - STEADY_PRESSES)


@inlined
def keep_counts(balls: NDArray[np.void], a: int, b: int, repeats: int, presses: int) -> None:
    """Keep how often a contact was weak, where it was."""
    if repeats >= 0:
        balls[a].repeats, balls[a].presses = repeats, presses
        if b >= 0:
            balls[b].repeats, balls[b].presses = repeats, presses


@inlined
def raise_counts(balls: NDArray[np.void], i: int, repeats: int, presses: int) -> None:
    """Raise what `keep_counts` keeps in a ball to the counts of one more contact of it.

    Those of its own contacts alone: what a neighbour keeps would go on from contact to contact,
    as far as their order lets it.
    """
    if repeats >= 0:
        balls[i].repeats = max(balls[i].repeats, repeats)
        balls[i].presses = max(balls[i].presses, presses)


@chosen_by('table')
def separation_speed(
    table: Any,
    balls: NDArray[np.void],
    a: int,
    b: int,
    speeds: tuple[float, float],
    now: float,
) -> tuple[float, float, int, int]:
    """Return the speed in m/s at which the two sides of a contact are to part.

    Parameters
    ----------
    table : named tuple
        Its type chooses the rule.
    balls : ndarray
    a, b : int
        A ball, and a ball or a cushion.
    speeds : tuple of float
        The speed at which they meet, m/s, and the square of that of the slower of two balls.
    now : float
        s.

    Returns
    -------
    speed : float
        The restitution times the speed at which they meet; of a weak contact at least `least`.
    least : float
        What a contact parts at if its law makes less of it, as that of an edge may.
    repeats, presses : int
        Of a weak contact, to be kept in both balls: how many follow each other at once, and how
        many over a while. -1 for any other contact.
    """
    raise NotImplementedError


def disc_separation(
    table: DiscTable,
    balls: NDArray[np.void],
    a: int,
    b: int,
    speeds: tuple[float, float],
    now: float,
) -> tuple[float, float, int, int]:
    closing = max(speeds[0], 0.0)
    if b < 0:
        again = closing <= V_MIN and now - balls[a].last_contact_time < REPEAT_WINDOW
        return 0.0 if again else table.e_ball_cushion * closing, 0.0, -1, -1
    parting = restitution(table, balls[a].is_cue, balls[b].is_cue) * closing
    since = now - max(balls[a].last_contact_time, balls[b].last_contact_time)
    presses = 0
    if since < PRESS_WINDOW:
        presses = max(presses_of(balls[a], now), presses_of(balls[b], now)) + 1
    if presses > MAX_PRESSES:
        presses -= SETTLE_EVERY
    if presses > STEADY_PRESSES:
        least = least_when_pressed(presses)
        if closing <= PRESS_MARGIN * least:
            # What lies still presses nothing; and two that move may just go on together.
            settles = speeds[1] <= V_MIN * V_MIN or presses % SETTLE_EVERY == 0
            least = V_ROUNDING if settles else least
            return least, least, MAX_REPEATS, presses
    if closing > V_MIN:
        return parting, 0.0, -1, -1
    repeats = 0
    if since < REPEAT_WINDOW:
        repeats = min(max(balls[a].repeats, balls[b].repeats) + 1, MAX_REPEATS)
    least = min(V_MIN, V_ROUNDING * COLLAPSE_GROWTH**repeats)
    return max(parting, least), least, repeats, presses


def ball_separation(
    table: BallTable,
    balls: NDArray[np.void],
    a: int,
    b: int,
    speeds: tuple[float, float],
    now: float,
) -> tuple[float, float, int, int]:
    # Balls that roll on in contact meet again and again, as does one that its spin presses to a
    # cushion: more slowly than discs do, which have no such push.
    closing = max(speeds[0], 0.0)
    repeats, last_contact_time = balls[a].repeats, balls[a].last_contact_time
    if b < 0:
        parting = table.e_ball_cushion * closing
    else:
        parting = restitution(table, balls[a].is_cue, balls[b].is_cue) * closing
        repeats = max(repeats, balls[b].repeats)
        last_contact_time = max(last_contact_time, balls[b].last_contact_time)
    again = now - last_contact_time < PRESS_WINDOW
    repeats = min(repeats + 1, MOST_HELD) if again else 0
    # A ball that spins fast is pressed for long: this must end within few contacts.
    growth = HELD_GROWTH ** max(repeats - STEADY_HELD, 0)
    if closing > PRESS_MARGIN * growth * LEAST_PARTING:
        return parting, V_ROUNDING, -1, -1
    least = min(LEAST_PARTING, V_ROUNDING * COLLAPSE_GROWTH ** min(repeats, MAX_REPEATS)) * growth
    return max(parting, least), least, repeats, 0


register(separation_speed, DiscTable, disc_separation)
register(separation_speed, BallTable, ball_separation)
