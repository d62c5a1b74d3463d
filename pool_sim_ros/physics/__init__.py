"""The physics of a pool table: numpy and numba, nothing of ROS.

>>> from pool_sim_ros.physics import report_table, simulate
>>> shot = simulate(report_table(), (-4.0, 0.0))
>>> shot.final_positions, shot.duration, shot.events
"""

from pool_sim_ros.physics.simulate import compile_kernels, simulate, simulate_many
from pool_sim_ros.physics.table import Ball, Table, report_table
from pool_sim_ros.physics.trajectory import Trajectory
from pool_sim_ros.physics.two_ball import TwoBallCollision, two_ball_collision

__all__ = [
    'Ball',
    'Table',
    'Trajectory',
    'TwoBallCollision',
    'compile_kernels',
    'report_table',
    'simulate',
    'simulate_many',
    'two_ball_collision',
]
