"""What the engine asks of a motion.

The type of `table`, the named tuple that describes the table to the kernels, chooses the
implementation when they are compiled. A motion has phases, in each of which the acceleration is
constant. A ball at rest is in phase `RESTS`. A *path* is what a moving ball does from some instant
until its phase ends.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.contact_time import RelativeMotion
from pool_sim_ros.physics.jit import chosen_by


@chosen_by('table')
def position_at(ball: Any, table: Any, t: float) -> tuple[float, float]:
    """Return where a ball is at `t`, m; its phase must last until then."""
    raise NotImplementedError


@chosen_by('table')
def velocity_at(ball: Any, table: Any, t: float) -> tuple[float, float]:
    """Return the velocity of a ball at `t`, m/s; its phase must last until then."""
    raise NotImplementedError


@chosen_by('table')
def acceleration(ball: Any, table: Any) -> tuple[float, float]:
    """Return the acceleration of a ball in its present phase, m/s^2."""
    raise NotImplementedError


@chosen_by('table')
def set_off(ball: Any, table: Any, vx: float, vy: float) -> None:
    """Begin a new motion at (vx, vy) in m/s, from where the ball is."""
    raise NotImplementedError


@chosen_by('table')
def phase_end_time(ball: Any, table: Any) -> float:
    """Return when the present phase of a moving ball ends if it meets nothing, s."""
    raise NotImplementedError


@chosen_by('table')
def end_phase(ball: Any, table: Any, now: float) -> int:
    """Bring a ball to the end of its phase and begin the next one; return the kind of event."""
    raise NotImplementedError


@chosen_by('table')
def runs_away(ball: Any, table: Any, most: float) -> bool:
    """Return whether a ball has more than `most`, twice its kinetic energy in J."""
    raise NotImplementedError


@chosen_by('table')
def path_from(ball: Any, table: Any, now: float) -> Any:
    """Return the path of a moving ball from `now` on: a named tuple of the motion."""
    raise NotImplementedError


@chosen_by('table')
def time_to_boundary(path: Any, table: Any, ball: Any) -> tuple[float, int]:
    """Return the seconds until a ball touches the boundary, and its partner there.

    That is inf and PHASE_END where its phase ends before.
    """
    raise NotImplementedError


@chosen_by('table')
def time_to_cell_edge(
    path: Any, table: Any, x_low: float, x_high: float, y_low: float, y_high: float
) -> tuple[float, int, int]:
    """Return the seconds until a ball's centre leaves its cell, and the step to the next one.

    The edges are in m, infinite where there is none. The time is inf where the phase ends before.
    The step is (1, 0), (-1, 0), (0, 1) or (0, -1), in cells.
    """
    raise NotImplementedError


@chosen_by('table')
def first_resting_ball(
    path: Any, table: Any, radius: float, lasts: float, rows: NDArray[np.float64]
) -> tuple[float, int]:
    """Return the seconds until a ball touches one at rest, and which, on a table with few balls.

    Parameters
    ----------
    path : named tuple
    table : named tuple
    radius : float
        Of the ball, m.
    lasts : float
        Later contacts do not count, s.
    rows : ndarray of shape (4, n)
        Where the others rest, x and y, NaN for those that do not; their radii; room, m.

    Returns
    -------
    tuple of float and int
        The time is of no use where there is none, which is ball -1.
    """
    raise NotImplementedError


@chosen_by('table')
def first_resting_of(
    path: Any, table: Any, radius: float, lasts: float, balls: Any, listed: Any, count: int
) -> tuple[float, int]:
    """Return as `first_resting_ball`, for the first `count` numbers of balls in `listed`."""
    raise NotImplementedError


@chosen_by('table')
def time_to_resting_ball(path: Any, table: Any, dx: float, dy: float, touch: float) -> float:
    """Return the seconds until a moving ball touches one at rest at (dx, dy) from it; inf: never.

    `touch` is the sum of the radii, m.
    """
    raise NotImplementedError


@chosen_by('table')
def relative_motion(path: Any, table: Any, other: Any) -> RelativeMotion:
    """Return how the ball on path `other` moves relative to that on `path`."""
    raise NotImplementedError


@chosen_by('table')
def advance(ball: Any, table: Any, now: float) -> tuple[float, float]:
    """Let a ball's motion begin anew at `now`, s, and return its velocity, m/s."""
    raise NotImplementedError


@chosen_by('table')
def has_phases(table: Any) -> bool:
    """Return whether a ball may still move when a phase of its motion has ended."""
    raise NotImplementedError


@chosen_by('table')
def keep_path(ball: Any, table: Any, rows: NDArray[np.float64], i: int) -> None:
    """Note in column `i` of `rows`, those of few balls, how a ball moves, if `sift` needs it."""
    raise NotImplementedError


@chosen_by('table')
def sift(
    path: Any, table: Any, radius: float, times: tuple[float, float], rows: NDArray[np.float64]
) -> bool:
    """Mark in the fourth of `rows` which moving balls a path may touch; False where none is.

    The path is of a ball of `radius`, m. `times` are now, and for how long to look, s.
    """
    raise NotImplementedError


@chosen_by('table')
def touched_in_rows(
    table: Any,
    rows: NDArray[np.float64],
    place: tuple[float, float],
    near: float,
    pair: tuple[int, int],
    now: float,
) -> tuple[bool, bool]:
    """Return whether `rows` tell, and if so whether any ball but `pair` touches a circle at `now`.

    The circle has the radius `near` round `place`, m.
    """
    raise NotImplementedError


@chosen_by('table')
def rest_begins(ball: Any, table: Any) -> float:
    """Return when a ball that rests has stopped to spin too, s."""
    raise NotImplementedError


@chosen_by('table')
def give_spin(ball: Any, table: Any, wx: float, wy: float, wz: float) -> None:
    """Give a ball at rest its spin, rad/s."""
    raise NotImplementedError


@chosen_by('table')
def log_spin(segment: Any, ball: Any, table: Any) -> None:
    """Write down the spin of a ball at the start of a segment, where the motion has any."""
    raise NotImplementedError


@chosen_by('table')
def lie_at(ball: Any, table: Any, x: float, y: float) -> None:
    """Put a ball at rest to (x, y), m; in the circle of a pocket it is out of play."""
    raise NotImplementedError


@chosen_by('table')
def in_play(ball: Any, table: Any) -> bool:
    """Return whether a ball is on the cloth."""
    raise NotImplementedError


@chosen_by('table')
def catch(ball: Any, table: Any, pocket: int, now: float) -> None:
    """Take a ball that has reached a pocket out of the play."""
    raise NotImplementedError


@chosen_by('table')
def pocket_of(ball: Any, table: Any) -> int:
    """Return the number of the pocket in which a ball is, -1 for none."""
    raise NotImplementedError


@chosen_by('table')
def shown_at(ball: Any, table: Any) -> tuple[float, float]:
    """Return where a ball is, m, when its motion begins; in a pocket that is its centre."""
    raise NotImplementedError
