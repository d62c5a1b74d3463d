"""What happens if I do this, and what should I do: very many shots, and the best of them.

    >>> from pool_sim_ros.oracle import Goal, Noise, find_shots
    >>> from pool_sim_ros.physics import report_table
    >>> goal = Goal(ball='9', to=(0.3, 0.2), within=0.1)
    >>> plan = find_shots(report_table(), goal, Noise(speed=0.02, azimuth=0.1), shots=20_000)
    >>> 0.0 <= plan[0].low <= plan[0].chance <= plan[0].high <= 1.0
    True

`what_if` plays candidates. `find_shots` sweeps, races and climbs among aims, given how badly
somebody shoots and sees; `error_budget` says how well one must. `fit` finds the coefficients of
a table from tracks. A `Cluster` plays on other machines. The room knows the physics alone: no ROS,
no clock but for `seconds`.
"""

from typing import TYPE_CHECKING

from pool_sim_ros.lazy import lazy_exports

if TYPE_CHECKING:
    from pool_sim_ros.oracle.budget import ErrorBudget, error_budget
    from pool_sim_ros.oracle.calibration import Fit, fit
    from pool_sim_ros.oracle.candidates import what_if
    from pool_sim_ros.oracle.cluster import Cluster, ClusterError
    from pool_sim_ros.oracle.goal import Goal
    from pool_sim_ros.oracle.noise import Noise
    from pool_sim_ros.oracle.plan import Failure, Plan, RankedShot
    from pool_sim_ros.oracle.search import find_shots
    from pool_sim_ros.oracle.track_files import read_tracks
    from pool_sim_ros.oracle.tracks import Track
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'Cluster': 'cluster',
            'ClusterError': 'cluster',
            'ErrorBudget': 'budget',
            'Failure': 'plan',
            'Fit': 'calibration',
            'Goal': 'goal',
            'Noise': 'noise',
            'Plan': 'plan',
            'RankedShot': 'plan',
            'Track': 'tracks',
            'error_budget': 'budget',
            'find_shots': 'search',
            'fit': 'calibration',
            'read_tracks': 'track_files',
            'what_if': 'candidates',
        },
    )

__all__ = [
    'Cluster',
    'ClusterError',
    'ErrorBudget',
    'Failure',
    'Fit',
    'Goal',
    'Noise',
    'Plan',
    'RankedShot',
    'Track',
    'error_budget',
    'find_shots',
    'fit',
    'read_tracks',
    'what_if',
]
