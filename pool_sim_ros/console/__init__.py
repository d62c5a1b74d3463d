"""What every command of this package has in common; it needs neither ROS nor the physics.

`console_command` makes the `main` of a command: all start, fail and stop in the same way.
`ProgressLine` shows what goes on.
"""

from pool_sim_ros.console.command import INTERRUPTED, CommandError, Main, console_command
from pool_sim_ros.console.progress import ProgressLine

__all__ = ['INTERRUPTED', 'CommandError', 'Main', 'ProgressLine', 'console_command']
