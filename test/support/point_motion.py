"""A motion that only the tests have: nothing ever slows a ball.

It keeps a velocity where the disc keeps a direction, and its paths are points with a velocity.
"""

from typing import Any, NamedTuple

import numpy as np

from pool_sim_ros.physics import motion as seam
from pool_sim_ros.physics.boundary import distance_to_cushions
from pool_sim_ros.physics.contacts import laws
from pool_sim_ros.physics.event_driven import group_friction, inelastic_collapse
from pool_sim_ros.physics.jit import register
from pool_sim_ros.physics.log import STOP
from pool_sim_ros.physics.motion import MOVES, RESTS, DiscTable, RelativeMotion


class PointTable(NamedTuple):
    """What the laws of contact ask of a table; there is no law of the cloth."""

    boundary: Any
    mu_ball_ball: float
    mu_ball_cushion: float
    e_cue_ball: float
    e_ball_ball: float
    e_ball_cushion: float
    coulomb: bool
    cue_ball: int


class PointPath(NamedTuple):
    """Where a ball is, m, and its velocity, m/s."""

    x: float
    y: float
    vx: float
    vy: float


def point_table(table):
    """Return the kernels' table on which balls slide without friction."""
    known = table.for_kernels._asdict()
    return PointTable(**{name: known[name] for name in PointTable._fields})


def _position(ball, table, t):
    return ball.x + ball.ux * (t - ball.since), ball.y + ball.uy * (t - ball.since)


def _velocity(ball, table, t):
    return ball.ux, ball.uy


def _acceleration(ball, table):
    return 0.0, 0.0


def _set_off(ball, table, vx, vy):
    ball.ux, ball.uy = vx, vy
    ball.phase = RESTS if vx == 0.0 and vy == 0.0 else MOVES
    ball.changes += 1


def _phase_end_time(ball, table):
    return np.inf


def _end_phase(ball, table, now):
    return STOP


def _runs_away(ball, table, most):
    return ball.ux * ball.ux + ball.uy * ball.uy > most * ball.inverse_mass


def _path(ball, table, now):
    elapsed = now - ball.since
    return PointPath(ball.x + ball.ux * elapsed, ball.y + ball.uy * elapsed, ball.ux, ball.uy)


def _boundary(path, table, ball):
    # Along a velocity instead of a unit vector: not a distance but a time.
    return distance_to_cushions(table.boundary, path.x, path.y, path.vx, path.vy, ball.radius)


def _cell_edge(path, table, x_low, x_high, y_low, y_high):
    to_x = to_y = np.inf
    step_x, step_y = 1, 1
    if path.vx > 0.0:
        to_x = (x_high - path.x) / path.vx
    elif path.vx < 0.0:
        to_x, step_x = (x_low - path.x) / path.vx, -1
    if path.vy > 0.0:
        to_y = (y_high - path.y) / path.vy
    elif path.vy < 0.0:
        to_y, step_y = (y_low - path.y) / path.vy, -1
    if to_x <= to_y:
        return max(to_x, 0.0), step_x, 0
    return max(to_y, 0.0), 0, step_y


def _resting_ball(path, table, dx, dy, touch):
    squared = path.vx * path.vx + path.vy * path.vy
    along = dx * path.vx + dy * path.vy
    aside = dx * path.vy - dy * path.vx
    under_root = touch * touch * squared - aside * aside
    if along <= 0.0 or under_root <= 0.0:
        return np.inf
    return max((along - np.sqrt(under_root)) / squared, 0.0)


def _first_resting_ball(path, table, radius, lasts, rows):
    first, ball = lasts, -1
    for k in range(rows.shape[1]):
        dx, dy = rows[0, k] - path.x, rows[1, k] - path.y
        if dx == dx:
            seconds = seam.time_to_resting_ball(path, table, dx, dy, radius + rows[2, k])
            if seconds < first:
                first, ball = seconds, k
    return first, ball


def _first_resting_of(path, table, radius, lasts, balls, listed, count):
    first, ball = lasts, -1
    for m in range(count):
        other = balls[listed[m]]
        dx, dy = other.x - path.x, other.y - path.y
        seconds = seam.time_to_resting_ball(path, table, dx, dy, radius + other.radius)
        if seconds < first:
            first, ball = seconds, listed[m]
    return first, ball


def _relative(path, table, other):
    return RelativeMotion(
        other.x - path.x, other.y - path.y, other.vx - path.vx, other.vy - path.vy, 0.0, 0.0
    )


def _advance(ball, table, now):
    ball.x += ball.ux * (now - ball.since)
    ball.y += ball.uy * (now - ball.since)
    ball.since = now
    return ball.ux, ball.uy


def _has_phases(table):
    return False


def _rest_begins(ball, table):
    return ball.since


def _give_spin(ball, table, wx, wy, wz):
    pass


def _log_spin(segment, ball, table):
    pass


def _keep_path(ball, table, rows, i):
    pass


def _touched_in_rows(table, rows, place, near, pair, now):
    return False, False


def _sift(path, table, radius, times, rows):
    return False


def _lie_at(ball, table, x, y):
    ball.x, ball.y = x, y


def _in_play(ball, table):
    return True


def _catch(ball, table, pocket, now):
    pass


def _pocket_of(ball, table):
    return -1


def _shown_at(ball, table):
    return ball.x, ball.y


IMPLEMENTATIONS = {
    seam.position_at: _position,
    seam.velocity_at: _velocity,
    seam.acceleration: _acceleration,
    seam.set_off: _set_off,
    seam.phase_end_time: _phase_end_time,
    seam.end_phase: _end_phase,
    seam.runs_away: _runs_away,
    seam.path_from: _path,
    seam.time_to_boundary: _boundary,
    seam.time_to_cell_edge: _cell_edge,
    seam.first_resting_ball: _first_resting_ball,
    seam.first_resting_of: _first_resting_of,
    seam.time_to_resting_ball: _resting_ball,
    seam.relative_motion: _relative,
    seam.advance: _advance,
    seam.has_phases: _has_phases,
    seam.keep_path: _keep_path,
    seam.sift: _sift,
    seam.touched_in_rows: _touched_in_rows,
    seam.rest_begins: _rest_begins,
    seam.give_spin: _give_spin,
    seam.log_spin: _log_spin,
    seam.lie_at: _lie_at,
    seam.in_play: _in_play,
    seam.catch: _catch,
    seam.pocket_of: _pocket_of,
    seam.shown_at: _shown_at,
}

AS_DISCS = (
    laws.collide_pair,
    laws.bounce,
    inelastic_collapse.separation_speed,
    group_friction.rub_group,
)
"""In contact points do as discs do."""

for _choice, _implementation in IMPLEMENTATIONS.items():
    register(_choice, PointTable, _implementation)
for _choice in AS_DISCS:
    register(_choice, PointTable, _choice.implementations[DiscTable])
