"""A table over time, without ROS: requests go in, responses and frames come out.

A `Runner` plays a `Simulation` in real time with two threads, and hands what it plays to an
`Output`; the `Pacer` is its only clock. `Settings` are the parameters, checked. A `CommandLog`
records what changed the frames, and `replay_frames` plays it again, bit for bit. Clients use the
formats: the columns of a `Frame`, the JSON of requests, responses and tables, and sim time.
"""

from typing import TYPE_CHECKING

from pool_sim_ros.lazy import lazy_exports

if TYPE_CHECKING:
    from pool_sim_ros.simulator.bounded_file import FileError, open_bounded, read_text
    from pool_sim_ros.simulator.command_log import CommandLog, LogError
    from pool_sim_ros.simulator.frame import (
        COLLISION_COLUMNS,
        SPIN_COLUMNS,
        VELOCITY_COLUMNS,
        Block,
        Frame,
        velocity_columns,
    )
    from pool_sim_ros.simulator.health import Diagnosis
    from pool_sim_ros.simulator.heard import response_from_json, state_from_json
    from pool_sim_ros.simulator.layout import start_layout
    from pool_sim_ros.simulator.log_reader import read_log
    from pool_sim_ros.simulator.output import Output
    from pool_sim_ros.simulator.pacer import Pacer
    from pool_sim_ros.simulator.parameter_names import near_misses
    from pool_sim_ros.simulator.parameter_table import (
        PARAMETERS,
        Change,
        ParameterSpec,
        ParameterValue,
        default_values,
        parameters_of,
    )
    from pool_sim_ros.simulator.parameter_values import ParameterError, coerce, values_from
    from pool_sim_ros.simulator.refusals import RefusedError
    from pool_sim_ros.simulator.replay import replay_frames
    from pool_sim_ros.simulator.request_fields import cue_from
    from pool_sim_ros.simulator.runner import Runner
    from pool_sim_ros.simulator.settings import Settings, build_settings
    from pool_sim_ros.simulator.shot_request import (
        MAX_REQUEST_LENGTH,
        Code,
        Phase,
        Request,
        Response,
        parse_request,
        unreadable_request,
    )
    from pool_sim_ros.simulator.sim_time import (
        NANOSECOND,
        SECOND_NS,
        seconds_to_stamp,
        stamp_to_seconds,
    )
    from pool_sim_ros.simulator.simulation import Simulation
    from pool_sim_ros.simulator.steps import Stepped
    from pool_sim_ros.simulator.strict_json import read_json_object
    from pool_sim_ros.simulator.strikes import strike_on
    from pool_sim_ros.simulator.table_json import table_from_json, table_to_json
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'Block': 'frame',
            'COLLISION_COLUMNS': 'frame',
            'Change': 'parameter_table',
            'Code': 'shot_request',
            'CommandLog': 'command_log',
            'Diagnosis': 'health',
            'FileError': 'bounded_file',
            'Frame': 'frame',
            'LogError': 'command_log',
            'MAX_REQUEST_LENGTH': 'shot_request',
            'NANOSECOND': 'sim_time',
            'Output': 'output',
            'PARAMETERS': 'parameter_table',
            'Pacer': 'pacer',
            'ParameterError': 'parameter_values',
            'ParameterSpec': 'parameter_table',
            'ParameterValue': 'parameter_table',
            'Phase': 'shot_request',
            'RefusedError': 'refusals',
            'Request': 'shot_request',
            'Response': 'shot_request',
            'Runner': 'runner',
            'SECOND_NS': 'sim_time',
            'SPIN_COLUMNS': 'frame',
            'Settings': 'settings',
            'Simulation': 'simulation',
            'Stepped': 'steps',
            'VELOCITY_COLUMNS': 'frame',
            'build_settings': 'settings',
            'coerce': 'parameter_values',
            'default_values': 'parameter_table',
            'parameters_of': 'parameter_table',
            'parse_request': 'shot_request',
            'near_misses': 'parameter_names',
            'open_bounded': 'bounded_file',
            'read_json_object': 'strict_json',
            'read_log': 'log_reader',
            'read_text': 'bounded_file',
            'replay_frames': 'replay',
            'response_from_json': 'heard',
            'seconds_to_stamp': 'sim_time',
            'stamp_to_seconds': 'sim_time',
            'start_layout': 'layout',
            'state_from_json': 'heard',
            'table_from_json': 'table_json',
            'table_to_json': 'table_json',
            'cue_from': 'request_fields',
            'strike_on': 'strikes',
            'unreadable_request': 'shot_request',
            'values_from': 'parameter_values',
            'velocity_columns': 'frame',
        },
    )

__all__ = [
    'Block',
    'COLLISION_COLUMNS',
    'Change',
    'Code',
    'CommandLog',
    'Diagnosis',
    'FileError',
    'Frame',
    'LogError',
    'MAX_REQUEST_LENGTH',
    'NANOSECOND',
    'Output',
    'PARAMETERS',
    'Pacer',
    'ParameterError',
    'ParameterSpec',
    'ParameterValue',
    'Phase',
    'RefusedError',
    'Request',
    'Response',
    'Runner',
    'SECOND_NS',
    'SPIN_COLUMNS',
    'Settings',
    'Simulation',
    'Stepped',
    'VELOCITY_COLUMNS',
    'build_settings',
    'coerce',
    'cue_from',
    'default_values',
    'parameters_of',
    'parse_request',
    'near_misses',
    'open_bounded',
    'read_json_object',
    'read_log',
    'read_text',
    'replay_frames',
    'response_from_json',
    'seconds_to_stamp',
    'stamp_to_seconds',
    'start_layout',
    'state_from_json',
    'strike_on',
    'table_from_json',
    'table_to_json',
    'unreadable_request',
    'values_from',
    'velocity_columns',
]
