"""What all commands have in common. It imports no other room, and neither ROS nor numpy.

`console_command` makes the `main` of a command, so that all start, fail and stop in the same way.
`CommandError` is what such a command tells its user in one line; `require` and `missing_line` tell
which package is missing. `Parser` reads arguments, with the types `number`, `positive`, `speed`,
`count`, `port` and `path`. `ProgressLine` shows what goes on.
"""

from pool_sim_ros.console.arguments import Parser, count, number, path, port, positive, speed
from pool_sim_ros.console.command import INTERRUPTED, Main, console_command
from pool_sim_ros.console.errors import CommandError
from pool_sim_ros.console.missing import missing_line, require
from pool_sim_ros.console.progress import ProgressLine

__all__ = [
    'INTERRUPTED',
    'CommandError',
    'Main',
    'Parser',
    'ProgressLine',
    'console_command',
    'count',
    'missing_line',
    'number',
    'path',
    'port',
    'positive',
    'require',
    'speed',
]
