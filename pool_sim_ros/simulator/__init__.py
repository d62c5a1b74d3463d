"""A table over time: requests in, responses and frames out. No ROS, and no clock but the pacer's.

`settings` are the parameters, `shot_request` what is asked and answered. `simulation` plays it
tick by tick with `playback`; `runner` has the threads. `command_log` and `replay` play a session
again.
"""

from typing import TYPE_CHECKING

from pool_sim_ros.lazy import lazy_exports

if TYPE_CHECKING:
    from pool_sim_ros.simulator.command_log import CommandLog, LogError, read_log
    from pool_sim_ros.simulator.health import Report
    from pool_sim_ros.simulator.pacer import Pacer
    from pool_sim_ros.simulator.playback import Block, Frame
    from pool_sim_ros.simulator.replay import replay_frames
    from pool_sim_ros.simulator.runner import Runner
    from pool_sim_ros.simulator.settings import (
        PARAMETERS,
        Change,
        ParameterError,
        ParameterSpec,
        Settings,
        build_settings,
        coerce,
        default_values,
        values_from,
    )
    from pool_sim_ros.simulator.shot_request import (
        COLLISION_COLUMNS,
        VELOCITY_COLUMNS,
        Phase,
        Response,
    )
    from pool_sim_ros.simulator.table_json import table_from_json, table_to_json
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'Block': 'playback',
            'COLLISION_COLUMNS': 'shot_request',
            'Change': 'settings',
            'CommandLog': 'command_log',
            'Frame': 'playback',
            'LogError': 'command_log',
            'PARAMETERS': 'settings',
            'Pacer': 'pacer',
            'ParameterError': 'settings',
            'ParameterSpec': 'settings',
            'Phase': 'shot_request',
            'Report': 'health',
            'Response': 'shot_request',
            'Runner': 'runner',
            'Settings': 'settings',
            'VELOCITY_COLUMNS': 'shot_request',
            'build_settings': 'settings',
            'coerce': 'settings',
            'default_values': 'settings',
            'read_log': 'command_log',
            'replay_frames': 'replay',
            'table_from_json': 'table_json',
            'table_to_json': 'table_json',
            'values_from': 'settings',
        },
    )

__all__ = [
    'Block',
    'COLLISION_COLUMNS',
    'Change',
    'CommandLog',
    'Frame',
    'LogError',
    'PARAMETERS',
    'Pacer',
    'ParameterError',
    'ParameterSpec',
    'Phase',
    'Report',
    'Response',
    'Runner',
    'Settings',
    'VELOCITY_COLUMNS',
    'build_settings',
    'coerce',
    'default_values',
    'read_log',
    'replay_frames',
    'table_from_json',
    'table_to_json',
    'values_from',
]
