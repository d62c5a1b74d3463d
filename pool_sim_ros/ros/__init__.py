"""The simulator on ROS topics, and its clients.

`interface` declares every topic and service. `sim_node` is the node, `publishers` what it sends;
`client` and `recorder` are the other side. `process` starts and ends ROS in a process of our own.
"""

from typing import TYPE_CHECKING

from pool_sim_ros.lazy import lazy_exports

if TYPE_CHECKING:
    from pool_sim_ros.ros.client import ShotClient, SimulatorError
    from pool_sim_ros.ros.digest import digests
    from pool_sim_ros.ros.mcap import write_bag
    from pool_sim_ros.ros.process import (
        INTERRUPTED,
        NAME_ERRORS,
        StartupError,
        client_node,
        init_ros,
        shut_down_on_signals,
        without_ros_args,
    )
    from pool_sim_ros.ros.publishers import Publishers
    from pool_sim_ros.ros.recorder import Recorder
    from pool_sim_ros.ros.sim_node import SimNode
    from pool_sim_ros.ros.spin_thread import SpinThread
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'INTERRUPTED': 'process',
            'NAME_ERRORS': 'process',
            'Publishers': 'publishers',
            'Recorder': 'recorder',
            'ShotClient': 'client',
            'SimNode': 'sim_node',
            'SimulatorError': 'client',
            'SpinThread': 'spin_thread',
            'StartupError': 'process',
            'client_node': 'process',
            'digests': 'digest',
            'init_ros': 'process',
            'shut_down_on_signals': 'process',
            'without_ros_args': 'process',
            'write_bag': 'mcap',
        },
    )

__all__ = [
    'INTERRUPTED',
    'NAME_ERRORS',
    'Publishers',
    'Recorder',
    'ShotClient',
    'SimNode',
    'SimulatorError',
    'SpinThread',
    'StartupError',
    'client_node',
    'digests',
    'init_ros',
    'shut_down_on_signals',
    'without_ros_args',
    'write_bag',
]
