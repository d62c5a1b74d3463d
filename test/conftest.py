"""Fixtures for tests over ROS: loopback only, a domain of its own for each run."""

import os
import signal
from collections import Counter

import pytest
from hypothesis import HealthCheck, settings

# How long an example takes says how busy the machine is.
settings.register_profile('here', deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile('here')

# A shell's background job ignores Ctrl-C, and so would every process that a test starts.
signal.signal(signal.SIGINT, signal.default_int_handler)

os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
# A process that is killed while it writes to shared memory leaves that broken for all others.
os.environ['FASTDDS_BUILTIN_TRANSPORTS'] = 'UDPv4'


OPTIONAL = {
    *[
        'aiohttp',
        'catkin_pkg',
        'cyclonedds',
        'distributed',
        'gymnasium',
        'imageio_ffmpeg',
        'latex2mathml',
        'matplotlib',
        'mcap',
    ],
    *['mpmath', 'packaging', 'pandas', 'playwright', 'rosbags', 'scipy', 'tqdm', 'xarray', 'yaml'],
    *['numcodecs', 'psutil', 'zarr'],
    *['ipykernel', 'nbclient', 'nbformat', 'numpydoc', 'sphinx'],
    *[
        'diagnostic_msgs',
        'geometry_msgs',
        'rcl_interfaces',
        'rclpy',
        'rosgraph_msgs',
        'sensor_msgs',
    ],
    *['std_msgs', 'std_srvs', 'visualization_msgs', 'ament_index_python'],
}
"""Packages without which the other tests run: some have no apt package, and so no rosdep key."""


class TestModule(pytest.Module):
    """A test module that is skipped where an optional package which it imports is missing."""

    def collect(self):
        try:
            return super().collect()
        except self.CollectError as error:
            name = getattr(error.__cause__, 'name', None) or ''
            if name.partition('.')[0] in OPTIONAL:
                pytest.skip(f'{name} is not installed here', allow_module_level=True)
            raise


def pytest_pycollect_makemodule(module_path, parent):
    return TestModule.from_parent(parent, path=module_path)


def pytest_addoption(parser):
    """How long, and how, the soak test of a node under fire goes on."""
    parser.addoption('--fuzz-seconds', type=float, default=600.0, help='default: 600')
    parser.addoption('--fuzz-seed', type=int, default=1, help='of what is done; default: 1')


LONG = {
    *['test_first_touch.py', 'test_fuzzed_for_long.py', 'test_other_machines.py'],
    *['test_properties.py', 'test_public_types.py', 'test_site.py'],
}
"""Modules with few tests that take long."""


def pytest_collection_modifyitems(config, items):
    """Leave out what takes minutes, unless -m names it.

    Where modules run side by side, the long ones come first and those with few tests last: else one
    process would still be at a long one when all others have ended.
    """
    if 'soak' not in config.option.markexpr:
        soaks = [item for item in items if item.get_closest_marker('soak')]
        items[:] = [item for item in items if item not in soaks]
        config.hook.pytest_deselected(items=soaks)
    if hasattr(config, 'workerinput'):
        counts = Counter(item.path for item in items)
        items.sort(key=lambda item: (item.path.name not in LONG, -counts[item.path]))


@pytest.fixture(scope='session')
def domain():
    """A ROS_DOMAIN_ID that no other test run on this machine uses, set for child processes too."""
    from ros_harness import own_domain

    with own_domain() as number:
        os.environ['ROS_DOMAIN_ID'] = str(number)
        yield number


@pytest.fixture
def ros(domain):
    """A private ROS context with an executor that the test itself spins."""
    from ros_harness import Ros

    with Ros(domain) as ros:
        yield ros
