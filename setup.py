"""Build script of pool_sim_ros, for pip and for colcon (ament_python)."""

import re
from glob import glob
from pathlib import Path

from setuptools import Distribution, find_packages, setup

NAME = 'pool_sim_ros'
SUMMARY = 'A ROS 2 simulation node for a pool table, and the exact billiards engine behind it.'
VERSION = re.search("__version__ = '(.*)'", Path(NAME, '__init__.py').read_text())[1]

COMMANDS = [
    'sim_node = pool_sim_ros.cli.sim_node:main',
    'shot = pool_sim_ros.cli.shot:main',
    'replay = pool_sim_ros.cli.replay:main',
    'report = pool_sim_ros.report.command:main',
    'web_view = pool_sim_ros.web_view.command:main',
    'record_shot = pool_sim_ros.cli.record_shot:main',
    'oracle = pool_sim_ros.cli.oracle:main',
    'aim = pool_sim_ros.cli.aim:main',
]

# Only names that start with ros-jazzy- are bound to Jazzy: without it they are newer distributions.
JAZZY = [
    'ros-jazzy-rclpy[fastrtps]==7.1.*',
    'ros-jazzy-ament-index-python==1.8.*',
    'ros-jazzy-diagnostic-msgs==5.3.*',
    'ros-jazzy-geometry-msgs==5.3.*',
    'ros-jazzy-rosgraph-msgs==2.0.*',
    'ros-jazzy-sensor-msgs==5.3.*',
    'ros-jazzy-std-msgs==5.3.*',
    'ros-jazzy-std-srvs==5.3.*',
    'ros-jazzy-visualization-msgs==5.3.*',
]


class DataFilesAlways(Distribution):
    """Keep the data files in an editable install: setuptools asks for them under this name."""

    has_data = Distribution.has_data_files


class LaunchersToo(Distribution().get_command_class('install_data')):
    """Install the data files and, where setup.cfg had no say, launchers for `ros2 run`.

    pip puts the commands into bin/ whatever setup.cfg says. They cannot be moved, since pip writes
    the interpreter's path into them, so lib/pool_sim_ros/ gets scripts that start them from there.
    """

    def run(self):
        super().run()
        scripts = Path(self.get_finalized_command('install').install_scripts)
        if scripts.parts[-2:] == ('lib', NAME):
            return
        folder = Path(self.install_dir, 'lib', NAME)
        folder.mkdir(parents=True, exist_ok=True)
        for command in COMMANDS:
            name = command.split()[0]
            launcher = folder / name
            launcher.write_text(f'#!/bin/sh\nexec "${{0%/*}}/../../bin/{name}" "$@"\n')
            launcher.chmod(0o755)
            self.outfiles.append(str(launcher))


setup(
    name=NAME,
    version=VERSION,
    description=SUMMARY,
    author='pool_sim_ros maintainers',
    author_email='noreply@example.com',
    license='Apache-2.0',
    packages=find_packages(include=[NAME, f'{NAME}.*']),
    package_data={'': ['py.typed', '*.csv', 'templates/*', 'static/*']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{NAME}']),
        (f'share/{NAME}', ['package.xml']),
        (f'share/{NAME}/config', sorted(glob('config/*'))),
        (f'share/{NAME}/launch', sorted(glob('launch/*'))),
    ],
    entry_points={'console_scripts': COMMANDS},
    distclass=DataFilesAlways,
    cmdclass={'install_data': LaunchersToo},
    python_requires='>=3.10',
    install_requires=['numpy>=1.26', 'numba>=0.58.1'],
    extras_require={
        'jazzy': JAZZY,
        'report': ['imageio-ffmpeg', 'latex2mathml', 'matplotlib', 'pyyaml', 'tqdm'],
        'web': ['aiohttp'],
        'record': ['rosbags'],
        'fit': ['rosbags', 'scipy'],
        'gym': ['gymnasium>=1.1'],
        'plot': ['matplotlib'],
        'frames': ['pandas', 'xarray'],
        'docs': ['furo', 'myst-parser', 'numpydoc', 'sphinx'],
        'bench': ['cma', 'pytest-benchmark', 'tqdm'],
        'test': [
            'catkin_pkg',
            'colcon-package-information',
            'colcon-ros',
            'cyclonedds',  # sends what rclpy cannot
            'hypothesis',
            'import-linter>=2.5',
            'ipykernel',  # runs the notebooks
            'mcap',
            'mpmath',
            'mypy>=1.15',
            'nbclient',
            'packaging',
            'pip>=22.3',  # its option --python
            'playwright',  # drives the Chromium that the system has
            'pytest>=8',
            'pytest-cov>=7',
            'pytest-xdist>=3.6',
            'ruff',
            'setuptools>=70.1',  # makes wheels by itself
        ],
    },
    zip_safe=False,
)
