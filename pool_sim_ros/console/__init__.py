"""What every command of this package has in common: no ROS, no physics."""

from pool_sim_ros.console.progress import ProgressLine

__all__ = ['ProgressLine']
