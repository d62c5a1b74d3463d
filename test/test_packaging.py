"""What an installation leaves behind: the files that ROS 2 tools look up, and commands that run."""

import email
import os
import re
import subprocess
import sys
import threading
import zipfile
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_prefix, get_package_share_directory
from catkin_pkg.package import parse_package
from packaging.requirements import Requirement
from packaging.version import Version
from packaging_installs import INSTALLERS, Installation, copy_project, run

import pool_sim_ros

pytestmark = pytest.mark.packaging

PROJECT = Path(__file__).parents[1]
MAKES_WHEELS = Version('70.1')
"""The first setuptools that needs no other package for a wheel."""
COMMANDS = {'sim_node', 'shot', 'replay', 'report', 'web_view', 'record_shot', 'oracle', 'aim'}


def skip_without_builders(*modules):
    """Skip where what builds and installs packages is not there, or too old to do it alone."""
    for module in modules:
        pytest.importorskip(module, reason=f'{module} is not installed here')
    if (
        'pip' in modules
        and not find_spec('wheel')
        and Version(version('setuptools')) < MAKES_WHEELS
    ):
        pytest.skip(f'setuptools is older than {MAKES_WHEELS}, and wheel is not installed here')


@pytest.fixture(scope='module')
def source(tmp_path_factory):
    """Return a copy of the project, so that building leaves nothing in the working tree."""
    return copy_project(PROJECT, tmp_path_factory.mktemp('source') / 'pool_sim_ros')


@pytest.fixture(scope='module')
def wheel(source, tmp_path_factory):
    skip_without_builders('pip')
    folder = tmp_path_factory.mktemp('wheel')
    run(
        [sys.executable, '-m', 'pip', 'wheel', '--no-deps', '--no-index', '--no-build-isolation']
        + ['--wheel-dir', folder, source]
    )
    (path,) = folder.glob('*.whl')
    with zipfile.ZipFile(path) as archive:
        yield archive


@pytest.fixture(scope='module')
def wheel_metadata(wheel):
    (name,) = [name for name in wheel.namelist() if name.endswith('.dist-info/METADATA')]
    return email.message_from_bytes(wheel.read(name))


@pytest.fixture(scope='module', params=INSTALLERS, ids=lambda install: install.__name__)
def installation(request, source, tmp_path_factory) -> Installation:
    name = request.param.__name__
    skip_without_builders('pip' if name.startswith('pip') else 'colcon_ros')
    return request.param(source, tmp_path_factory.mktemp(name))


def find_executables(prefix):
    """Return what `ros2 run` offers: the executable files below lib/<package>, by name."""
    found = {}
    for folder, _, names in os.walk(os.path.join(prefix, 'lib', 'pool_sim_ros')):
        paths = [os.path.join(folder, name) for name in names]
        found |= {os.path.basename(path): path for path in paths if os.access(path, os.X_OK)}
    return found


def test_package_xml_is_valid_without_a_warning():
    warnings = []
    package = parse_package(PROJECT / 'package.xml', warnings=warnings)
    package.validate(warnings=warnings)
    assert warnings == []
    assert package.package_format == 3
    assert package.get_build_type() == 'ament_python'
    assert {dependency.name for dependency in package.exec_depends} == {
        "rclpy", "std_msgs", "geometry_msgs", "std_srvs", "visualization_msgs",
        "diagnostic_msgs", "rosgraph_msgs", "sensor_msgs", "python3-numpy", "python3-numba",
        "rviz2", "ros2launch",
        "python3-aiohttp", "python3-matplotlib", "python3-scipy", "python3-tqdm", "python3-yaml",
    }  # fmt: skip
    assert {dependency.name for dependency in package.test_depends} == {
        "ament_index_python", "python3-catkin-pkg-modules", "python3-hypothesis",
        "python3-packaging", "python3-pytest",
    }  # fmt: skip
    # rosdep hands such keys to pip, which refuses to install them beside those of Ubuntu.
    names = {d.name for d in (*package.exec_depends, *package.test_depends)}
    assert not any(name.endswith('-pip') for name in names)


def test_the_oldest_versions_are_those_that_apt_gives(wheel_metadata):
    """Ubuntu 24.04 has numpy 1.26.4 and numba 0.58.1; rosdep installs these."""
    requirements = [Requirement(text) for text in wheel_metadata.get_all('Requires-Dist')]
    apt = {'numpy': '1.26.4', 'numba': '0.58.1'}
    for requirement in requirements:
        if requirement.marker is None:
            assert requirement.specifier.contains(apt[requirement.name]), requirement


def test_every_pip_line_that_a_user_reads_can_work():
    """The package itself is not on PyPI, so pip has to be given a folder."""
    files = [
        *PROJECT.glob('*.md'),
        *PROJECT.glob('docs/*.md'),
        *PROJECT.glob('pool_sim_ros/**/*.py'),
    ]
    for file in files:
        found = re.findall(r'pip install[^\n`]*pool_sim_ros', file.read_text())
        assert not found, f'{file}: {found}'


def test_colcon_sees_an_ament_python_package(source, tmp_path):
    skip_without_builders('colcon_ros')
    listing = run(
        [sys.executable, '-m', 'colcon', '--log-base', tmp_path, 'list', '--base-paths', source]
    )
    assert listing.split('\t')[0::2] == ['pool_sim_ros', '(ros.ament_python)\n']


def test_versions_agree(wheel_metadata):
    assert parse_package(PROJECT / 'package.xml').version == pool_sim_ros.__version__
    assert wheel_metadata['Version'] == pool_sim_ros.__version__


def test_wheel_holds_the_data_files(wheel):
    prefix = f'pool_sim_ros-{pool_sim_ros.__version__}.data/data/share/'
    configs = {f'{prefix}pool_sim_ros/config/{path.name}' for path in PROJECT.glob('config/*')}
    assert f'{prefix}pool_sim_ros/config/report.yaml' in configs
    assert {
        'pool_sim_ros/py.typed',
        f'{prefix}ament_index/resource_index/packages/pool_sim_ros',
        f'{prefix}pool_sim_ros/package.xml',
        *configs,
    } <= set(wheel.namelist())


def test_wheel_holds_every_file_of_the_package(wheel, source):
    files = [path for path in source.glob('pool_sim_ros/**/*') if path.is_file()]
    assert {path.relative_to(source).as_posix() for path in files} <= set(wheel.namelist())


def test_only_numpy_and_numba_are_required(wheel_metadata):
    requirements = [Requirement(text) for text in wheel_metadata.get_all('Requires-Dist')]
    assert {r.name for r in requirements if r.marker is None} == {'numpy', 'numba'}


def test_the_jazzy_extra_can_only_be_jazzy(wheel_metadata):
    requirements = [Requirement(text) for text in wheel_metadata.get_all('Requires-Dist')]
    jazzy = [r for r in requirements if r.marker and r.marker.evaluate({'extra': 'jazzy'})]
    assert 'ros-jazzy-rclpy' in {r.name for r in jazzy}
    for requirement in jazzy:
        assert requirement.name.startswith('ros-jazzy-')
        assert re.fullmatch(r'==\d+\.\d+\.\*', str(requirement.specifier)), requirement


def test_ros2_run_finds_every_command(installation, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(installation.prefix))
    prefix = get_package_prefix('pool_sim_ros')
    assert Path(prefix) == installation.prefix
    assert set(find_executables(prefix)) == COMMANDS


def test_the_installed_package_is_the_one_that_runs(installation, tmp_path):
    script = 'import pool_sim_ros; print(pool_sim_ros.__file__)'
    command = [*installation.shell, installation.python, '-c', script]
    found = Path(run(command, env=installation.env, cwd=tmp_path).strip()).resolve()
    assert found.name == '__init__.py'
    assert PROJECT not in found.parents


@pytest.mark.parametrize('command', sorted(COMMANDS))
def test_commands_run_outside_the_environment(installation, command, tmp_path):
    path = find_executables(installation.prefix)[command]
    output = run([*installation.shell, path, '--help'], env=installation.env, cwd=tmp_path)
    assert re.match(f'usage: .*{command}', output)


def test_the_node_starts_with_the_installed_configuration(installation, tmp_path, domain):
    """It need not get ready, since that takes compiling the kernels: its first words are enough."""
    path = find_executables(installation.prefix)['sim_node']
    parameters = installation.prefix / 'share/pool_sim_ros/config/report.yaml'
    command = [*installation.shell, path, '--ros-args', '--params-file', str(parameters)]
    ros = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST', 'ROS_DOMAIN_ID': str(domain)}
    with subprocess.Popen(
        command,
        env=installation.env | ros,
        cwd=tmp_path,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as node:
        watchdog = threading.Timer(120, node.kill)
        watchdog.start()
        first = node.stdout.readline()
        node.terminate()
        rest = node.stdout.read()
    watchdog.cancel()
    assert '[pool_sim]' in first, first + rest
    assert node.returncode == 0, first + rest


def test_share_holds_the_configuration(installation, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(installation.prefix))
    share = Path(get_package_share_directory('pool_sim_ros'))
    for original in PROJECT.glob('config/*'):
        assert (share / 'config' / original.name).read_bytes() == original.read_bytes()
    assert (share / 'package.xml').read_bytes() == (PROJECT / 'package.xml').read_bytes()
