"""What all commands have in common. It imports no other room, and neither ROS nor numpy.

`console_command` makes the `main` of a command, so that all start, fail and stop in the same way.
`CommandError` is what such a command tells its user in one line. `ProgressLine` shows what goes on.
"""

from pool_sim_ros.console.command import INTERRUPTED, CommandError, Main, console_command
from pool_sim_ros.console.progress import ProgressLine

__all__ = ['INTERRUPTED', 'CommandError', 'Main', 'ProgressLine', 'console_command']
