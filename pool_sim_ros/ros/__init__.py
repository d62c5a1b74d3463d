"""The simulator on ROS topics, and its clients.

`interface` declares every topic and service. `SimNode` is the node. `ShotClient` plays shots on a
node, `Recorder` keeps what it publishes, and `SimulatorError` says why that failed. `OracleNode`
answers what-ifs and makes plans; `WhatIfClient` and `PlanClient` ask it from the caller's own node,
and `OracleError` says why not. Users import these. The other names are for `cli` and `web_view`,
which import this room; it imports neither.

Nothing is loaded before it is asked for, so `ros_command` and `add_simulator` work without ROS.
"""

from typing import TYPE_CHECKING

from pool_sim_ros.lazy import lazy_exports

if TYPE_CHECKING:
    from pool_sim_ros.ros import interface, messages, oracle_interface
    from pool_sim_ros.ros.arguments import add_simulator, add_timeout
    from pool_sim_ros.ros.client import ShotClient
    from pool_sim_ros.ros.command import ros_command
    from pool_sim_ros.ros.digest import digests
    from pool_sim_ros.ros.environment import check_environment
    from pool_sim_ros.ros.inbox import Inbox
    from pool_sim_ros.ros.lasting_executor import LastingExecutor
    from pool_sim_ros.ros.mcap import write_bag
    from pool_sim_ros.ros.names import NODE_NAME, ORACLE_NAME
    from pool_sim_ros.ros.oracle_error import OracleError
    from pool_sim_ros.ros.oracle_node import OracleNode
    from pool_sim_ros.ros.plan_client import PlanClient
    from pool_sim_ros.ros.process import init_ros, leave_at_once, shut_down_on_signals
    from pool_sim_ros.ros.publishers import Publishers
    from pool_sim_ros.ros.recorder import Recorder
    from pool_sim_ros.ros.sim_node import SimNode
    from pool_sim_ros.ros.simulator_client import SimulatorError
    from pool_sim_ros.ros.simulator_link import SimulatorLink
    from pool_sim_ros.ros.simulator_view import SimulatorView
    from pool_sim_ros.ros.what_if_client import WhatIfClient
    from pool_sim_ros.ros.what_if_rows import WhatIf
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'Inbox': 'inbox',
            'LastingExecutor': 'lasting_executor',
            'add_simulator': 'arguments',
            'add_timeout': 'arguments',
            'NODE_NAME': 'names',
            'ORACLE_NAME': 'names',
            'OracleError': 'oracle_error',
            'OracleNode': 'oracle_node',
            'PlanClient': 'plan_client',
            'Publishers': 'publishers',
            'Recorder': 'recorder',
            'ShotClient': 'client',
            'SimNode': 'sim_node',
            'SimulatorError': 'simulator_client',
            'SimulatorLink': 'simulator_link',
            'SimulatorView': 'simulator_view',
            'WhatIf': 'what_if_rows',
            'WhatIfClient': 'what_if_client',
            'check_environment': 'environment',
            'digests': 'digest',
            'init_ros': 'process',
            'interface': 'interface',
            'leave_at_once': 'process',
            'messages': 'messages',
            'oracle_interface': 'oracle_interface',
            'ros_command': 'command',
            'shut_down_on_signals': 'process',
            'write_bag': 'mcap',
        },
    )

__all__ = [
    'Inbox',
    'LastingExecutor',
    'NODE_NAME',
    'ORACLE_NAME',
    'OracleError',
    'OracleNode',
    'PlanClient',
    'Publishers',
    'Recorder',
    'ShotClient',
    'SimNode',
    'SimulatorError',
    'SimulatorLink',
    'SimulatorView',
    'WhatIf',
    'WhatIfClient',
    'add_simulator',
    'add_timeout',
    'check_environment',
    'digests',
    'init_ros',
    'interface',
    'leave_at_once',
    'messages',
    'oracle_interface',
    'ros_command',
    'shut_down_on_signals',
    'write_bag',
]
