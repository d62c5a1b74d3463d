"""What a ball does between two contacts.

`seam` has what the engine asks of a motion. There are two: `disc`, the report's, loses speed along
its own line; `ball` slides, rolls and spins. Each brings a record of its balls, a named tuple for
its tables, and the functions of the seam.
"""

from pool_sim_ros.physics.contact_time import RelativeMotion, after
from pool_sim_ros.physics.jit import register
from pool_sim_ros.physics.motion import ball, disc, seam
from pool_sim_ros.physics.motion.ball_record import BALL, BallTable, spheres_at_rest
from pool_sim_ros.physics.motion.disc_record import DISC, DiscTable, discs_at_rest
from pool_sim_ros.physics.motion.moving_balls import N_ROWS
from pool_sim_ros.physics.motion.phase import MOVES, RESTS, ROLLS, SLIDES
from pool_sim_ros.physics.motion.seam import (
    acceleration,
    advance,
    catch,
    end_phase,
    first_resting_ball,
    first_resting_of,
    give_spin,
    has_phases,
    in_play,
    keep_path,
    lie_at,
    log_spin,
    path_from,
    phase_end_time,
    pocket_of,
    position_at,
    relative_motion,
    rest_begins,
    runs_away,
    set_off,
    shown_at,
    sift,
    time_to_boundary,
    time_to_cell_edge,
    time_to_resting_ball,
    touched_in_rows,
    velocity_at,
)

__all__ = [
    'BALL',
    'DISC',
    'MOVES',
    'N_ROWS',
    'RESTS',
    'ROLLS',
    'SLIDES',
    'BallTable',
    'DiscTable',
    'RelativeMotion',
    'acceleration',
    'discs_at_rest',
    'spheres_at_rest',
    'advance',
    'after',
    'catch',
    'end_phase',
    'first_resting_ball',
    'first_resting_of',
    'give_spin',
    'has_phases',
    'in_play',
    'keep_path',
    'lie_at',
    'log_spin',
    'path_from',
    'phase_end_time',
    'pocket_of',
    'position_at',
    'relative_motion',
    'rest_begins',
    'runs_away',
    'set_off',
    'shown_at',
    'sift',
    'time_to_boundary',
    'time_to_cell_edge',
    'time_to_resting_ball',
    'touched_in_rows',
    'velocity_at',
]

CHOICES = (
    'position_at',
    'velocity_at',
    'acceleration',
    'set_off',
    'phase_end_time',
    'end_phase',
    'runs_away',
    'path_from',
    'time_to_boundary',
    'time_to_cell_edge',
    'first_resting_ball',
    'first_resting_of',
    'time_to_resting_ball',
    'touched_in_rows',
    'relative_motion',
    'advance',
    'has_phases',
    'keep_path',
    'sift',
    'rest_begins',
    'give_spin',
    'log_spin',
    'lie_at',
    'in_play',
    'catch',
    'pocket_of',
    'shown_at',
)
"""The functions of `seam` that each motion implements."""

for _name in CHOICES:
    register(getattr(seam, _name), DiscTable, getattr(disc, _name))
    register(getattr(seam, _name), BallTable, getattr(ball, _name))
