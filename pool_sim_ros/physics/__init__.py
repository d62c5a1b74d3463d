"""The physics of a pool table as a plain library: numpy and numba, nothing of ROS.

    >>> from pool_sim_ros.physics import report_table, simulate
    >>> shot = simulate(report_table(), (-4.0, 0.0))
    >>> len(shot.events), round(shot.duration, 3)
    (24, 1.519)

`table` says what is played on, `shots` plays, `trajectory` is what comes of it. `event_driven` is
the exact integrator, `time_slice` the report's; both take the laws from `motion` and `contacts`.
"""

from typing import TYPE_CHECKING

from pool_sim_ros.lazy import lazy_exports
from pool_sim_ros.physics.units import INCH

if TYPE_CHECKING:
    from pool_sim_ros.physics.aim import aim_at
    from pool_sim_ros.physics.balls import Ball
    from pool_sim_ros.physics.contacts import (
        TwoBallCollision,
        collide_balls,
        collide_cushion,
        two_ball_collision,
    )
    from pool_sim_ros.physics.cue import MISCUE_OFFSET, cue_strike, cue_strikes
    from pool_sim_ros.physics.cushions import Cushions
    from pool_sim_ros.physics.game_tables import pool_table
    from pool_sim_ros.physics.integrators import INTEGRATORS, REPORT_TIME_SLICE, Integrator
    from pool_sim_ros.physics.law_names import (
        BALL_FRICTION_LAWS,
        CUSHION_MODELS,
        DISC_FRICTION_LAWS,
        FRICTION_BOUNDS,
        BallFriction,
        CushionModel,
        DiscFriction,
        FrictionBound,
    )
    from pool_sim_ros.physics.log import EventKind
    from pool_sim_ros.physics.me212_table import report_table
    from pool_sim_ros.physics.outcomes import Outcomes, ShotCancelled, ShotTooLong
    from pool_sim_ros.physics.pool_tables import (
        POOL_TABLES,
        PoolTable,
        PoolTableName,
        pool_table_dimensions,
    )
    from pool_sim_ros.physics.racks import RackKind, rack
    from pool_sim_ros.physics.separation import separated
    from pool_sim_ros.physics.shots import compile_kernels, simulate, simulate_many
    from pool_sim_ros.physics.table import MOTIONS, Motion, Table
    from pool_sim_ros.physics.table_file import table_from_fields, table_to_fields
    from pool_sim_ros.physics.tolerances import V_MIN
    from pool_sim_ros.physics.trajectory import Trajectory
    from pool_sim_ros.physics.validation import check_layout
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'BALL_FRICTION_LAWS': 'law_names',
            'CUSHION_MODELS': 'law_names',
            'DISC_FRICTION_LAWS': 'law_names',
            'FRICTION_BOUNDS': 'law_names',
            'Ball': 'balls',
            'BallFriction': 'law_names',
            'DiscFriction': 'law_names',
            'EventKind': 'log',
            'INTEGRATORS': 'integrators',
            'Integrator': 'integrators',
            'Outcomes': 'outcomes',
            'ShotCancelled': 'outcomes',
            'ShotTooLong': 'outcomes',
            'REPORT_TIME_SLICE': 'integrators',
            'Table': 'table',
            'Trajectory': 'trajectory',
            'TwoBallCollision': 'contacts',
            'CushionModel': 'law_names',
            'Cushions': 'cushions',
            'FrictionBound': 'law_names',
            'MOTIONS': 'table',
            'Motion': 'table',
            'POOL_TABLES': 'pool_tables',
            'PoolTable': 'pool_tables',
            'PoolTableName': 'pool_tables',
            'RackKind': 'racks',
            'V_MIN': 'tolerances',
            'aim_at': 'aim',
            'check_layout': 'validation',
            'collide_balls': 'contacts',
            'collide_cushion': 'contacts',
            'compile_kernels': 'shots',
            'MISCUE_OFFSET': 'cue',
            'cue_strike': 'cue',
            'cue_strikes': 'cue',
            'pool_table': 'game_tables',
            'pool_table_dimensions': 'pool_tables',
            'rack': 'racks',
            'report_table': 'me212_table',
            'separated': 'separation',
            'simulate': 'shots',
            'simulate_many': 'shots',
            'table_from_fields': 'table_file',
            'table_to_fields': 'table_file',
            'two_ball_collision': 'contacts',
        },
    )

__all__ = [
    'BALL_FRICTION_LAWS',
    'CUSHION_MODELS',
    'DISC_FRICTION_LAWS',
    'FRICTION_BOUNDS',
    'INCH',
    'INTEGRATORS',
    'MISCUE_OFFSET',
    'MOTIONS',
    'REPORT_TIME_SLICE',
    'Ball',
    'BallFriction',
    'CushionModel',
    'Cushions',
    'DiscFriction',
    'EventKind',
    'FrictionBound',
    'Integrator',
    'Motion',
    'Outcomes',
    'POOL_TABLES',
    'PoolTable',
    'PoolTableName',
    'RackKind',
    'ShotCancelled',
    'ShotTooLong',
    'Table',
    'Trajectory',
    'TwoBallCollision',
    'V_MIN',
    'aim_at',
    'check_layout',
    'collide_balls',
    'collide_cushion',
    'compile_kernels',
    'cue_strike',
    'cue_strikes',
    'pool_table',
    'pool_table_dimensions',
    'rack',
    'report_table',
    'separated',
    'simulate',
    'simulate_many',
    'table_from_fields',
    'table_to_fields',
    'two_ball_collision',
]
